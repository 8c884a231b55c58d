#include "schema/text_query.h"

#include <sqlite3.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "schema/sqlite_error.h"

namespace haarmony::schema {
namespace {

// As 0004_text_search.sql gives it to the index.
constexpr const char* kTokenizer = "unicode61";
const char* kTokenizerArguments[] = {"remove_diacritics", "2"};

struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

Result<fts5_api*> full_text_search(sqlite3* database) {
    sqlite3_stmt* prepared = nullptr;
    int result = sqlite3_prepare_v2(database, "SELECT fts5(?1)", -1, &prepared, nullptr);
    const std::unique_ptr<sqlite3_stmt, Finalize> statement(prepared);
    fts5_api* api = nullptr;
    if (result == SQLITE_OK) {
        result = sqlite3_bind_pointer(prepared, 1, &api, "fts5_api_ptr", nullptr);
    }
    if (result == SQLITE_OK) result = sqlite3_step(prepared);
    if (result != SQLITE_ROW) return sqlite_error(database, result);
    return api;
}

// The tokenizer of the index, to ask it whether there is a word in a text.
class Tokenizer {
  public:
    [[nodiscard]] static Result<Tokenizer> make(sqlite3* database) {
        const Result<fts5_api*> api = full_text_search(database);
        if (!api) return api.error();
        Tokenizer made;
        void* context = nullptr;
        int result = (*api)->xFindTokenizer(*api, kTokenizer, &context, &made.functions_);
        if (result != SQLITE_OK) return sqlite_error(database, result);
        Fts5Tokenizer* instance = nullptr;
        result = made.functions_.xCreate(context, kTokenizerArguments, 2, &instance);
        if (result != SQLITE_OK) return sqlite_error(database, result);
        made.instance_ = {instance, made.functions_.xDelete};
        return made;
    }

    [[nodiscard]] bool has_word(std::string_view text) const {
        bool found = false;
        // The callback ends it at the first word; there is no other result than that.
        functions_.xTokenize(instance_.get(),
                             &found,
                             FTS5_TOKENIZE_QUERY,
                             text.data(),
                             static_cast<int>(text.size()),
                             [](void* flag, int, const char*, int, int, int) {
                                 *static_cast<bool*>(flag) = true;
                                 return SQLITE_DONE;
                             });
        return found;
    }

  private:
    Tokenizer() = default;

    fts5_tokenizer functions_{};
    std::unique_ptr<Fts5Tokenizer, void (*)(Fts5Tokenizer*)> instance_{nullptr, nullptr};
};

struct Piece {
    std::string text;
    bool is_prefix = false;
};

bool is_space(char character) {
    return std::string_view(" \t\n\v\f\r\0", 7).find(character) != std::string_view::npos;
}

std::vector<Piece> pieces_of(std::string_view text) {
    std::vector<Piece> pieces;
    std::size_t at = 0;
    while (at < text.size()) {
        if (is_space(text[at])) {
            ++at;
        } else if (text[at] == '"') {
            const std::size_t end = std::min(text.find('"', at + 1), text.size());
            Piece& piece = pieces.emplace_back();
            piece.text = text.substr(at + 1, end - at - 1);
            at = end + 1;
            if (at < text.size() && text[at] == '*') {
                piece.is_prefix = true;
                ++at;
            }
        } else {
            const std::size_t start = at;
            while (at < text.size() && !is_space(text[at]) && text[at] != '"') ++at;
            std::string_view word = text.substr(start, at - start);
            const bool is_prefix = word.ends_with('*');
            if (is_prefix) word.remove_suffix(1);
            pieces.push_back({std::string(word), is_prefix});
        }
    }
    return pieces;
}

// A string of the full-text search. It holds no quote (they end a piece), and an expression
// ends at a NUL.
std::string quoted(std::string text) {
    for (char& character : text) {
        if (character == '\0') character = ' ';
    }
    return '"' + text + '"';
}

Error refused(std::string_view text, const std::string& reason) {
    return Error{ErrorCode::kInvalidArgument,
                 "the text \"" + std::string(text) + "\" " + reason,
                 "text"};
}

}  // namespace

Result<std::string> text_query(sqlite3* database, std::string_view text) {
    if (text.size() > kMaxTextBytes) {
        return refused(text.substr(0, 40),
                       "... has " + std::to_string(text.size()) + " bytes, more than " +
                           std::to_string(kMaxTextBytes));
    }
    const Result<Tokenizer> tokenizer = Tokenizer::make(database);
    if (!tokenizer) {
        return while_doing("cannot split a text into words", tokenizer.error());
    }
    std::string query;
    for (Piece& piece : pieces_of(text)) {
        if (!tokenizer->has_word(piece.text)) continue;
        if (!query.empty()) query += ' ';
        query += quoted(std::move(piece.text));
        if (piece.is_prefix) query += '*';
    }
    if (query.empty()) return refused(text, "has no word to search for");
    return query;
}

}  // namespace haarmony::schema
