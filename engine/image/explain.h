// Why a target is as near as it is: equation (4.3) taken apart.
//
// Scale   the parts of all channels add up to full_distance() of the match, exactly; the
//         term of the shape is not among them.
// Errors  none; signatures and profile must be of one kind, or it asserts.
// Source  sec. 4.2.3, equation (4.3).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/image/profile.h"
#include "engine/image/query.h"
#include "engine/image/signature.h"

namespace haarmony::image {

struct ExplainedBin {
    std::int32_t weight = 0;  // in 1/100
    int matched = 0;          // coefficients of the query that the target has
    int missed = 0;           // and that it has not
};

struct ExplainedChannel {
    std::int32_t query_average = 0;
    std::int32_t target_average = 0;
    std::array<ExplainedBin, kBins> bins{};  // bin 0 has the weight of the averages alone
    // Signed indices of the query, in its order.
    std::vector<std::int16_t> matched;
    std::vector<std::int16_t> missed;

    // This channel's part of the distance, in units of a score.
    [[nodiscard]] Score distance() const;
};

using Explanation = std::array<ExplainedChannel, kChannels>;

// Query and target are both cut at m. Requires: 1 <= m <= kMaxCoefficients.
[[nodiscard]] Explanation explain(const Signature& query,
                                  const Signature& target,
                                  const Profile& profile,
                                  int m);

// The coefficients that matched, drawn with their signs: grey, kChannels panels of
// kSide x kSide side by side (kDrawingWidth x kSide), mid-grey where nothing matched. The
// sizes of coefficients are not kept, so each is drawn as large as one of its rank mostly is.
inline constexpr int kDrawingWidth = kChannels * kSide;
[[nodiscard]] std::vector<std::uint8_t> draw_matches(const Signature& query,
                                                     const Explanation& explanation);

}  // namespace haarmony::image
