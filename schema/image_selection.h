// The searchable pictures that a text and tags select, as a statement that gives their ids
// in rising order.
//
// Errors   kInvalidArgument for more than kMaxListTags tags and as text_query.h.
// Threads  as the connection.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/ids.h"
#include "engine/core/result.h"
#include "schema/statement.h"

namespace haarmony::schema {

class Selection {
  public:
    static constexpr std::int64_t kNoLimit = -1;

    // An empty text and no tags select every searchable picture. Requires: `tags` outlives
    // the selection, and the selection every statement that it is bound to.
    [[nodiscard]] static Result<Selection> make(sqlite3* database,
                                                std::string_view text,
                                                std::span<const std::string> tags);

    // One column, named id.
    [[nodiscard]] std::string sql() const;
    // The parameters of sql(), which may be a part of `statement`.
    void bind(Statement& statement,
              std::optional<ImageId> after,
              std::int64_t limit) const;

  private:
    Selection(std::string query, std::span<const std::string> tags)
        : query_(std::move(query)), tags_(tags) {}

    std::string query_;  // of the full-text search; empty where there is no text
    std::span<const std::string> tags_;
};

}  // namespace haarmony::schema
