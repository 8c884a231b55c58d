// The arithmetic that encoder and decoder share: one brick's pixels, predicted one by one.
//   [brick_prediction.h] -> brick_coder.h
//
// Shape   planes 0 green, 1 red, 2 blue; 64 values each, row-major.
// Errors  none.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "engine/video/brick_coder.h"

namespace haarmony::video {

inline constexpr int kPlanes = 3;
using Plane = std::array<std::int16_t, kBrickPixels>;

// The mode of one brick.
struct BrickMode {
    Reference reference = Reference::kNone;
    Predictor predictor = Predictor::kMedian;
    bool follows_green = false;

    [[nodiscard]] std::uint8_t symbol() const {
        return static_cast<std::uint8_t>(
            (static_cast<int>(reference) * 4 + static_cast<int>(predictor)) * 2 +
            (follows_green ? 1 : 0));
    }
};
inline constexpr int kModeSymbols = kReferences * 4 * 2;

[[nodiscard]] constexpr BrickMode mode_of(int symbol) {
    return {static_cast<Reference>(symbol / 8),
            static_cast<Predictor>(symbol / 2 % 4),
            symbol % 2 == 1};
}

[[nodiscard]] constexpr std::uint8_t residual_symbol(int residual) {
    const int wrapped = static_cast<std::int8_t>(residual);
    return static_cast<std::uint8_t>(wrapped >= 0 ? 2 * wrapped : -2 * wrapped - 1);
}
[[nodiscard]] constexpr int residual_of(std::uint8_t symbol) {
    return symbol >> 1 ^ -(symbol & 1);
}

[[nodiscard]] constexpr int clamped(int value) {
    return std::min(std::max(value, 0), 255);
}
[[nodiscard]] constexpr int median(int left, int above, int corner) {
    const int low = std::min(left, above);
    const int high = std::max(left, above);
    return std::max(low, std::min(high, left + above - corner));
}
// A third, rounded to nearest.
[[nodiscard]] constexpr int third(int value) { return (43691 * value + 65536) >> 17; }

// What the reference gives: the base of each pixel, and by how much its square of the coarse
// brick is off that base.
struct Prediction {
    std::array<Plane, kPlanes> base;
    std::array<std::array<std::int16_t, 16>, kPlanes> coarse;
    std::array<Plane, kPlanes> first_off_parent;  // kMirror only
    std::array<std::array<std::int16_t, kBrickSide>, kPlanes> left;
    std::array<std::array<std::int16_t, kBrickSide>, kPlanes> above;
    std::array<std::uint8_t, kBrickPixels> alpha;  // of AlphaMode::kAsReference
    bool has_left = false;
    bool has_above = false;
    std::int16_t first = 0;  // what the first pixel is taken to be off its base
};

// Whether the brick has what the mode needs.
[[nodiscard]] bool possible(const BrickMode& mode, const BrickNeighbors& neighbors);
// Requires: possible(mode, neighbors).
void predict(const BrickMode& mode,
             const BrickNeighbors& neighbors,
             Prediction& prediction);

// By the sum of the magnitudes around, those nearest twice.
inline constexpr int kLoudest = 37;
inline constexpr std::array<std::uint8_t, kLoudest + 1> kActivityOf = [] {
    std::array<std::uint8_t, kLoudest + 1> table{};
    constexpr std::array<int, 7> kAtMost = {0, 1, 3, 6, 10, 18, 36};
    for (int sum = 0; sum <= kLoudest; ++sum) {
        std::uint8_t activity = 0;
        while (activity < 7 && sum > kAtMost[activity]) ++activity;
        table[sum] = activity;
    }
    return table;
}();

// The values and residual magnitudes of a plane with a row above and columns beside.
struct PlaneWindow {
    static constexpr int kStride = kBrickSide + 2;
    std::array<std::int16_t, (kBrickSide + 1) * kStride> off{};        // off the base
    std::array<std::int16_t, (kBrickSide + 1) * kStride> magnitude{};  // of residuals
};

// A pixel's value in one plane, and its residual as -128 .. 127.
struct Coded {
    int value;
    int residual;
};

// Runs through the pixels of a brick. `io.template code<plane>(context, predicted, pixel)`
// returns the pixel's value and residual;
// `io.template clear<plane>(pixel)` is told of a pixel that has none.
template <Predictor kPredictor, bool kSpatial, bool kMirror, bool kOpaque, typename Io>
class PixelRun {
  public:
    PixelRun(Io& io,
             const Prediction& prediction,
             bool follows_green,
             const std::array<std::uint8_t, kBrickPixels>& alpha)
        : io_(io),
          prediction_(prediction),
          follow_(follows_green ? -1 : 0),
          alpha_(alpha) {}

    void run() {
        if constexpr (kSpatial) borders();
        // A copy, which stays in registers.
        Io io = io_;
        row<true>(io, 0);
        for (int y = 1; y < kBrickSide && !io.enough(); ++y) row<false>(io, y);
        io_ = io;
    }

  private:
    static constexpr int kStride = PlaneWindow::kStride;

    void borders() {
        for (int plane = 0; plane < kPlanes; ++plane) {
            std::int16_t* off = windows_[plane].off.data();
            for (int i = 0; i < kBrickSide; ++i) {
                if (prediction_.has_left)
                    off[(i + 1) * kStride] = prediction_.left[plane][i];
                if (prediction_.has_above) off[i + 1] = prediction_.above[plane][i];
            }
            if (prediction_.has_above) off[0] = prediction_.above[plane][0];
        }
    }

    // What the pixel before left behind, in registers.
    struct Before {
        int off = 0;
        int magnitude = 0;
    };
    using Row = std::array<std::int16_t, kBrickSide>;

    template <bool kFirstRow>
    [[gnu::always_inline]] void row(Io& io, int y) {
        // All that the row's own pixels do not change, eight at once.
        std::array<Row, kPlanes> louder{};
        std::array<Row, kPlanes> plain{};
        std::array<Before, kPlanes> before;
        for (int plane = 0; plane < kPlanes; ++plane) {
            const int begin = y * kStride + 1;
            const std::int16_t* above = windows_[plane].magnitude.data() + begin;
            for (int x = 0; x < kBrickSide && !kFirstRow; ++x) {
                louder[plane][x] =
                    static_cast<std::int16_t>(2 * above[x] + above[x - 1] + above[x + 1]);
            }
            if constexpr (kPredictor == Predictor::kPlain) {
                const std::int16_t* base =
                    prediction_.base[plane].data() + y * kBrickSide;
                const std::int16_t* coarse =
                    prediction_.coarse[plane].data() + (y >> 1) * 4;
                for (int x = 0; x < kBrickSide; ++x)
                    plain[plane][x] =
                        static_cast<std::int16_t>(clamped(base[x] + coarse[x >> 1]));
            }
            before[plane].off = windows_[plane].off[begin + kStride - 1];
        }
        for (int x = 0; x < kBrickSide; ++x) {
            int green_error = 0;
            pixel<0, kFirstRow>(io, x, y, louder, plain, before[0], green_error);
            if constexpr (!Io::kGreenOnly) {
                pixel<1, kFirstRow>(io, x, y, louder, plain, before[1], green_error);
                pixel<2, kFirstRow>(io, x, y, louder, plain, before[2], green_error);
            }
        }
    }

    template <int kPlane, bool kFirstRow>
    [[gnu::always_inline]] void pixel(Io& io,
                                      int x,
                                      int y,
                                      const std::array<Row, kPlanes>& louder,
                                      const std::array<Row, kPlanes>& plain,
                                      Before& before,
                                      int& green_error) {
        constexpr bool kAround = kPredictor != Predictor::kPlain;
        PlaneWindow& window = windows_[kPlane];
        const int pixel = y * kBrickSide + x;
        const int at = (y + 1) * kStride + x + 1;
        if constexpr (!kOpaque) {
            if (alpha_[pixel] == 0) {
                before = {-prediction_.base[kPlane][pixel], 0};
                window.off[at] = static_cast<std::int16_t>(before.off);
                io.template clear<kPlane>(pixel);
                return;
            }
        }
        int activity = 2 * before.magnitude + louder[kPlane][x];
        if (x == 0) activity = activity * 3 / 2;
        if (kFirstRow) activity *= 2;
        Residual kind = Residual::kPlain;
        if constexpr (kMirror)
            kind = mirror_kind(prediction_.first_off_parent[kPlane][pixel]);
        int predicted = 0;
        if constexpr (kAround) {
            const int coarse = prediction_.coarse[kPlane][(y >> 1) * 4 + (x >> 1)];
            int left = before.off;
            int above = window.off[at - kStride];
            int corner = window.off[at - kStride - 1];
            const bool no_left = x == 0 && !(kSpatial && prediction_.has_left);
            const bool no_above = kFirstRow && !(kSpatial && prediction_.has_above);
            if (no_left && no_above) {
                left = above = corner = kSpatial && kPredictor == Predictor::kMedian
                                            ? prediction_.first
                                            : coarse;
            } else if (no_left) {
                left = corner = above;
            } else if (no_above) {
                above = corner = left;
            }
            int off = median(left, above, corner);
            if constexpr (kPredictor == Predictor::kQuad) {
                if ((x & y & 1) != 0) {
                    kind = Residual::kCorner;
                    off = 4 * coarse - left - above - corner;
                } else {
                    const int opposite = (x & 1) != 0   ? 2 * coarse - left
                                         : (y & 1) != 0 ? 2 * coarse - above
                                                        : coarse;
                    off = third(off + coarse + opposite);
                }
            }
            predicted = clamped(prediction_.base[kPlane][pixel] + off);
            if constexpr (kSpatial) {
                activity = std::max(activity,
                                    std::abs(left - corner) + std::abs(above - corner));
            }
        } else {
            predicted = plain[kPlane][x];
        }
        const int level = kFirstRow && x == 0 ? kActivities - 1
                                              : kActivityOf[std::min(activity, kLoudest)];
        const int with_green =
            kPlane == 0 ? predicted : clamped(predicted + (green_error & follow_));
        const Coded coded = io.template code<kPlane>(
            color_context(kind, kPlane == 0 ? 0 : 1) + level, with_green, pixel);
        if constexpr (kPlane == 0) green_error = coded.value - predicted;
        before.magnitude = std::abs(coded.residual);
        window.magnitude[at] = static_cast<std::int16_t>(before.magnitude);
        if constexpr (kAround) {
            before.off = coded.value - prediction_.base[kPlane][pixel];
            window.off[at] = static_cast<std::int16_t>(before.off);
        }
    }

    static Residual mirror_kind(int difference) {
        constexpr std::array<Residual, 4> kKinds = {Residual::kMirrorBelow,
                                                    Residual::kMirrorSame,
                                                    Residual::kMirrorAbove,
                                                    Residual::kMirror};
        return kKinds[std::min(static_cast<unsigned>(difference + 1), 3U)];
    }

    Io& io_;
    const Prediction& prediction_;
    const int follow_;  // a mask
    const std::array<std::uint8_t, kBrickPixels>& alpha_;
    std::array<PlaneWindow, kPlanes> windows_{};
};

template <Predictor kPredictor, bool kSpatial, bool kMirror, typename Io>
void code_pixels(Io& io,
                 const Prediction& prediction,
                 bool follows_green,
                 bool opaque,
                 const std::array<std::uint8_t, kBrickPixels>& alpha) {
    if (opaque) {
        PixelRun<kPredictor, kSpatial, kMirror, true, Io>(
            io, prediction, follows_green, alpha)
            .run();
    } else {
        PixelRun<kPredictor, kSpatial, kMirror, false, Io>(
            io, prediction, follows_green, alpha)
            .run();
    }
}

template <typename Io>
void code_pixels(Io& io,
                 const BrickMode& mode,
                 const Prediction& prediction,
                 bool opaque,
                 const std::array<std::uint8_t, kBrickPixels>& alpha) {
    const bool spatial =
        mode.reference == Reference::kNone || mode.reference == Reference::kCoarse;
    const bool green = mode.follows_green;
    using enum Predictor;
    switch (mode.predictor) {
        case kExact:
            break;
        case kPlain:
            if (mode.reference == Reference::kMirror)
                code_pixels<kPlain, false, true>(io, prediction, green, opaque, alpha);
            else
                code_pixels<kPlain, false, false>(io, prediction, green, opaque, alpha);
            break;
        case kMedian:
            if (spatial)
                code_pixels<kMedian, true, false>(io, prediction, green, opaque, alpha);
            else
                code_pixels<kMedian, false, false>(io, prediction, green, opaque, alpha);
            break;
        case kQuad:
            if (spatial)
                code_pixels<kQuad, true, false>(io, prediction, green, opaque, alpha);
            else
                code_pixels<kQuad, false, false>(io, prediction, green, opaque, alpha);
            break;
    }
}

// Alpha alone: the median of what is to the left and above, 255 at first.
// `io.alpha(context, predicted, pixel)` returns the pixel's alpha.
template <typename Io>
void code_alpha(Io& io) {
    constexpr int kStride = PlaneWindow::kStride;
    PlaneWindow window;
    for (int y = 0; y < kBrickSide; ++y) {
        for (int x = 0; x < kBrickSide; ++x) {
            const int at = (y + 1) * kStride + x + 1;
            int left = window.off[at - 1];
            int above = window.off[at - kStride];
            int corner = window.off[at - kStride - 1];
            if (x == 0 && y == 0) {
                left = above = corner = 255;
            } else if (x == 0) {
                left = corner = above;
            } else if (y == 0) {
                above = corner = left;
            }
            const int slope = std::abs(left - corner) + std::abs(above - corner) +
                              window.magnitude[at - 1] + window.magnitude[at - kStride];
            const int level = x == 0 && y == 0
                                  ? kActivities - 1
                                  : kActivityOf[slope > kLoudest ? kLoudest : slope];
            const int predicted = median(left, above, corner);
            const int value =
                io.alpha(kAlphaContext + level, predicted, y * kBrickSide + x);
            window.off[at] = static_cast<std::int16_t>(value);
            window.magnitude[at] = static_cast<std::int16_t>(
                std::abs(static_cast<std::int8_t>(value - predicted)));
        }
    }
}

}  // namespace haarmony::video
