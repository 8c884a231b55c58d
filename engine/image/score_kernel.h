// Equation (4.4) for neighbouring slots, once their matches are counted.
//
// Scale   as Score in query.h: exact integers.
// Errors  none.
// Source  sec. 4.2.4, equation (4.4); Figure 4.2; sec. 4.6, "Aspect ratio".
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/image/query.h"

namespace haarmony::image {

// What is known of each slot beside its coefficients.
struct SlotColumns {
    std::array<std::span<const std::int32_t>, kChannels> averages;
    std::span<const std::int32_t> log_aspects;
};

// scores[i] = score(query, (averages[0][i], averages[1][i], averages[2][i]),
//                   log_aspects[i], matched[i]).
// Requires: all spans are as long as `scores`; a column whose weight is 0 is not read and
// may be empty.
void score_slots(const Query& query,
                 const SlotColumns& columns,
                 std::span<const std::int32_t> matched,
                 std::span<Score> scores);

}  // namespace haarmony::image
