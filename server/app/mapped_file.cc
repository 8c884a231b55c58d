#include "server/app/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cstdint>

#include "server/app/file_descriptor.h"

namespace haarmony::server {
namespace {

// madvise() takes what it may write to, though nothing is written here.
void advise(std::span<const std::byte> part, int advice) {
    if (part.empty()) return;
    auto* begin = const_cast<std::byte*>(part.data());
    // A hint: a kernel that does not know it is as good.
    (void)::madvise(begin, part.size(), advice);
}

}  // namespace

Result<std::shared_ptr<const MappedFile>> MappedFile::open(const std::string& path) {
    const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!file) return system_error(path, "opened");
    return of(file.get(), path);
}

Result<std::shared_ptr<const MappedFile>> MappedFile::of(int descriptor,
                                                         const std::string& path) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) return system_error(path, "looked at");
    if (!S_ISREG(status.st_mode)) return Error{ErrorCode::kIo, path + ": is no file"};
    const auto size = static_cast<std::size_t>(status.st_size);
    // Nothing cannot be mapped.
    if (size == 0) return std::shared_ptr<const MappedFile>(new MappedFile({}));
    void* const bytes = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0);
    if (bytes == MAP_FAILED) return system_error(path, "mapped");
    return std::shared_ptr<const MappedFile>(
        new MappedFile({static_cast<const std::byte*>(bytes), size}));
}

MappedFile::~MappedFile() {
    if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

// Not MADV_POPULATE_READ: the kernel then looks at each page by itself, and a pass over 640 MB
// that are in its cache takes 60 ms instead of 50.
void MappedFile::expect(std::span<const std::byte> part) { advise(part, MADV_WILLNEED); }

void MappedFile::forget(std::span<const std::byte> part) { advise(part, MADV_DONTNEED); }

}  // namespace haarmony::server
