#include "schema/file_header.h"

#include <sqlite3.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>

#include "schema/database.h"
#include "schema/migrate.h"

namespace haarmony::schema {
namespace {

constexpr std::size_t kHeaderBytes = 100;
constexpr std::string_view kMagic("SQLite format 3\0", 16);
constexpr std::size_t kUserVersionAt = 60;
constexpr std::size_t kApplicationIdAt = 68;

using Header = std::array<unsigned char, kHeaderBytes>;

std::int32_t big_endian(const Header& header, std::size_t at) {
    return static_cast<std::int32_t>(
        (std::uint32_t{header[at]} << 24) | (std::uint32_t{header[at + 1]} << 16) |
        (std::uint32_t{header[at + 2]} << 8) | std::uint32_t{header[at + 3]});
}

Error system_error(const std::string& path, int number) {
    return Error{ErrorCode::kIo, path + ": " + std::generic_category().message(number)};
}

// Absolute, symbolic links resolved: what SQLite makes the names beside the file from.
Result<std::string> full_path_of(const std::string& path) {
    sqlite3_vfs* vfs = sqlite3_vfs_find(nullptr);
    std::string full_path(static_cast<std::size_t>(vfs->mxPathname) + 1, '\0');
    const int result = vfs->xFullPathname(
        vfs, path.c_str(), static_cast<int>(full_path.size()), full_path.data());
    // The low byte: SQLITE_OK_SYMLINK is a success too.
    if ((result & 0xff) != SQLITE_OK) {
        return Error{ErrorCode::kIo, path + ": " + sqlite3_errstr(result)};
    }
    full_path.resize(std::strlen(full_path.c_str()));
    return full_path;
}

// A loss of power in the middle of the very first transaction may leave pages in the file
// and the first one empty. Its journal then says that there was nothing before, and SQLite
// takes the file back to that. (The journal carries no locks: see read_header.)
bool is_unfinished_creation(const Header& header, const std::string& full_path) {
    constexpr std::string_view kJournalMagic("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);
    constexpr std::size_t kPagesBeforeAt = 16;
    const auto is_zero = [](auto byte) { return byte == 0; };
    if (!std::all_of(header.begin(), header.end(), is_zero)) return false;

    std::array<char, kPagesBeforeAt + 4> journal{};
    std::ifstream stream(full_path + "-journal", std::ios::binary);
    if (!stream.read(journal.data(), journal.size())) return false;
    return std::memcmp(journal.data(), kJournalMagic.data(), kJournalMagic.size()) == 0 &&
           std::all_of(journal.begin() + kPagesBeforeAt, journal.end(), is_zero);
}

// Through SQLite's own file layer, never open() and close(): closing any descriptor of a
// file drops every POSIX lock that this process holds on it, those of its open connections
// too, and another process could then delete the -wal under them. SQLite's layer puts off
// the close until those locks are gone.
Result<Header> read_header(const std::string& path, const std::string& full_path) {
    sqlite3_vfs* vfs = sqlite3_vfs_find(nullptr);
    struct FreeName {
        void operator()(const char* name) const { sqlite3_free_filename(name); }
    };
    const std::unique_ptr<const char, FreeName> name(
        sqlite3_create_filename(full_path.data(), "", "", 0, nullptr));
    if (name == nullptr) throw std::bad_alloc();

    struct Free {
        void operator()(void* memory) const { sqlite3_free(memory); }
    };
    const std::unique_ptr<sqlite3_file, Free> file(
        static_cast<sqlite3_file*>(sqlite3_malloc(vfs->szOsFile)));
    if (file == nullptr) throw std::bad_alloc();
    std::memset(file.get(), 0, static_cast<std::size_t>(vfs->szOsFile));

    int result = vfs->xOpen(
        vfs, name.get(), file.get(), SQLITE_OPEN_READONLY | SQLITE_OPEN_MAIN_DB, nullptr);
    if (result != SQLITE_OK) {
        const int number = vfs->xGetLastError(vfs, 0, nullptr);
        return number != 0 ? system_error(path, number)
                           : Error{ErrorCode::kIo, path + ": " + sqlite3_errstr(result)};
    }
    Header header{};
    result = file->pMethods->xRead(file.get(), header.data(), kHeaderBytes, 0);
    file->pMethods->xClose(file.get());
    // A shorter file comes back padded with zeros, and so has no magic or no application.
    if (result != SQLITE_OK && result != SQLITE_IOERR_SHORT_READ) {
        return Error{ErrorCode::kIo, path + ": " + sqlite3_errstr(result)};
    }
    return header;
}

}  // namespace

Result<FilePresence> inspect_file(const std::string& path, int newest) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        if (errno == ENOENT) return FilePresence::kAbsent;
        return system_error(path, errno);
    }
    if (S_ISDIR(status.st_mode)) return system_error(path, EISDIR);
    if (!S_ISREG(status.st_mode)) {
        return Error{ErrorCode::kIo, path + ": not a regular file"};
    }
    if (status.st_size == 0) return FilePresence::kAbsent;

    const Result<std::string> full_path = full_path_of(path);
    if (!full_path) return full_path.error();
    const Result<Header> header = read_header(path, *full_path);
    if (!header) return header.error();
    if (is_unfinished_creation(*header, *full_path)) return FilePresence::kAbsent;
    if (std::memcmp(header->data(), kMagic.data(), kMagic.size()) != 0) {
        return Error{ErrorCode::kNotADatabase, path + ": not a Haarmony database"};
    }
    const std::int32_t application = big_endian(*header, kApplicationIdAt);
    if (application != kApplicationId) return foreign_database(path, application);
    const std::int32_t version = big_endian(*header, kUserVersionAt);
    if (version > newest) return newer_version(path, version, newest);
    return FilePresence::kOurs;
}

}  // namespace haarmony::schema
