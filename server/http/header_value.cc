#include "server/http/header_value.h"

#include <algorithm>
#include <cstddef>

namespace haarmony::http {
namespace {

constexpr std::size_t kShown = 100;  // bytes of a bad value that an error repeats

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool is_tchar(char c) {
    static constexpr std::string_view kPunctuation = "!#$%&'*+-.^_`|~";
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           kPunctuation.find(c) != std::string_view::npos;
}

Error malformed(std::string_view text) {
    return Error{.code = ErrorCode::kInvalidArgument,
                 .message = "malformed header value: '" +
                            std::string(text.substr(0, kShown)) + "'",
                 .param = {}};
}

void skip_space(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(" \t")));
}

// Takes the quoted string at the front of `rest`; false if it has no end.
bool take_quoted(std::string_view& rest, std::string& text) {
    for (std::size_t i = 1; i < rest.size(); ++i) {
        if (rest[i] == '"') {
            rest.remove_prefix(i + 1);
            return true;
        }
        const bool escape = rest[i] == '\\' && i + 1 < rest.size() &&
                            (rest[i + 1] == '"' || rest[i + 1] == '\\');
        if (escape) ++i;
        text.push_back(rest[i]);
    }
    return false;
}

bool take_value(std::string_view& rest, std::string& text) {
    if (rest.starts_with('"')) return take_quoted(rest, text);
    const std::string_view token = rest.substr(0, rest.find_first_of("; \t"));
    rest.remove_prefix(token.size());
    text = token;
    return is_token(token);
}

}  // namespace

std::string lower_case(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), lower);
    return result;
}

bool equal_without_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
        return lower(x) == lower(y);
    });
}

std::string_view trim(std::string_view text) {
    skip_space(text);
    const std::size_t last = text.find_last_not_of(" \t");
    return last == std::string_view::npos ? std::string_view{} : text.substr(0, last + 1);
}

bool is_token(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), is_tchar);
}

bool has_control(std::string_view text) {
    return std::any_of(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == '\x7f';
    });
}

std::vector<std::string_view> split_list(std::string_view value) {
    std::vector<std::string_view> elements;
    std::size_t start = 0;
    bool quoted = false;
    for (std::size_t i = 0; i <= value.size(); ++i) {
        const bool end = i == value.size() || (value[i] == ',' && !quoted);
        if (end) {
            const std::string_view element = trim(value.substr(start, i - start));
            if (!element.empty()) elements.push_back(element);
            start = i + 1;
        } else if (value[i] == '"') {
            quoted = !quoted;
        }
    }
    return elements;
}

Result<ParameterizedValue> parse_parameterized(std::string_view text) {
    std::string_view rest = text;
    ParameterizedValue parsed;
    const std::string_view value = trim(rest.substr(0, rest.find(';')));
    if (value.empty()) return malformed(text);
    parsed.value = lower_case(value);
    rest.remove_prefix(std::min(rest.size(), rest.find(';')));
    while (!rest.empty()) {
        rest.remove_prefix(1);  // the ';'
        skip_space(rest);
        if (rest.empty()) break;  // "a; " is common and harmless
        const std::string_view name = rest.substr(0, rest.find('='));
        if (!is_token(name) || name.size() == rest.size()) return malformed(text);
        rest.remove_prefix(name.size() + 1);
        std::string argument;
        if (!take_value(rest, argument)) return malformed(text);
        skip_space(rest);
        if (!rest.empty() && rest.front() != ';') return malformed(text);

        std::string key = lower_case(name);
        for (const auto& [other, ignored] : parsed.parameters) {
            if (other == key) return malformed(text);
        }
        parsed.parameters.emplace_back(std::move(key), std::move(argument));
    }
    return parsed;
}

}  // namespace haarmony::http
