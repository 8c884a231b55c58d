// A value of a key=value log line: in quotes, on one line, whatever it holds.
#pragma once

#include <string>
#include <string_view>

namespace haarmony::server {

[[nodiscard]] inline std::string log_value(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
        if (c == '"' || c == '\\') quoted.push_back('\\');
        quoted.push_back(control ? ' ' : c);
    }
    return quoted + '"';
}

}  // namespace haarmony::server
