#include "server/api/json_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "server/http/json.h"

namespace haarmony::server {
namespace {

// Nothing to escape and nothing to verify.
bool is_plain(char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; }

void append_text(std::string& out, std::string_view text) {
    if (std::ranges::all_of(text, is_plain)) {
        out.append(1, '"').append(text).append(1, '"');
    } else {
        out += http::to_text(text);
    }
}

// The longest int64 has 20 characters, the longest double in fewest digits 24.
using Digits = std::array<char, 32>;

}  // namespace

JsonObject::JsonObject(std::string& out) : out_(out) { out_ += '{'; }

void JsonObject::name(std::string_view name) {
    out_.append(first_ ? "\"" : ",\"").append(name).append("\":");
    first_ = false;
}

JsonObject& JsonObject::text(std::string_view name, std::string_view value) {
    this->name(name);
    append_text(out_, value);
    return *this;
}

JsonObject& JsonObject::text_or_null(std::string_view name, std::string_view value) {
    return value.empty() ? json(name, "null") : text(name, value);
}

JsonObject& JsonObject::texts(std::string_view name,
                              std::span<const std::string> values) {
    this->name(name);
    out_ += '[';
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0) out_ += ',';
        append_text(out_, values[i]);
    }
    out_ += ']';
    return *this;
}

JsonObject& JsonObject::integer(std::string_view name, std::int64_t value) {
    Digits digits{};
    const auto end = std::to_chars(digits.begin(), digits.end(), value);
    return json(name, {digits.data(), end.ptr});
}

JsonObject& JsonObject::number(std::string_view name, double value) {
    if (!std::isfinite(value)) return json(name, "null");
    Digits digits{};
    auto end = std::to_chars(digits.begin(), digits.end() - 2, value).ptr;
    // A number that happens to be whole stays a number with a fraction.
    if (std::string_view(digits.data(), end).find_first_of(".e") ==
        std::string_view::npos) {
        *end++ = '.';
        *end++ = '0';
    }
    return json(name, {digits.data(), end});
}

JsonObject& JsonObject::boolean(std::string_view name, bool value) {
    return json(name, value ? "true" : "false");
}

JsonObject& JsonObject::json(std::string_view name, std::string_view value) {
    this->name(name);
    out_ += value;
    return *this;
}

void JsonObject::end() { out_ += '}'; }

}  // namespace haarmony::server
