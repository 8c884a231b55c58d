// A folder of a test's own, gone with the test, and what lies in it.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace haarmony::schema {

class ScratchFolder {
  public:
    ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::string file(const std::string& name) const;

  private:
    std::string path_;
};

struct FileState {
    std::string bytes;
    std::int64_t mtime_ns = 0;
    bool operator==(const FileState&) const = default;
};

// Every file of a folder by name: equal before and after where nothing was written.
[[nodiscard]] std::map<std::string, FileState> files_of(const ScratchFolder& folder);

[[nodiscard]] std::string read_bytes(const std::string& path);
void write_bytes(const std::string& path, const std::string& bytes);

}  // namespace haarmony::schema
