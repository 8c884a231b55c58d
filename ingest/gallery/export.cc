#include "ingest/gallery/export.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <mutex>
#include <optional>
#include <span>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "engine/core/image_view.h"
#include "ingest/gallery/gallery.h"
#include "ingest/thumbnail.h"

namespace haarmony::gallery {
namespace {

// Foliage and grain show blocks below this; above it files grow faster than they gain.
constexpr int kQuality = 90;

using Bytes = std::vector<std::uint8_t>;

Error io_error(const char* what, const std::filesystem::path& path, int number) {
    return {ErrorCode::kIo,
            std::string("cannot ") + what + " \"" + path.string() +
                "\": " + std::generic_category().message(number)};
}

class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] int get() const { return fd_; }
    // The error number of closing, where late write errors are told.
    [[nodiscard]] int close() { return ::close(std::exchange(fd_, -1)) == 0 ? 0 : errno; }

  private:
    int fd_;
};

bool holds(const std::filesystem::path& path, const Bytes& bytes) {
    std::error_code ignored;
    if (std::filesystem::file_size(path, ignored) != bytes.size() || ignored)
        return false;
    std::ifstream file(path, std::ios::binary);
    return std::equal(
        bytes.begin(),
        bytes.end(),
        std::istreambuf_iterator<char>(file),
        std::istreambuf_iterator<char>(),
        [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); });
}

Result<void> write_all(const std::filesystem::path& path, const Bytes& bytes) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.get() < 0) return io_error("create", path, errno);
    std::span<const std::uint8_t> rest = bytes;
    while (!rest.empty()) {
        const ssize_t written = ::write(file.get(), rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return io_error("write", path, errno);
        rest = rest.subspan(static_cast<std::size_t>(written));
    }
    if (const int number = file.close(); number != 0)
        return io_error("write", path, number);
    return {};
}

Result<void> replace(const std::filesystem::path& path, const Bytes& bytes) {
    const auto part = path.parent_path() / ("." + path.filename().string() + ".part");
    Result<void> done = write_all(part, bytes);
    if (done && ::rename(part.c_str(), path.c_str()) != 0)
        done = io_error("replace", path, errno);
    if (!done) ::unlink(part.c_str());
    return done;
}

// Returns whether the file had to be written.
Result<bool> export_picture(const ExportOptions& options, int number) {
    const Painting painting = paint(
        options.seed, number, options.side.value_or(gallery_side(options.seed, number)));
    const ImageView view{painting.rgb.data(),
                         painting.width,
                         painting.height,
                         3,
                         static_cast<std::ptrdiff_t>(painting.width) * 3};
    Result<Bytes> jpeg = ingest::encode_jpeg(view, kQuality);
    if (!jpeg) return std::move(jpeg).error();
    const auto path = options.folder / file_name(painting.kind, number);
    if (holds(path, *jpeg)) return false;
    if (Result<void> done = replace(path, *jpeg); !done) return std::move(done).error();
    return true;
}

}  // namespace

std::string file_name(const std::string& kind, int number) {
    std::string name = kind;
    std::replace(name.begin(), name.end(), ' ', '-');
    std::string digits = std::to_string(number + 1);
    if (digits.size() < 3) digits.insert(0, 3 - digits.size(), '0');
    return name + "-" + digits + ".jpg";
}

Result<ExportReport> export_gallery(const ExportOptions& options) {
    assert(options.count >= 1 && options.count <= kMostPictures);
    assert(options.jobs >= 1 && options.jobs <= kMostJobs);
    std::error_code failed;
    std::filesystem::create_directories(options.folder, failed);
    if (failed) return io_error("make the folder", options.folder, failed.value());
    const Descriptor folder(
        ::open(options.folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.get() < 0) return io_error("open the folder", options.folder, errno);
    while (::flock(folder.get(), LOCK_EX) != 0)
        if (errno != EINTR) return io_error("lock the folder", options.folder, errno);

    std::atomic<int> next{0};
    std::atomic<int> written{0};
    std::atomic<bool> stop{false};
    std::mutex mutex;
    std::optional<Error> error;  // the first; guarded by mutex
    const auto work = [&] {
        while (!stop) {
            const int number = next++;
            if (number >= options.count) return;
            Result<bool> done = export_picture(options, number);
            if (done) {
                written += *done ? 1 : 0;
                continue;
            }
            stop = true;
            const std::lock_guard lock(mutex);
            if (!error) error = std::move(done).error();
        }
    };
    {
        std::vector<std::jthread> workers;
        for (int i = 1; i < std::min(options.jobs, options.count); ++i)
            workers.emplace_back(work);
        work();
    }
    if (error) return *std::move(error);
    return ExportReport{written, options.count - written};
}

}  // namespace haarmony::gallery
