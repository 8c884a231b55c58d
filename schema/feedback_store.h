// Training pairs in the database: what somebody drew or scanned, and the picture that was
// meant by it.
//
// Shape    signatures are bytes and strokes JSON that this folder does not understand.
// Errors   kNotFound for an unknown id and for a target that is not searchable;
//          kInvalidArgument for a value that the table refuses (a kind that is not 1 to 64
//          characters, neither signature nor strokes, strokes that are no JSON, seconds below
//          0 or not finite); kUnavailable and kIo as in image_store.h.
// Threads  as Database; never inside ImageStore::transaction().
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/ids.h"
#include "engine/core/result.h"
#include "schema/database.h"

namespace haarmony::schema {

struct NewFeedback {
    std::string kind;  // "painted", "scanned" or any other word
    ImageId target{};
    std::vector<std::uint8_t> signature;  // of the query; empty: not known
    std::string strokes;                  // JSON; empty: nothing was drawn
    std::optional<double> seconds;        // until the target was found
};

struct Feedback : NewFeedback {
    std::int64_t id = 0;     // >= 1, never used again
    std::string created_at;  // RFC 3339, UTC
};

class FeedbackStore {
  public:
    explicit FeedbackStore(Database& database) : cache_(database.handle()) {}

    [[nodiscard]] Result<std::int64_t> add(const NewFeedback& feedback);
    // Of one kind, or of all, in the order of ids, only ids above `after`, at most `limit`
    // (>= 1). Pairs whose target cannot be searched now are left out.
    [[nodiscard]] Result<std::vector<Feedback>> list(std::optional<std::string_view> kind,
                                                     std::optional<std::int64_t> after,
                                                     int limit);
    // As many as list() would give without a limit.
    [[nodiscard]] Result<std::int64_t> count(std::optional<std::string_view> kind);
    [[nodiscard]] Result<void> remove(std::int64_t id);

  private:
    StatementCache cache_;
};

}  // namespace haarmony::schema
