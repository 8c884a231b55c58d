// Pictures that stand for others: k-medoids on the symmetric metric, relative to its weights:
//   symmetric_metric.h -> [medoids.h] -> clusters.h
//
// Scale   relative distances of symmetric_metric.h, exact integers; a cost is their sum:
//         nothing depends on the order of addition.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe; parallel work goes to the Executor, with the same result
//         whatever it does first.
// Source  k-means++ seeding (Arthur and Vassilvitskii 2007) with distances for their
//         squares; medoid updates as in Park and Jun 2009, over candidates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/executor.h"
#include "engine/image/profile.h"
#include "engine/image/signature.h"
#include "engine/image/symmetric_metric.h"

namespace haarmony::image {

// Of every picture: which center is nearest, and its distance. Ties: the earlier center.
struct Nearest {
    std::vector<std::size_t> center;
    std::vector<std::int64_t> distance;

    [[nodiscard]] std::int64_t cost() const;
};

// Many pictures, in blocks that are compared in parallel.
class SignatureBlocks {
  public:
    // The signatures must outlive the blocks.
    SignatureBlocks(std::vector<const Signature*> signatures,
                    const Profile& profile,
                    Executor& executor);

    [[nodiscard]] std::size_t size() const { return signatures_.size(); }
    [[nodiscard]] const Signature& operator[](std::size_t i) const {
        return *signatures_[i];
    }

    // Requires: at least one center; queries as SignatureBlock wants them.
    // Cost: one pass over the pictures per center.
    [[nodiscard]] Nearest nearest(std::span<const Query> centers,
                                  Executor& executor) const;

  private:
    std::vector<const Signature*> signatures_;
    std::vector<SignatureBlock> blocks_;
};

struct Medoids {
    std::vector<std::size_t> pictures;  // rising
    std::vector<std::int64_t> costs;    // at the start, and after each iteration
};

// At most `count` medoids: fewer where there are fewer different pictures. Iterates until
// nothing moves, `iterations` times at most; the cost never grows.
// Requires: 1 <= count, 0 <= iterations, 1 <= pictures.size() <= kMaxSlots.
// Cost: 4 passes per medoid to seed, one each and 64 over its own pictures per iteration.
[[nodiscard]] Medoids find_medoids(const SignatureBlocks& pictures,
                                   const Profile& profile,
                                   int count,
                                   std::uint64_t seed,
                                   int iterations,
                                   Executor& executor);

}  // namespace haarmony::image
