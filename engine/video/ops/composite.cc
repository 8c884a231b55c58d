#include "engine/video/ops/composite.h"

#include <cassert>
#include <string>

#include "engine/video/ops/tree_square.h"
#include "engine/video/tree_writer.h"

namespace haarmony::video {
namespace {

// What is multiplied with one pixel's alpha is a function of the other's: 0, 255, the
// other alpha or 255 less that, each of them base ^ (mask & alpha) in 8 bits.
struct Factor {
    std::uint8_t base;
    std::uint8_t mask;

    [[nodiscard]] constexpr std::uint32_t of(std::uint8_t alpha) const {
        return static_cast<std::uint32_t>(base ^ (mask & alpha));
    }
};
constexpr Factor kNone{0, 0};
constexpr Factor kAll{255, 0};
constexpr Factor kInside{0, 255};
constexpr Factor kOutside{255, 255};

struct Factors {
    Factor a;
    Factor b;
};

constexpr std::array<Factors, kOperatorNames.size()> kFactors = {{
    {kNone, kNone},        // clear
    {kAll, kNone},         // a
    {kNone, kAll},         // b
    {kAll, kOutside},      // a over b
    {kOutside, kAll},      // b over a
    {kInside, kNone},      // a in b
    {kNone, kInside},      // b in a
    {kOutside, kNone},     // a out b
    {kNone, kOutside},     // b out a
    {kInside, kOutside},   // a atop b
    {kOutside, kInside},   // b atop a
    {kOutside, kOutside},  // xor
}};

const Factors& factors_of(Operator op) { return kFactors[static_cast<std::size_t>(op)]; }

Rgba mix(Rgba a, Rgba b, const Factors& factors) {
    const std::uint32_t fa = factors.a.of(b.a), fb = factors.b.of(a.a);
    const std::uint32_t wa = fa * a.a, wb = fb * b.a;
    // Where one of the two is nothing and the other whole, rounding gives it back
    // unchanged.
    if (wb == 0 && fa == 255) return canonical(a);
    if (wa == 0 && fb == 255) return canonical(b);
    const std::uint32_t both = wa + wb;
    const std::uint32_t alpha = (2 * both + 255) / 510;
    if (alpha == 0) return kClear;
    const auto channel = [=](std::uint32_t ca, std::uint32_t cb) {
        return static_cast<std::uint8_t>((2 * (wa * ca + wb * cb) + both) / (2 * both));
    };
    return {channel(a.r, b.r),
            channel(a.g, b.g),
            channel(a.b, b.b),
            static_cast<std::uint8_t>(alpha)};
}

class Compositing {
  public:
    Compositing(Operator op, ImageTree& out) : factors_(factors_of(op)), writer_(out) {}

    Visited run(const ImageTree& a, const ImageTree& b) {
        writer_.finish(emit(TreeSquare::root_of(a), TreeSquare::root_of(b)));
        return visited_;
    }

  private:
    TreePart emit(const TreeSquare& a, const TreeSquare& b) {
        visited_.read += 2;
        ++visited_.written;
        std::array<TreePart, 4> quadrants;
        for (int q = 0; q < 4; ++q) {
            const bool finer = a.has_child(q) || b.has_child(q);
            quadrants[static_cast<std::size_t>(q)] =
                finer ? emit(a.quadrant(q), b.quadrant(q))
                      : pixels(a.quadrant(q), b.quadrant(q));
        }
        return writer_.join(quadrants);
    }

    // The 4 x 4 pixels of a quadrant in which neither has finer detail.
    [[nodiscard]] TreePart pixels(const TreeSquare& a, const TreeSquare& b) const {
        constexpr int half = kBrickSide / 2;
        TreePart part;
        if (a.flat() && b.flat()) {
            part.pixels.fill(mix(a.pixel(0, 0), b.pixel(0, 0), factors_));
            return part;
        }
        auto out = part.pixels.begin();
        for (int y = 0; y < half; ++y) {
            for (int x = 0; x < half; ++x) {
                *out++ = mix(a.pixel(x * a.side() / half, y * a.side() / half),
                             b.pixel(x * b.side() / half, y * b.side() / half),
                             factors_);
            }
        }
        return part;
    }

    Factors factors_;
    TreeWriter writer_;
    Visited visited_;
};

}  // namespace

Result<Operator> parse_operator(std::string_view name) {
    for (std::size_t i = 0; i < kOperatorNames.size(); ++i) {
        if (kOperatorNames[i] == name) return static_cast<Operator>(i);
    }
    std::string all;
    for (const std::string_view each : kOperatorNames) {
        all += (all.empty() ? "" : " ") + std::string(each);
    }
    return Error{ErrorCode::kInvalidArgument,
                 "op is '" + std::string(name) + "'; want one of " + all,
                 "op"};
}

Rgba composite(Rgba a, Rgba b, Operator op) { return mix(a, b, factors_of(op)); }

Visited composite(const ImageTree& a, const ImageTree& b, Operator op, ImageTree& out) {
    assert(&out != &a && &out != &b);
    return Compositing(op, out).run(a, b);
}

}  // namespace haarmony::video
