#include "schema/feedback_store.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "schema/sqlite_error.h"

namespace haarmony::schema {
namespace {

// No row where the target is not there.
constexpr std::string_view kAdd =
    "INSERT INTO feedback (kind, target, signature, strokes, seconds, created_at)"
    " SELECT ?1, id, ?3, ?4, ?5, strftime('%Y-%m-%dT%H:%M:%fZ', 'now')"
    " FROM images WHERE id = ?2 AND state = 'indexed' RETURNING id";

// ?1 is the kind; a statement for all kinds has none.
std::string sql_of(std::string_view columns, bool one_kind, std::string_view rest) {
    return "SELECT " + std::string(columns) +
           " FROM feedback CROSS JOIN images ON images.id = feedback.target"
           " WHERE state = 'indexed'" +
           (one_kind ? " AND kind = ?1" : "") + std::string(rest);
}

Feedback feedback_of(const Statement& row) {
    Feedback feedback;
    feedback.id = row.integer(0);
    feedback.kind = row.text(1);
    feedback.target = ImageId{row.integer(2)};
    const auto signature = row.bytes(3);
    feedback.signature.assign(signature.begin(), signature.end());
    feedback.strokes = row.text(4);
    if (!row.is_null(5)) feedback.seconds = row.real(5);
    feedback.created_at = row.text(6);
    return feedback;
}

}  // namespace

Result<std::int64_t> FeedbackStore::add(const NewFeedback& feedback) {
    const auto failed = [&](Error error) {
        return while_doing("cannot add feedback \"" + feedback.kind + '"',
                           std::move(error));
    };
    // SQLite has no NaN: it would be stored as no time.
    if (feedback.seconds && std::isnan(*feedback.seconds)) {
        return failed(Error{ErrorCode::kInvalidArgument,
                            std::to_string(*feedback.seconds) + " seconds are no time",
                            "seconds"});
    }
    auto statement = cache_.borrow(kAdd);
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, feedback.kind);
    (*statement)->bind(2, to_int(feedback.target));
    if (!feedback.signature.empty()) (*statement)->bind(3, feedback.signature);
    if (!feedback.strokes.empty()) (*statement)->bind(4, feedback.strokes);
    if (feedback.seconds) (*statement)->bind_real(5, *feedback.seconds);
    const auto id = (*statement)->run_returning();
    if (!id) return failed(id.error());
    if (!id->has_value()) {
        return Error{ErrorCode::kNotFound,
                     "no image " + std::to_string(to_int(feedback.target)),
                     "target"};
    }
    return **id;
}

Result<std::vector<Feedback>> FeedbackStore::list(std::optional<std::string_view> kind,
                                                  std::optional<std::int64_t> after,
                                                  int limit) {
    assert(limit >= 1);
    const auto failed = [](Error error) {
        return while_doing("cannot list the feedback", std::move(error));
    };
    auto statement = cache_.borrow(
        sql_of("feedback.id, kind, target, feedback.signature, strokes, seconds,"
               " created_at",
               kind.has_value(),
               " AND feedback.id > ?2 ORDER BY feedback.id LIMIT ?3"));
    if (!statement) return failed(std::move(statement).error());
    if (kind) (*statement)->bind(1, *kind);
    (*statement)->bind(2, after.value_or(0));
    (*statement)->bind(3, limit);
    std::vector<Feedback> all;
    for (;;) {
        const Result<bool> row = (*statement)->step();
        if (!row) return failed(row.error());
        if (!*row) return all;
        all.push_back(feedback_of(**statement));
    }
}

Result<std::int64_t> FeedbackStore::count(std::optional<std::string_view> kind) {
    const auto failed = [](Error error) {
        return while_doing("cannot count the feedback", std::move(error));
    };
    auto statement = cache_.borrow(sql_of("count(*)", kind.has_value(), ""));
    if (!statement) return failed(std::move(statement).error());
    if (kind) (*statement)->bind(1, *kind);
    const Result<bool> row = (*statement)->step();
    if (!row) return failed(row.error());
    return (*statement)->integer(0);
}

Result<void> FeedbackStore::remove(std::int64_t id) {
    const std::string name = "feedback " + std::to_string(id);
    const auto failed = [&](Error error) {
        return while_doing("cannot remove " + name, std::move(error));
    };
    auto statement = cache_.borrow("DELETE FROM feedback WHERE id = ?1 RETURNING id");
    if (!statement) return failed(std::move(statement).error());
    (*statement)->bind(1, id);
    const auto removed = (*statement)->run_returning();
    if (!removed) return failed(removed.error());
    if (!removed->has_value()) return Error{ErrorCode::kNotFound, "no " + name, "id"};
    return {};
}

}  // namespace haarmony::schema
