// A folder to write the files of one test into, and bytes to fill them with.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "tests/support/temporary_folder.h"

namespace haarmony::http::test {

class ScratchFolder : public haarmony::testing::TemporaryFolder {
  public:
    // Writes a file below the folder and returns its path.
    std::string write(const std::filesystem::path& name, std::string_view content) const {
        const std::filesystem::path file = path() / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << content;
        return file.string();
    }
};

// Bytes in which no stretch repeats within 64 kB, so that a wrong offset shows.
inline std::string pattern(std::size_t size) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) {
        bytes[i] = static_cast<char>((i * 2654435761U) >> 13U);
    }
    return bytes;
}

}  // namespace haarmony::http::test
