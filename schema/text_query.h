// What a user types into a search box, as an expression of SQLite's full-text search.
//
//   cat "red car" summ*     the word cat, the phrase red car and a word that starts with summ
//
// Pieces stand between white space (ASCII); all must match. A quote opens a phrase up to the
// next one, or to the end. A star right after a word or a phrase makes its last word a
// prefix. A piece of several words, as my-cat or IMG_7, is a phrase of them. All else is
// data: no operator and no syntax error of the full-text search can be typed. Pieces without
// a letter or digit are passed over.
//
// Errors   kInvalidArgument naming the text, where it has no word at all or is too long.
// Threads  as the connection.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/core/result.h"

struct sqlite3;

namespace haarmony::schema {

inline constexpr std::size_t kMaxTextBytes = 1024;

// For `... MATCH ?` on image_text. What a word is, the index's own tokenizer says.
[[nodiscard]] Result<std::string> text_query(sqlite3* database, std::string_view text);

}  // namespace haarmony::schema
