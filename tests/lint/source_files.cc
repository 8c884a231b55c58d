#include "tests/lint/source_files.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

namespace haarmony::lint {

namespace fs = std::filesystem;

const fs::path& project_root() {
    static const fs::path root = HAARMONY_SOURCE_DIR;
    return root;
}

std::vector<std::string> source_files(const std::vector<std::string>& folders) {
    std::vector<std::string> paths;
    for (const std::string& folder : folders) {
        if (!fs::exists(project_root() / folder)) continue;
        for (const auto& entry :
             fs::recursive_directory_iterator(project_root() / folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cc") continue;
            paths.push_back(
                entry.path().lexically_relative(project_root()).generic_string());
        }
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

std::string read_file(const std::string& path) {
    std::ifstream file(project_root() / path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return std::move(text).str();
}

std::vector<Include> includes_of(const std::string& text) {
    static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
    std::vector<Include> includes;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::smatch match;
        if (std::regex_search(line, match, pattern)) {
            includes.push_back({number, match[1] == "\"", match[2]});
        }
    }
    return includes;
}

}  // namespace haarmony::lint
