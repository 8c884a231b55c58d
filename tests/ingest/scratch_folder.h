// A folder of a test's own that goes away with it.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace haarmony::ingest {

// Long past: no stamp taken of such a file is racy.
inline constexpr std::int64_t kLongAgoNs = 1'000'000'000'000'000'000;

class ScratchFolder {
  public:
    ScratchFolder() {
        std::string pattern =
            (std::filesystem::temp_directory_path() / "haarmony_XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) std::abort();
        path_ = std::filesystem::canonical(pattern).string();
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::string operator/(std::string_view name) const {
        return path_ + '/' + std::string(name);
    }

    // Makes the folders on the way too. Returns the absolute path.
    std::string write(std::string_view name,
                      std::string_view content,
                      std::int64_t mtime_ns = kLongAgoNs) const {
        const std::string path = *this / name;
        std::filesystem::create_directories(std::filesystem::path(path).parent_path());
        std::ofstream(path, std::ios::binary) << content;
        set_mtime(path, mtime_ns);
        return path;
    }
    std::string make_folder(std::string_view name) const {
        std::filesystem::create_directories(*this / name);
        return *this / name;
    }

    static void set_mtime(const std::string& path, std::int64_t mtime_ns) {
        const timespec time{mtime_ns / 1'000'000'000, mtime_ns % 1'000'000'000};
        const timespec times[2] = {time, time};
        ASSERT_EQ(::utimensat(AT_FDCWD, path.c_str(), times, 0), 0) << path;
    }

  private:
    std::string path_;
};

}  // namespace haarmony::ingest
