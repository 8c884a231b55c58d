// The metric made symmetric, and both metrics from one picture to many at once:
//   signature.h -> query.h, search_arrays.h -> [symmetric_metric.h] -> clusters.h
//
// Equation (4.3) weighs only what the query has; the symmetric distance is the mean of both
// directions, the similarity of two pictures the lesser one.
//
// Scale   a symmetric distance is the *sum* of the two directions, so that no half is lost:
//         an exact integer, 200 * 2^24 times the mean.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe.
// Source  sec. 4.2.4; the symmetry is ours: an overview and a duplicate have no query.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/profile.h"
#include "engine/image/query.h"
#include "engine/image/search_arrays.h"
#include "engine/image/signature.h"

namespace haarmony::image {

inline constexpr double kSymmetricUnit = 200.0 * double{kAverageOne};

// metric(a, b) + metric(b, a), both cut to their m largest coefficients.
// Requires: 1 <= m <= kMaxCoefficients. Cost: m log m.
[[nodiscard]] std::int64_t symmetric_distance(const Signature& a,
                                              const Signature& b,
                                              const Profile& profile,
                                              int m);

// The symmetric distance as a part of the weights of both: 0 where they are alike, 1 where no
// coefficient is shared (and a little more for other averages). The symmetric distance
// itself would make every picture close to the ones with few coefficients (grey ones have
// those of Y alone): of 900 photographs, five such medoids took all.
// Scale: times 2^24, rounded down; at most kMaxRelativeDistance, also for what differs
// without any coefficient. Requires and Cost as above.
inline constexpr std::int64_t kMaxRelativeDistance = std::int64_t{1} << 40;
[[nodiscard]] std::int64_t relative_distance(const Signature& a,
                                             const Signature& b,
                                             const Profile& profile,
                                             int m);

// The lesser of similarity(a, b) and similarity(b, a), as query.h defines it: a picture with
// little in it is similar to many, but not they to it. Cost and Requires as above.
[[nodiscard]] double mutual_similarity(const Signature& a,
                                       const Signature& b,
                                       const Profile& profile,
                                       int m);

// Pictures that one picture is compared with, all at once. Slot i is the i-th signature.
class SignatureBlock {
  public:
    // Requires: at most kMaxSlots signatures, 1 <= profile.m <= kMaxCoefficients.
    SignatureBlock(std::span<const Signature* const> signatures, const Profile& profile);

    [[nodiscard]] int size() const { return static_cast<int>(weight_sums_.size()); }

    // scores[i] is equation (4.4) of slot i, as in query.h.
    // Requires: the query is cut at the profile's m; scores.size() == size().
    void score(const Query& query, std::span<Score> scores) const;

    // distances[i] is the symmetric or relative distance of the query's picture and slot i.
    // Requires: make_query(signature, profile, profile.m); distances.size() == size().
    void symmetric_distances(const Query& query, std::span<std::int64_t> distances) const;
    void relative_distances(const Query& query, std::span<std::int64_t> distances) const;

  private:
    int m_;
    std::array<std::vector<std::int32_t>, kChannels> averages_;
    std::vector<std::int64_t> weight_sums_;  // of each slot's own coefficients, in 1/100
    SearchArrays arrays_;
};

}  // namespace haarmony::image
