#include "tests/engine/video/worst_difference.h"

#include <algorithm>
#include <cassert>

#include "tests/engine/video/plain_draw.h"

namespace haarmony::video::testing {

WorstDifference worst_difference(const TimeTree& exact, const TimeTree& clip) {
    const ClipShape& shape = exact.shape();
    assert(shape == clip.shape());
    WorstDifference worst;
    for (int k = 0; k <= shape.time_levels(); ++k) {
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            const Frame want = *exact.frame({k, i}, shape.space_levels());
            const Frame got = *clip.frame({k, i}, shape.space_levels());
            for (int level = 0; level <= shape.space_levels(); ++level) {
                const bool leaf =
                    k == shape.time_levels() && level == shape.space_levels();
                std::uint32_t& largest = leaf ? worst.leaf : worst.coarse;
                for (const Edge edge : {Edge::kPad, Edge::kNormalize}) {
                    const Picture a = shown_picture(want, level, edge);
                    const Picture b = shown_picture(got, level, edge);
                    for (std::size_t p = 0; p < a.pixels.size(); ++p) {
                        largest = std::max(largest, difference(a.pixels[p], b.pixels[p]));
                    }
                }
            }
        }
    }
    return worst;
}

}  // namespace haarmony::video::testing
