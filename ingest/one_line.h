// A foreign library's message as one printable line, for our errors.
#pragma once

#include <string>
#include <string_view>

namespace haarmony::ingest {

inline constexpr std::size_t kMaxMessage = 300;

// Control characters become blanks, runs of blanks one; at most kMaxMessage bytes.
[[nodiscard]] inline std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const bool blank = static_cast<unsigned char>(c) <= ' ' || c == '\x7f';
        if (blank && (line.empty() || line.back() == ' ')) continue;
        if (line.size() == kMaxMessage) break;
        line.push_back(blank ? ' ' : c);
    }
    if (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
}

}  // namespace haarmony::ingest
