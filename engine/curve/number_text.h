// Numbers as text that every format of ours reads: "." whatever the locale, as few digits as
// bring back the same double.
//   [number_text.h] -> bezier_text.h, geojson.h
//
// Errors   none. Requires: finite.
// Threads  const-thread-safe.
#pragma once

#include <charconv>
#include <string>

namespace haarmony::curve {

inline void append_number(std::string& text, double value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    text.append(digits, end);
}

[[nodiscard]] inline std::string number_text(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

}  // namespace haarmony::curve
