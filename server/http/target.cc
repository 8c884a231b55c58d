#include "server/http/target.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace haarmony::http {
namespace {

constexpr std::size_t kShown = 100;  // bytes of a bad target that an error repeats

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

Error bad_target(std::string_view what, std::string_view text) {
    return Error{
        .code = ErrorCode::kInvalidArgument,
        .message = std::string(what) + ": '" + std::string(text.substr(0, kShown)) + "'"};
}

Result<std::string> decode(std::string_view text, bool in_query) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        char c = text[i];
        if (in_query && c == '+') {
            c = ' ';
        } else if (c == '%') {
            const int high = i + 2 < text.size() ? hex_value(text[i + 1]) : -1;
            const int low = i + 2 < text.size() ? hex_value(text[i + 2]) : -1;
            if (high < 0 || low < 0) return bad_target("malformed percent escape", text);
            c = static_cast<char>(high * 16 + low);
            i += 2;
            if (c == '/' && !in_query)
                return bad_target("encoded slash in the path", text);
        }
        if (c == '\0') return bad_target("NUL in the address", text);
        decoded.push_back(c);
    }
    if (!is_utf8(decoded)) return bad_target("address that is not UTF-8", text);
    return decoded;
}

// The part of an absolute form after its authority, or nothing if it is not one.
std::optional<std::string_view> after_authority(std::string_view target) {
    for (const std::string_view scheme : {"http://", "https://"}) {
        if (!target.starts_with(scheme)) continue;
        target.remove_prefix(scheme.size());
        const std::size_t end = target.find_first_of("/?");
        if (target.empty() || end == 0) return std::nullopt;
        return end == std::string_view::npos ? std::string_view{} : target.substr(end);
    }
    return std::nullopt;
}

}  // namespace

Result<Target> parse_target(std::string_view target) {
    if (target == "*") return Target{.path = "*", .query = {}};
    const std::string_view whole = target;
    if (!target.starts_with('/')) {
        const std::optional<std::string_view> rest = after_authority(target);
        if (!rest) return bad_target("request target is no path", whole);
        target = *rest;
    }
    const std::size_t mark = target.find('?');
    Result<std::string> path = decode(target.substr(0, mark), false);
    if (!path) return std::move(path).error();

    Target parsed{.path = path->empty() ? "/" : *std::move(path), .query = {}};
    std::string_view rest =
        mark == std::string_view::npos ? std::string_view{} : target.substr(mark + 1);
    while (!rest.empty()) {
        const std::string_view pair = rest.substr(0, rest.find('&'));
        rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
        if (pair.empty()) continue;
        const std::size_t equals = pair.find('=');
        Result<std::string> name = decode(pair.substr(0, equals), true);
        if (!name) return std::move(name).error();
        Result<std::string> value =
            decode(equals == std::string_view::npos ? std::string_view{}
                                                    : pair.substr(equals + 1),
                   true);
        if (!value) return std::move(value).error();
        parsed.query.emplace_back(*std::move(name), *std::move(value));
    }
    return parsed;
}

std::string encode_path(std::string_view path) {
    static constexpr std::string_view kHex = "0123456789ABCDEF";
    static constexpr std::string_view kKept = "-._~/!$&'()*+,;=:@";
    std::string encoded;
    encoded.reserve(path.size());
    for (const char c : path) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') ||
                           kKept.find(c) != std::string_view::npos;
        if (plain) {
            encoded.push_back(c);
        } else {
            const auto byte = static_cast<std::uint8_t>(c);
            encoded.push_back('%');
            encoded.push_back(kHex[byte >> 4U]);
            encoded.push_back(kHex[byte & 15U]);
        }
    }
    return encoded;
}

bool is_utf8(std::string_view bytes) {
    std::size_t i = 0;
    while (i < bytes.size()) {
        const auto first = static_cast<std::uint8_t>(bytes[i]);
        if (first < 0x80) {
            ++i;
            continue;
        }
        const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
        if (first < 0xC2 || first > 0xF4 || i + length > bytes.size()) return false;
        std::uint32_t point = first & (0xFFU >> (length + 1));
        for (std::size_t k = 1; k < length; ++k) {
            const auto next = static_cast<std::uint8_t>(bytes[i + k]);
            if ((next & 0xC0U) != 0x80U) return false;
            point = (point << 6U) | (next & 0x3FU);
        }
        const bool overlong =
            (length == 3 && point < 0x800) || (length == 4 && point < 0x10000);
        const bool surrogate = point >= 0xD800 && point <= 0xDFFF;
        if (overlong || surrogate || point > 0x10FFFF) return false;
        i += length;
    }
    return true;
}

}  // namespace haarmony::http
