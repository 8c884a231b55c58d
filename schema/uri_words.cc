#include "schema/uri_words.h"

#include <sqlite3.h>

#include <optional>

#include "schema/sqlite_error.h"

namespace haarmony::schema {
namespace {

std::optional<unsigned> hex_digit(char digit) {
    if (digit >= '0' && digit <= '9') return digit - '0';
    if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
    if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
    return std::nullopt;
}

void haarmony_words(sqlite3_context* context, int, sqlite3_value** arguments) {
    const auto* start = reinterpret_cast<const char*>(sqlite3_value_text(arguments[0]));
    const auto length = static_cast<std::size_t>(sqlite3_value_bytes(arguments[0]));
    const std::string words = uri_words(
        start == nullptr ? std::string_view{} : std::string_view(start, length));
    sqlite3_result_text64(
        context, words.data(), words.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
}

}  // namespace

std::string uri_words(std::string_view uri) {
    // The scheme is the same word for every file.
    constexpr std::string_view kAfterScheme = "://";
    const std::size_t scheme = uri.find(kAfterScheme);
    if (scheme != std::string_view::npos && uri.find('/') == scheme + 1) {
        uri.remove_prefix(scheme + kAfterScheme.size());
    }
    std::string words;
    words.reserve(uri.size());
    for (std::size_t at = 0; at < uri.size(); ++at) {
        char byte = uri[at];
        if (byte == '%' && at + 2 < uri.size()) {
            const auto high = hex_digit(uri[at + 1]);
            const auto low = hex_digit(uri[at + 2]);
            if (high && low) {
                byte = static_cast<char>(*high * 16 + *low);
                at += 2;
            }
        }
        words += byte == '\0' ? ' ' : byte;
    }
    return words;
}

Result<void> register_uri_words(sqlite3* database) {
    const int result =
        sqlite3_create_function_v2(database,
                                   "haarmony_words",
                                   1,
                                   SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_INNOCUOUS,
                                   nullptr,
                                   haarmony_words,
                                   nullptr,
                                   nullptr,
                                   nullptr);
    if (result != SQLITE_OK) return sqlite_error(database, result);
    return {};
}

}  // namespace haarmony::schema
