#include "ingest/change.h"

#include <chrono>
#include <utility>

namespace haarmony::ingest {
namespace {

using schema::ImageState;
using schema::KnownFile;

bool has_content(const std::optional<KnownFile>& known, const std::string& content_hash) {
    return known && !known->stamp.content_hash.empty() &&
           known->stamp.content_hash == content_hash;
}

struct Settle {
    const std::optional<KnownFile>& known;
    bool restore;

    Settlement operator()(const SameContent& same) const {
        // The row went, or changed, while the file was read: left for the next run.
        if (!is_final(known, restore) || !has_content(known, same.stamp.content_hash)) {
            return {RowOperation::kNone, CountedAs::kSkipped};
        }
        return {RowOperation::kTouch, CountedAs::kSkipped};
    }
    Settlement operator()(const Described& described) const {
        if (!known) return {RowOperation::kAdd, CountedAs::kAdded};
        if (is_final(known, restore) &&
            has_content(known, described.image.stamp.content_hash)) {
            return {RowOperation::kTouch, CountedAs::kSkipped};
        }
        return {RowOperation::kUpdate, CountedAs::kUpdated};
    }
    // Has rows of its own: film_rows.h.
    Settlement operator()(const DescribedFilm&) const { return {}; }
    Settlement operator()(const Undecodable& undecodable) const {
        if (is_final(known, restore) &&
            has_content(known, undecodable.stamp.content_hash)) {
            return {RowOperation::kTouch, CountedAs::kSkipped};
        }
        return {RowOperation::kMarkFailed, CountedAs::kFailed};
    }
    Settlement operator()(const Unreadable&) const {
        const bool keeps_row = known && known->state != ImageState::kFailed;
        return {keeps_row ? RowOperation::kNone : RowOperation::kMarkFailed,
                CountedAs::kFailed};
    }
};

}  // namespace

bool is_final(const std::optional<KnownFile>& known, bool restore) {
    return known && (known->state == ImageState::kIndexed ||
                     (known->state == ImageState::kDeleted && !restore));
}

Need first_need(const std::optional<KnownFile>& known,
                const FileLook& look,
                bool restore) {
    if (!is_final(known, restore)) return Need::kDecode;
    const bool as_recorded = known->stamp.mtime_ns != kUnsettledMtime &&
                             known->stamp.mtime_ns == look.mtime_ns &&
                             known->stamp.size == look.size;
    return as_recorded ? Need::kNothing : Need::kCompare;
}

std::int64_t now_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

schema::FileStamp stamp_of(const FileLook& look,
                           std::int64_t now_ns,
                           std::string content_hash) {
    std::int64_t age_ns = 0;
    const bool racy =
        !__builtin_sub_overflow(now_ns, look.mtime_ns, &age_ns) && age_ns < kRacyNs;
    return {look.size, racy ? kUnsettledMtime : look.mtime_ns, std::move(content_hash)};
}

Settlement settle(const std::optional<KnownFile>& known,
                  const Reading& reading,
                  bool restore) {
    return std::visit(Settle{known, restore}, reading);
}

}  // namespace haarmony::ingest
