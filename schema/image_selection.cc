#include "schema/image_selection.h"

#include <utility>

#include "schema/image_store.h"
#include "schema/text_query.h"

namespace haarmony::schema {
namespace {

// ?1 is the id to begin after, ?2 the limit, ?3 the text; the tags follow.
constexpr int kFirstTag = 4;

std::string tag_parameter(std::size_t tag) {
    return "?" + std::to_string(kFirstTag + static_cast<int>(tag));
}

// Every tag from `first` on, by the primary key of image_tags.
std::string other_tags(std::string_view id, std::size_t first, std::size_t count) {
    std::string sql;
    for (std::size_t tag = first; tag < count; ++tag) {
        sql +=
            " AND EXISTS (SELECT 1 FROM image_tags WHERE image_id = " + std::string(id) +
            " AND tag = " + tag_parameter(tag) + ")";
    }
    return sql;
}

}  // namespace

Result<Selection> Selection::make(sqlite3* database,
                                  std::string_view text,
                                  std::span<const std::string> tags) {
    if (tags.size() > kMaxListTags) {
        return Error{ErrorCode::kInvalidArgument,
                     std::to_string(tags.size()) + " tags, at most " +
                         std::to_string(kMaxListTags) + " can be asked for",
                     "tags"};
    }
    if (text.empty()) return Selection({}, tags);
    Result<std::string> query = text_query(database, text);
    if (!query) return std::move(query).error();
    return Selection(std::move(query).value(), tags);
}

std::string Selection::sql() const {
    // The word index holds searchable pictures alone, and gives them in the order of ids.
    if (!query_.empty()) {
        return "SELECT image_text.rowid AS id FROM image_text"
               " WHERE image_text MATCH ?3 AND image_text.rowid > ?1" +
               other_tags("image_text.rowid", 0, tags_.size()) +
               " ORDER BY image_text.rowid LIMIT ?2";
    }
    if (tags_.empty()) {
        return "SELECT id FROM images WHERE state = 'indexed' AND id > ?1"
               " ORDER BY id LIMIT ?2";
    }
    // The first tag leads: its index has the ids in order, so that a rare tag is not sought
    // among all pictures.
    return "SELECT leading.image_id AS id FROM image_tags AS leading"
           " JOIN images ON images.id = leading.image_id"
           " WHERE leading.tag = " +
           tag_parameter(0) + " AND leading.image_id > ?1 AND state = 'indexed'" +
           other_tags("leading.image_id", 1, tags_.size()) +
           " ORDER BY leading.image_id LIMIT ?2";
}

void Selection::bind(Statement& statement,
                     std::optional<ImageId> after,
                     std::int64_t limit) const {
    statement.bind(1, after ? to_int(*after) : 0);
    statement.bind(2, limit);
    if (!query_.empty()) statement.bind(3, query_);
    for (std::size_t tag = 0; tag < tags_.size(); ++tag) {
        statement.bind(kFirstTag + static_cast<int>(tag), tags_[tag]);
    }
}

}  // namespace haarmony::schema
