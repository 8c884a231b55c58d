#include "tests/schema/scratch_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace haarmony::schema {
namespace {

// In memory where there is such a file system: nothing here loses power, and a disk that
// others keep busy would make every commit wait.
std::string parent_folder() {
    constexpr const char* kMemory = "/dev/shm/";
    return access(kMemory, W_OK | X_OK) == 0 ? kMemory : testing::TempDir();
}

}  // namespace

ScratchFolder::ScratchFolder() : path_(parent_folder() + "schema_XXXXXX") {
    if (mkdtemp(path_.data()) == nullptr) throw std::runtime_error("mkdtemp " + path_);
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string ScratchFolder::file(const std::string& name) const {
    return path_ + "/" + name;
}

std::map<std::string, FileState> files_of(const ScratchFolder& folder) {
    std::map<std::string, FileState> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        struct stat status {};
        if (stat(entry.path().c_str(), &status) != 0) continue;
        const std::int64_t mtime_ns =
            std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
        files[entry.path().filename()] = {read_bytes(entry.path()), mtime_ns};
    }
    return files;
}

std::string read_bytes(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_bytes(const std::string& path, const std::string& bytes) {
    std::ofstream stream(path, std::ios::binary | std::ios::trunc);
    stream << bytes;
    stream.close();
    if (!stream) throw std::runtime_error("cannot write " + path);
}

}  // namespace haarmony::schema
