#include "engine/video/brick_coder.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "engine/video/brick_prediction.h"

namespace haarmony::video {
namespace {

using Alpha = std::array<std::uint8_t, kBrickPixels>;

constexpr std::array<BrickMode, 8> kTried = {{
    {Reference::kParent, Predictor::kPlain, false},
    {Reference::kParent, Predictor::kMedian, false},
    {Reference::kMirror, Predictor::kPlain, false},
    {Reference::kOtherEdge, Predictor::kPlain, false},
    {Reference::kParentCoarse, Predictor::kPlain, false},
    {Reference::kParentCoarse, Predictor::kQuad, false},
    {Reference::kCoarse, Predictor::kQuad, false},
    {Reference::kNone, Predictor::kMedian, false},
}};

struct Original {
    std::array<Plane, kPlanes> values;
    Alpha alpha;
};

Original planes_of(const Brick& brick) {
    Original planes;
    for (int pixel = 0; pixel < kBrickPixels; ++pixel) {
        assert(canonical(brick[pixel]) == brick[pixel]);
        planes.values[0][pixel] = brick[pixel].g;
        planes.values[1][pixel] = brick[pixel].r;
        planes.values[2][pixel] = brick[pixel].b;
        planes.alpha[pixel] = brick[pixel].a;
    }
    return planes;
}

// Adds up what a mode costs, and gives up once it is dearer than another.
template <bool kOfGreenOnly>
class CostSum {
  public:
    static constexpr bool kGreenOnly = kOfGreenOnly;
    CostSum(const Original& original, const SymbolCosts& costs, std::uint32_t limit)
        : original_(&original), costs_(&costs), limit_(limit) {}
    template <int kPlane>
    Coded code(int context, int predicted, int pixel) {
        const int value = original_->values[kPlane][pixel];
        const int residual = static_cast<std::int8_t>(value - predicted);
        cost_ += (*costs_)[context][residual_symbol(residual)];
        return {value, residual};
    }
    template <int kPlane>
    void clear(int) {}
    [[nodiscard]] bool enough() const { return cost_ >= limit_; }
    [[nodiscard]] std::uint32_t cost() const { return cost_; }

  private:
    const Original* original_;
    const SymbolCosts* costs_;
    std::uint32_t limit_;
    std::uint32_t cost_ = 0;
};

class Put {
  public:
    static constexpr bool kGreenOnly = false;
    Put(const Original& original, SymbolWriter& symbols)
        : original_(&original), symbols_(&symbols) {}
    template <int kPlane>
    Coded code(int context, int predicted, int pixel) {
        const int value = original_->values[kPlane][pixel];
        const int residual = static_cast<std::int8_t>(value - predicted);
        symbols_->put(kPlane, context, residual_symbol(residual));
        return {value, residual};
    }
    int alpha(int context, int predicted, int pixel) {
        const int value = original_->alpha[pixel];
        symbols_->put(0, context, residual_symbol(value - predicted));
        return value;
    }
    template <int kPlane>
    void clear(int) {}
    [[nodiscard]] bool enough() const { return false; }

  private:
    const Original* original_;
    SymbolWriter* symbols_;
};

// Reads with a copy of the cursor; the caller takes it back.
class Take {
  public:
    static constexpr bool kGreenOnly = false;
    Take(const SymbolCursor& symbols, Original& decoded)
        : symbols_(symbols), decoded_(&decoded) {}
    template <int kPlane>
    Coded code(int context, int predicted, int pixel) {
        const int residual = residual_of(symbols_.next<kPlane>(context));
        const int value = (predicted + residual) & 255;
        decoded_->values[kPlane][pixel] = static_cast<std::int16_t>(value);
        return {value, residual};
    }
    int alpha(int context, int predicted, int pixel) {
        const int residual = residual_of(symbols_.next<0>(context));
        const int value = (predicted + residual) & 255;
        decoded_->alpha[pixel] = static_cast<std::uint8_t>(value);
        return value;
    }
    template <int kPlane>
    void clear(int pixel) {
        decoded_->values[kPlane][pixel] = 0;
    }
    [[nodiscard]] bool enough() const { return false; }
    [[nodiscard]] const SymbolCursor& cursor() const { return symbols_; }

  private:
    SymbolCursor symbols_;
    Original* decoded_;
};

// What a brick is when nothing is added to the prediction.
void exact_values(const Prediction& prediction, const Alpha& alpha, Original& values) {
    for (int plane = 0; plane < kPlanes; ++plane) {
        for (int pixel = 0; pixel < kBrickPixels; ++pixel) {
            const int square = (pixel / kBrickSide >> 1) * 4 + (pixel % kBrickSide >> 1);
            values.values[plane][pixel] = static_cast<std::int16_t>(
                alpha[pixel] == 0 ? 0
                                  : clamped(prediction.base[plane][pixel] +
                                            prediction.coarse[plane][square]));
        }
    }
}

AlphaMode alpha_mode(const Alpha& alpha, bool opaque, const Prediction& prediction) {
    return opaque                      ? AlphaMode::kOpaque
           : alpha == prediction.alpha ? AlphaMode::kAsReference
                                       : AlphaMode::kCoded;
}

// Alpha that is coded costs about this much more than alpha that is known, in 1/256 bit.
constexpr std::uint32_t kCodedAlphaCost = 256 * 48;
constexpr std::uint32_t kDearest = std::numeric_limits<std::uint32_t>::max();

// Finds the cheapest mode: green tells which two are worth a look at all planes.
class Choice {
  public:
    Choice(const Original& original, const SymbolCosts& costs, int mode_context)
        : original_(original), costs_(costs), mode_costs_(costs[mode_context]) {
        opaque_ = std::all_of(original.alpha.begin(),
                              original.alpha.end(),
                              [](std::uint8_t alpha) { return alpha == 255; });
    }

    void run(const BrickNeighbors& neighbors) {
        std::array<const BrickMode*, 2> two{};
        std::array<std::uint32_t, 2> cost = {kDearest, kDearest};
        for (std::size_t i = 0; i < kTried.size(); ++i) {
            const BrickMode& mode = kTried[i];
            if (!possible(mode, neighbors)) continue;
            predict(mode, neighbors, predictions_[i]);
            if (mode.predictor == Predictor::kPlain && exact(i)) return;
            CostSum<true> sum(original_, costs_, cost[1]);
            code_pixels(sum, mode, predictions_[i], opaque_, original_.alpha);
            const std::uint32_t all =
                sum.cost() + alpha_cost(i) + mode_costs_[mode.symbol()];
            if (all < cost[0]) {
                two = {&mode, two[0]};
                cost = {all, cost[0]};
            } else if (all < cost[1]) {
                two[1] = &mode;
                cost[1] = all;
            }
        }
        for (const BrickMode* mode : two) {
            if (mode != nullptr)
                compare(*mode, static_cast<std::size_t>(mode - kTried.data()));
        }
    }

    [[nodiscard]] const BrickMode& mode() const { return best_; }
    [[nodiscard]] const Prediction& prediction() const {
        return predictions_[best_tried_];
    }
    [[nodiscard]] bool opaque() const { return opaque_; }

  private:
    [[nodiscard]] std::uint32_t alpha_cost(std::size_t tried) const {
        return alpha_mode(original_.alpha, opaque_, predictions_[tried]) ==
                       AlphaMode::kCoded
                   ? kCodedAlphaCost
                   : 0;
    }
    // Nothing is cheaper than no residuals.
    bool exact(std::size_t tried) {
        Original values;
        exact_values(predictions_[tried], original_.alpha, values);
        if (values.values != original_.values) return false;
        best_ = {kTried[tried].reference, Predictor::kExact, false};
        best_tried_ = tried;
        return true;
    }
    void compare(BrickMode mode, std::size_t tried) {
        for (const bool follows_green : {false, true}) {
            mode.follows_green = follows_green;
            const std::uint32_t known = alpha_cost(tried) + mode_costs_[mode.symbol()];
            if (known >= least_) continue;
            CostSum<false> sum(original_, costs_, least_ - known);
            code_pixels(sum, mode, predictions_[tried], opaque_, original_.alpha);
            if (known + sum.cost() >= least_) continue;
            least_ = known + sum.cost();
            best_ = mode;
            best_tried_ = tried;
        }
    }

    const Original& original_;
    const SymbolCosts& costs_;
    const std::array<std::uint16_t, kSymbols>& mode_costs_;
    bool opaque_ = false;
    std::array<Prediction, kTried.size()> predictions_;
    std::uint32_t least_ = kDearest;
    BrickMode best_;
    std::size_t best_tried_ = 0;
};

}  // namespace

void BrickEncoder::put(const Brick& brick, const BrickNeighbors& neighbors) {
    const Original original = planes_of(brick);
    Choice choice(original, costs_, kModeContext + last_reference_);
    choice.run(neighbors);
    const BrickMode& mode = choice.mode();
    symbols_.put(0, kModeContext + last_reference_, mode.symbol());
    last_reference_ = static_cast<int>(mode.reference);
    const AlphaMode alpha =
        alpha_mode(original.alpha, choice.opaque(), choice.prediction());
    symbols_.put(0, kAlphaModeContext, static_cast<std::uint8_t>(alpha));
    Put put(original, symbols_);
    if (alpha == AlphaMode::kCoded) code_alpha(put);
    code_pixels(put, mode, choice.prediction(), choice.opaque(), original.alpha);
}

Result<void> BrickDecoder::next(Brick& brick, const BrickNeighbors& neighbors) {
    const int symbol = symbols_.next<0>(kModeContext + last_reference_);
    const int alpha = symbols_.next<0>(kAlphaModeContext);
    if (symbol >= kModeSymbols || alpha >= kAlphaModes ||
        !possible(mode_of(symbol), neighbors)) {
        return Error{ErrorCode::kUndecodable,
                     "brick of mode " + std::to_string(symbol) + ", alpha mode " +
                         std::to_string(alpha)};
    }
    const BrickMode mode = mode_of(symbol);
    last_reference_ = static_cast<int>(mode.reference);
    Prediction prediction;
    predict(mode, neighbors, prediction);
    Original decoded;
    Take take(symbols_, decoded);
    switch (static_cast<AlphaMode>(alpha)) {
        case AlphaMode::kOpaque:
            decoded.alpha.fill(255);
            break;
        case AlphaMode::kAsReference:
            decoded.alpha = prediction.alpha;
            break;
        case AlphaMode::kCoded:
            code_alpha(take);
            break;
    }
    if (mode.predictor == Predictor::kExact) {
        exact_values(prediction, decoded.alpha, decoded);
    } else {
        code_pixels(take,
                    mode,
                    prediction,
                    static_cast<AlphaMode>(alpha) == AlphaMode::kOpaque,
                    decoded.alpha);
    }
    symbols_ = take.cursor();
    for (int pixel = 0; pixel < kBrickPixels; ++pixel) {
        brick[pixel] = {static_cast<std::uint8_t>(decoded.values[1][pixel]),
                        static_cast<std::uint8_t>(decoded.values[0][pixel]),
                        static_cast<std::uint8_t>(decoded.values[2][pixel]),
                        decoded.alpha[pixel]};
    }
    return {};
}

const SymbolCosts& first_costs() {
    static const SymbolCosts costs = [] {
        SymbolCosts made;
        for (auto& context : made) {
            for (int symbol = 0; symbol < kSymbols; ++symbol) {
                // About the logarithm of the magnitude, twice: heavy tails.
                const auto width = std::bit_width(static_cast<unsigned>(symbol + 1));
                context[symbol] = static_cast<std::uint16_t>(256 * (2 * width - 1));
            }
        }
        return made;
    }();
    return costs;
}

}  // namespace haarmony::video
