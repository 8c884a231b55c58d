// Pictures for the tests: rows as ingest would hand them over, made from a number.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/image_store.h"

namespace haarmony::schema {

// Different numbers give different uris, stamps, signatures and thumbnails.
[[nodiscard]] NewImage file_picture(int number);
[[nodiscard]] NewImage upload_picture(int number);

[[nodiscard]] std::vector<std::uint8_t> some_bytes(int number, std::size_t count);

// A database that must open, and values that must be there; a failure's message becomes
// the exception's.
[[nodiscard]] Database open_database(const std::string& path);

template <typename T>
T expect(Result<T> result);
void expect(Result<void> result);

[[noreturn]] void unexpected(const Error& error);

template <typename T>
T expect(Result<T> result) {
    if (!result) unexpected(result.error());
    return std::move(result).value();
}

}  // namespace haarmony::schema
