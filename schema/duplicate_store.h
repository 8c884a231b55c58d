// Pairs of pictures that look the same, as the last finished search for them found, and the
// pairs of which somebody said that they are none.
//
// A search writes into a generation of its own, batch by batch; nobody sees any of it until
// publish() puts it in the place of the one before.
//
// Units    similarity: the search's own scale, larger is more alike; finite.
// Errors   kNotFound for an unknown image or generation; kConflict for a batch for a
//          generation that is published, or a pair given twice; kInvalidArgument for a pair
//          that the tables refuse (a >= b, a similarity that is not finite, an empty level);
//          kUnavailable and kIo as in image_store.h.
// Threads  as Database; never inside ImageStore::transaction().
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/ids.h"
#include "engine/core/result.h"
#include "schema/database.h"

namespace haarmony::schema {

struct DuplicatePair {
    ImageId a{};  // below b
    ImageId b{};
    std::string level;  // the search's word for how alike they are
    double similarity = 0;
    bool operator==(const DuplicatePair&) const = default;
};

class DuplicateStore {
  public:
    explicit DuplicateStore(Database& database) : cache_(database.handle()) {}

    // A new generation, empty and unseen; larger than every one before.
    [[nodiscard]] Result<std::int64_t> begin_generation();
    // One transaction. A pair whose pictures are not both searchable any more is left out.
    [[nodiscard]] Result<void> add(std::int64_t generation,
                                   std::span<const DuplicatePair> pairs);
    // From now on pairs() gives this generation; all older ones are deleted. One that a
    // newer published one has replaced is kNotFound.
    [[nodiscard]] Result<void> publish(std::int64_t generation);
    // Gives up a generation that was not published.
    [[nodiscard]] Result<void> discard(std::int64_t generation);
    // The one that pairs() gives; 0 before the first.
    [[nodiscard]] Result<std::int64_t> published_generation();

    // Of the published generation, those at least so similar that nobody ignores, in the
    // order of (a, b).
    [[nodiscard]] Result<std::vector<DuplicatePair>> pairs(double min_similarity);

    // The two, in any order, are no duplicates, whatever later searches find. Saying it
    // again changes nothing. kInvalidArgument for a picture and itself.
    [[nodiscard]] Result<void> ignore(ImageId one, ImageId other);
    // All such pairs, the smaller id first, in the order of (a, b).
    [[nodiscard]] Result<std::vector<std::pair<ImageId, ImageId>>> ignored();

    // The searchable pictures whose files are the same byte by byte (content_hash): groups
    // of two or more, rising, in the order of their first pictures.
    [[nodiscard]] Result<std::vector<std::vector<ImageId>>> same_content();

  private:
    StatementCache cache_;
};

}  // namespace haarmony::schema
