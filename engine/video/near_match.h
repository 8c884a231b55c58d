// Whether what a time-ancestor shows may stand for an exact frame, within a bound.
//   image_tree.h, layer_chain.h -> [near_match.h] -> up_links.h
//
// Each test looks at every space level from the one at hand down to the finest, and compares
// what would be displayed with the exact frame, never with another approximation: so errors
// do not add up, neither along a chain of up-links nor over pruned levels.
//
// Cost     show() is linear in the pixels, however often it is asked about one frame:
//          answers are remembered. flat() ends at the first pixel out of bounds; at worst
//          each pixel is looked at once for each space level above it.
// Threads  one caller.
// Source   sec. 5.3.1, PruneTree(), MakeUpLinks(); ERRATA of the project, video 1, 2, 7,
//          "Lossy bound".
#pragma once

#include <cstdint>
#include <vector>

#include "engine/video/image_tree.h"
#include "engine/video/layer_chain.h"

namespace haarmony::video {

class NearMatch {
  public:
    // `chain` must outlive this.
    NearMatch(const LayerChain& chain, std::uint32_t delta)
        : chain_(chain), delta_(delta) {}

    // Begins another frame, which must stay until the next one begins.
    void begin(const ExactFrame& frame);

    // Whether the node `shown` of the chain, with all below it, is within delta of the
    // frame's node at that space level.
    [[nodiscard]] bool shows(Ref shown, std::uint32_t node, int level);
    // Whether quadrant q of `brick`, one level above the frame's node, is within delta of it
    // and of all below it when nothing finer is displayed.
    [[nodiscard]] bool flat(const Brick& brick, int q, std::uint32_t node) const;

  private:
    struct Answer {
        Ref shown = kNoDetailRef;
        bool shows = false;
    };

    [[nodiscard]] bool compare(Ref shown, std::uint32_t node, int level);
    [[nodiscard]] bool flat(const Brick& enlarged, std::uint32_t node) const;
    [[nodiscard]] bool flat(Ref shown, const Brick& enlarged, int level) const;

    const LayerChain& chain_;
    std::uint32_t delta_;
    const ExactFrame* frame_ = nullptr;
    std::vector<Answer> answers_;  // by node of the frame
};

}  // namespace haarmony::video
