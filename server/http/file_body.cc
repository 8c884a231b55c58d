#include "server/http/file_body.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace haarmony::http {
namespace {

class OpenFile {
  public:
    explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
    ~OpenFile() { ::close(descriptor_); }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    [[nodiscard]] int descriptor() const { return descriptor_; }

  private:
    const int descriptor_;
};

Error failure(ErrorCode code, std::string message) {
    return Error{.code = code, .message = std::move(message), .param = {}};
}

std::string reason(int error) { return std::generic_category().message(error); }

std::string read_piece(int descriptor, std::uint64_t offset, std::size_t size) {
    std::string piece(size, '\0');
    std::size_t filled = 0;
    while (filled < size) {
        const ssize_t got = ::pread(descriptor,
                                    piece.data() + filled,
                                    size - filled,
                                    static_cast<off_t>(offset + filled));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw std::runtime_error("reading a file: " + reason(errno));
        if (got == 0) throw std::runtime_error("a file became shorter while it was sent");
        filled += static_cast<std::size_t>(got);
    }
    return piece;
}

}  // namespace

Result<ChunkSource> open_file_range(const FileRange& range) {
    // A pipe in the place of the file must not block the thread that opens it.
    const int descriptor = ::open(range.path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) {
        const bool absent = errno == ENOENT || errno == ENOTDIR;
        return absent ? failure(ErrorCode::kNotFound, "The file is gone.")
                      : failure(ErrorCode::kIo, "cannot open a file: " + reason(errno));
    }
    const auto file = std::make_shared<const OpenFile>(descriptor);
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
        return failure(ErrorCode::kIo, "the body is not a regular file");
    }
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (range.offset > size || range.length > size - range.offset) {
        return failure(ErrorCode::kIo,
                       "a range of " + std::to_string(range.length) + " bytes from " +
                           std::to_string(range.offset) + " in a file of " +
                           std::to_string(size));
    }
    return ChunkSource([file,
                        offset = range.offset,
                        left = range.length]() mutable -> std::optional<std::string> {
        if (left == 0) return std::nullopt;
        const auto piece =
            static_cast<std::size_t>(std::min<std::uint64_t>(left, kFileChunk));
        std::string chunk = read_piece(file->descriptor(), offset, piece);
        offset += piece;
        left -= piece;
        return chunk;
    });
}

}  // namespace haarmony::http
