// Several metrics as one: the mean, or the worst, of the ranks that they give.
//
//   "A good query will bring up the target image, no matter which color space and
//   decomposition method is used; however, the false matches found in these different
//   spaces all tend to be very different."
//
// A picture that a metric knows nothing of (it has no signature of that kind) comes there
// after all that it does know.
//
// Order   smaller combined rank first, then the better rank under the first metric, then
//         the smaller id.
// Scale   a mean is kept as the sum of the ranks: exact.
// Source  sec. 4.6, "Multiple metrics".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/best_of.h"

namespace haarmony::image {

enum class CombineBy { kMean, kWorst };

struct CombinedMatch {
    BestMatch first;        // under the first metric
    std::int64_t rank = 0;  // the sum of the ranks, or the worst; ranks count from 1
};

// The `limit` best of all pictures that the first metric knows.
// `metrics[p]`: every picture under metric p, in rising order of id (score_all_best).
// Requires: at least one metric, limit >= 0. Cost: sorts each metric once.
[[nodiscard]] std::vector<CombinedMatch> combine_ranks(
    std::span<const std::vector<BestMatch>> metrics,
    CombineBy combine_by,
    int limit);

}  // namespace haarmony::image
