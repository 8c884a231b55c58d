// The project's own sources as text, for the lint tests.
//
// Shape   paths are relative to the project's root, with forward slashes, sorted.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace haarmony::lint {

struct Include {
    int line = 0;
    bool quoted = false;  // "..." rather than <...>
    std::string path;
};

[[nodiscard]] const std::filesystem::path& project_root();

// Every .h and .cc below the given top-level folders.
[[nodiscard]] std::vector<std::string> source_files(
    const std::vector<std::string>& folders);

[[nodiscard]] std::string read_file(const std::string& path);
[[nodiscard]] std::vector<Include> includes_of(const std::string& text);

}  // namespace haarmony::lint
