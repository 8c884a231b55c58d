// The pieces that header values are made of (RFC 9110 section 5.6).
//
// Errors  kInvalidArgument with the value.
// Threads const-safe.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/result.h"

namespace haarmony::http {

// ASCII only: header names and media types mean the same in every locale.
[[nodiscard]] std::string lower_case(std::string_view text);
[[nodiscard]] bool equal_without_case(std::string_view a, std::string_view b);

// Without spaces and tabs at both ends.
[[nodiscard]] std::string_view trim(std::string_view text);

[[nodiscard]] bool is_token(std::string_view text);     // at least one tchar, no other
[[nodiscard]] bool has_control(std::string_view text);  // a control character but tab

// The elements of "a, b, c", trimmed, empty ones left out; commas in quotes do not count.
[[nodiscard]] std::vector<std::string_view> split_list(std::string_view value);

// "form-data; name=a; filename=\"b\"": the value and the names of parameters in lower case.
struct ParameterizedValue {
    std::string value;
    std::vector<std::pair<std::string, std::string>> parameters;
};

// In quotes, \" and \\ are escapes; any other backslash stands for itself, as browsers
// write the file names of Windows. A parameter that appears twice is an error.
[[nodiscard]] Result<ParameterizedValue> parse_parameterized(std::string_view text);

}  // namespace haarmony::http
