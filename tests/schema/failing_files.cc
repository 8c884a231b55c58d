#include "tests/schema/failing_files.h"

#include <sqlite3.h>

#include <limits>
#include <new>
#include <utility>

namespace haarmony::schema {
namespace {

constexpr int kNever = std::numeric_limits<int>::max();

// SQLite calls plain functions, and so the state is here.
sqlite3_vfs* real = nullptr;
sqlite3_vfs shim{};
int remaining = kNever;
int failure = SQLITE_OK;
bool has_failed = false;
int refusals_to_come = 0;
std::function<void()> after_refusals;

// SQLITE_OK, or the failure when its time has come.
int count_down() {
    if (remaining == kNever) return SQLITE_OK;
    if (remaining > 0) {
        --remaining;
        return SQLITE_OK;
    }
    has_failed = true;
    return failure;
}

// Followed in memory by the real file.
struct File {
    sqlite3_file base;
    sqlite3_file* real_file;
};

sqlite3_file* real_of(sqlite3_file* file) {
    return reinterpret_cast<File*>(file)->real_file;
}

int close_file(sqlite3_file* file) {
    return real_of(file)->pMethods->xClose(real_of(file));
}
int read_file(sqlite3_file* file, void* to, int count, sqlite3_int64 at) {
    return real_of(file)->pMethods->xRead(real_of(file), to, count, at);
}
int write_file(sqlite3_file* file, const void* from, int count, sqlite3_int64 at) {
    const int result = count_down();
    return result != SQLITE_OK
               ? result
               : real_of(file)->pMethods->xWrite(real_of(file), from, count, at);
}
int truncate_file(sqlite3_file* file, sqlite3_int64 size) {
    const int result = count_down();
    return result != SQLITE_OK ? result
                               : real_of(file)->pMethods->xTruncate(real_of(file), size);
}
int sync_file(sqlite3_file* file, int flags) {
    const int result = count_down();
    return result != SQLITE_OK ? result
                               : real_of(file)->pMethods->xSync(real_of(file), flags);
}
int file_size(sqlite3_file* file, sqlite3_int64* size) {
    return real_of(file)->pMethods->xFileSize(real_of(file), size);
}
int lock(sqlite3_file* file, int level) {
    const int result = real_of(file)->pMethods->xLock(real_of(file), level);
    if (result == SQLITE_BUSY && refusals_to_come > 0 && --refusals_to_come == 0) {
        after_refusals();
    }
    return result;
}
int unlock(sqlite3_file* file, int level) {
    return real_of(file)->pMethods->xUnlock(real_of(file), level);
}
int check_lock(sqlite3_file* file, int* reserved) {
    return real_of(file)->pMethods->xCheckReservedLock(real_of(file), reserved);
}
int control(sqlite3_file* file, int operation, void* argument) {
    return real_of(file)->pMethods->xFileControl(real_of(file), operation, argument);
}
int sector_size(sqlite3_file* file) {
    return real_of(file)->pMethods->xSectorSize(real_of(file));
}
int characteristics(sqlite3_file* file) {
    return real_of(file)->pMethods->xDeviceCharacteristics(real_of(file));
}
int map_shared(sqlite3_file* file, int page, int size, int extend, void volatile** at) {
    return real_of(file)->pMethods->xShmMap(real_of(file), page, size, extend, at);
}
int lock_shared(sqlite3_file* file, int offset, int count, int flags) {
    return real_of(file)->pMethods->xShmLock(real_of(file), offset, count, flags);
}
void order_shared(sqlite3_file* file) {
    real_of(file)->pMethods->xShmBarrier(real_of(file));
}
int unmap_shared(sqlite3_file* file, int remove) {
    return real_of(file)->pMethods->xShmUnmap(real_of(file), remove);
}

// Version 2: shared memory for the write-ahead log, no memory-mapped reading.
const sqlite3_io_methods kMethods = {.iVersion = 2,
                                     .xClose = close_file,
                                     .xRead = read_file,
                                     .xWrite = write_file,
                                     .xTruncate = truncate_file,
                                     .xSync = sync_file,
                                     .xFileSize = file_size,
                                     .xLock = lock,
                                     .xUnlock = unlock,
                                     .xCheckReservedLock = check_lock,
                                     .xFileControl = control,
                                     .xSectorSize = sector_size,
                                     .xDeviceCharacteristics = characteristics,
                                     .xShmMap = map_shared,
                                     .xShmLock = lock_shared,
                                     .xShmBarrier = order_shared,
                                     .xShmUnmap = unmap_shared,
                                     .xFetch = nullptr,
                                     .xUnfetch = nullptr};

int open_file(sqlite3_vfs*,
              const char* name,
              sqlite3_file* file,
              int flags,
              int* granted) {
    file->pMethods = nullptr;
    if (const int result = count_down(); result != SQLITE_OK) return SQLITE_CANTOPEN;
    auto* ours = new (file) File{};
    ours->real_file = reinterpret_cast<sqlite3_file*>(ours + 1);
    const int result = real->xOpen(real, name, ours->real_file, flags, granted);
    ours->base.pMethods = ours->real_file->pMethods == nullptr ? nullptr : &kMethods;
    return result;
}

int delete_file(sqlite3_vfs*, const char* name, int sync_folder) {
    const int result = count_down();
    return result != SQLITE_OK ? result : real->xDelete(real, name, sync_folder);
}

}  // namespace

FailingFiles::FailingFiles() {
    real = sqlite3_vfs_find(nullptr);
    shim = *real;
    shim.zName = "failing";
    shim.szOsFile = static_cast<int>(sizeof(File)) + real->szOsFile;
    shim.xOpen = open_file;
    shim.xDelete = delete_file;
    never_fail();
    sqlite3_vfs_register(&shim, 1);
}

FailingFiles::~FailingFiles() {
    refusals_to_come = 0;
    sqlite3_vfs_unregister(&shim);
    sqlite3_vfs_register(real, 1);
}

void FailingFiles::fail_from(int operation, int result_code) {
    remaining = operation;
    failure = result_code;
    has_failed = false;
}

void FailingFiles::never_fail() { remaining = kNever; }

void FailingFiles::when_lock_is_refused(int times, std::function<void()> act) {
    refusals_to_come = times;
    after_refusals = std::move(act);
}

bool FailingFiles::failed() const { return has_failed; }

}  // namespace haarmony::schema
