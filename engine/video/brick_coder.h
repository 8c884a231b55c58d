// One brick as symbols: predicted from what is decoded already, and the rest coded.
//   symbol_coder.h -> [brick_coder.h] -> layer_coder.h
//
// Shape   a mode (reference, predictor, whether red and blue follow green's error), how alpha
//         is known, then 64 pixels, each green, red, blue; clear pixels cost nothing.
// Units   residuals modulo 256; MRV.md has every formula.
// Errors  reading: kUndecodable where a mode needs a reference that the brick does not have.
// Source  M. Weinberger, G. Seroussi, G. Sapiro, "LOCO-I", DCC 1996 [median predictor]; the
//         mirror is the time tree's own: a mean and one half determine the other.
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/video/brick.h"
#include "engine/video/symbol_coder.h"

namespace haarmony::video {

// What a brick is predicted from.
enum class Reference : std::uint8_t {
    kNone,          // only the pixels to the left and above
    kParent,        // what the time-parent shows at the place
    kMirror,        // 2 parent - first half, in the second half
    kCoarse,        // the brick above it in the image tree, enlarged
    kParentCoarse,  // the time-parent, moved by as much as the coarse bricks differ
    kOtherEdge,     // what the tree of the other edge rule shows at the place
};
enum class Predictor : std::uint8_t { kExact, kPlain, kMedian, kQuad };
enum class AlphaMode : std::uint8_t { kOpaque, kAsReference, kCoded };

// The bricks around a brick; null where there is none.
struct BrickNeighbors {
    const Brick* parent = nullptr;
    const Brick* first = nullptr;
    const Brick* coarse = nullptr;
    const Brick* parent_coarse = nullptr;
    const Brick* other_edge = nullptr;
    const Brick* left = nullptr;
    const Brick* above = nullptr;
    int quadrant = 0;  // of the coarse bricks
};

// Appends a brick to the symbols, in the way that costs least.
// Requires: canonical() pixels.
class BrickEncoder {
  public:
    BrickEncoder(SymbolWriter& symbols, const SymbolCosts& costs)
        : symbols_(symbols), costs_(costs) {}
    void put(const Brick& brick, const BrickNeighbors& neighbors);

  private:
    SymbolWriter& symbols_;
    const SymbolCosts& costs_;
    int last_reference_ = 0;
};

class BrickDecoder {
  public:
    explicit BrickDecoder(SymbolCursor& symbols) : symbols_(symbols) {}
    [[nodiscard]] Result<void> next(Brick& brick, const BrickNeighbors& neighbors);

  private:
    SymbolCursor& symbols_;
    int last_reference_ = 0;
};

// What symbols are taken to cost before any chunk of a space level is coded.
[[nodiscard]] const SymbolCosts& first_costs();

}  // namespace haarmony::video
