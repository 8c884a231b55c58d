#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ingest/gallery/painters.h"

// Iterated function systems with variations. Source: Draves, Reckase: The fractal flame
// algorithm (2003).
namespace haarmony::gallery {
namespace {

enum class Variation {
    kLinear,
    kSinusoidal,
    kSpherical,
    kSwirl,
    kHorseshoe,
    kPolar,
    kDisc,
    kHeart,
    kJulia,
    kBubble
};
constexpr int kVariations = 10;

struct Step {
    double a, b, c, d, e, f;  // x' = a x + b y + c, y' = d x + e y + f
    Variation variation;
    double blend;  // 1 = all variation, 0 = affine only
    double color;  // in [0, 1] along the ramp
};

Point vary(Variation variation, Point p, Random& random) {
    const double r2 = p.x * p.x + p.y * p.y + 1e-9;
    const double r = std::sqrt(r2);
    switch (variation) {
        case Variation::kLinear:
            return p;
        case Variation::kSinusoidal:
            return {sine(p.x), sine(p.y)};
        case Variation::kSpherical:
            return p * (1 / r2);
        case Variation::kSwirl: {
            const double s = sine(r2);
            const double c = cosine(r2);
            return {p.x * s - p.y * c, p.x * c + p.y * s};
        }
        case Variation::kHorseshoe:
            return {(p.x - p.y) * (p.x + p.y) / r, 2 * p.x * p.y / r};
        case Variation::kPolar:
            return {arc_tangent(p.x, p.y) / kPi, r - 1};
        case Variation::kDisc: {
            const double t = arc_tangent(p.x, p.y) / kPi;
            return {t * sine(kPi * r), t * cosine(kPi * r)};
        }
        case Variation::kHeart: {
            const double t = arc_tangent(p.x, p.y) * r;
            return {r * sine(t), -r * cosine(t)};
        }
        case Variation::kJulia: {
            // Half the angle at the root of the radius, on one of two branches.
            const double root = std::sqrt(r);
            const double c = std::sqrt(std::max(0.0, (1 + p.x / r) / 2)) * root;
            const double s =
                std::sqrt(std::max(0.0, (1 - p.x / r) / 2)) * root * (p.y < 0 ? -1 : 1);
            return random.next() >> 63 ? Point{c, s} : Point{-c, -s};
        }
        case Variation::kBubble:
            break;
    }
    return p * (4 / (r2 + 4));
}

struct System {
    std::vector<Step> steps;
    int symmetry = 1;
};

System invent(Random& random) {
    System system;
    const int count = 2 + random.below(3);
    const auto main = static_cast<Variation>(random.below(kVariations));
    for (int i = 0; i < count; ++i) {
        // A turn, a contraction and a shift, slightly sheared.
        const double angle = random.between(-kPi, kPi);
        const double scale = random.between(0.45, 0.95);
        const double c = cosine(angle) * scale;
        const double s = sine(angle) * scale;
        system.steps.push_back({c,
                                -s * random.between(0.7, 1.2),
                                random.between(-0.9, 0.9),
                                s,
                                c * random.between(0.7, 1.2),
                                random.between(-0.9, 0.9),
                                random.chance(0.6)
                                    ? main
                                    : static_cast<Variation>(random.below(kVariations)),
                                random.between(0.55, 1.0),
                                (i + 0.5) / count});
    }
    system.symmetry = random.pick({1, 2, 3, 4, 5, 6});
    return system;
}

struct Mote {
    Point at{0.1, 0.2};
    double color = 0.5;
};

void advance(const System& system, Mote& mote, Random& random) {
    const auto& step = system.steps[(random.next() >> 32) * system.steps.size() >> 32];
    const Point p{step.a * mote.at.x + step.b * mote.at.y + step.c,
                  step.d * mote.at.x + step.e * mote.at.y + step.f};
    const Point v = vary(step.variation, p, random);
    mote.at = p * (1 - step.blend) + v * step.blend;
    mote.color = (mote.color + step.color) / 2;
    if (std::fabs(mote.at.x) + std::fabs(mote.at.y) > 1e4)
        mote.at = {random.between(-1, 1), random.between(-1, 1)};
}

// Where the middle nine tenths of the motes are, and how evenly they fill it.
struct Extent {
    Point centre;
    double reach = 1;
    double filled = 0;
};

Extent survey(const System& system, Random random) {
    constexpr int kMotes = 4000;
    constexpr int kGrid = 24;
    Mote mote;
    std::vector<double> xs;
    std::vector<double> ys;
    for (int i = 0; i < 40; ++i) advance(system, mote, random);
    for (int i = 0; i < kMotes; ++i) {
        advance(system, mote, random);
        const Point p = turned(mote.at, kTurn * (i % system.symmetry) / system.symmetry);
        xs.push_back(p.x);
        ys.push_back(p.y);
    }
    std::vector<double> x_order = xs;
    std::vector<double> y_order = ys;
    std::sort(x_order.begin(), x_order.end());
    std::sort(y_order.begin(), y_order.end());
    constexpr std::size_t kLow = kMotes / 25;
    constexpr std::size_t kHigh = kMotes - kLow;
    Extent extent;
    extent.centre = {(x_order[kLow] + x_order[kHigh]) / 2,
                     (y_order[kLow] + y_order[kHigh]) / 2};
    extent.reach =
        std::max({x_order[kHigh] - x_order[kLow], y_order[kHigh] - y_order[kLow], 1e-3}) /
        2;
    std::array<bool, kGrid * kGrid> seen{};
    for (std::size_t i = 0; i < xs.size(); ++i) {
        const double u = (xs[i] - extent.centre.x) / extent.reach / 2 + 0.5;
        const double v = (ys[i] - extent.centre.y) / extent.reach / 2 + 0.5;
        if (u < 0 || v < 0 || u >= 1 || v >= 1) continue;
        seen[static_cast<std::size_t>(v * kGrid) * kGrid +
             static_cast<std::size_t>(u * kGrid)] = true;
    }
    extent.filled =
        static_cast<double>(std::count(seen.begin(), seen.end(), true)) / (kGrid * kGrid);
    return extent;
}

struct Bin {
    float count = 0;
    float color = 0;
};

// Thinly hit places are noisy: they take the mean of their surroundings, in proportion.
std::vector<Bin> smoothed(const std::vector<Bin>& bins, int width, int height) {
    std::vector<Bin> wide(bins.size());
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Bin sum;
            for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j) {
                for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i) {
                    const Bin& bin = bins[static_cast<std::size_t>(j) * width + i];
                    sum.count += bin.count;
                    sum.color += bin.color;
                }
            }
            const Bin& own = bins[static_cast<std::size_t>(y) * width + x];
            const float keep = static_cast<float>(smoothstep(2, 26, own.count));
            wide[static_cast<std::size_t>(y) * width + x] = {
                own.count * keep + sum.count / 9 * (1 - keep),
                own.color * keep + sum.color / 9 * (1 - keep)};
        }
    }
    return wide;
}

}  // namespace

Label paint_flame(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    System system = invent(random);
    Extent extent = survey(system, random);
    // Most systems collapse to a few points or scatter to dust; take one that does neither.
    for (int attempt = 0; attempt < 30 && (extent.filled < 0.36 || extent.filled > 0.93);
         ++attempt) {
        system = invent(random);
        extent = survey(system, random);
    }
    const std::vector<double> hues = harmony(random, commission.hue);
    const Ramp ramp{oklch(0.55, 0.22, hues[0]),
                    oklch(0.75, 0.18, hues[2]),
                    oklch(0.60, 0.22, hues[1]),
                    oklch(0.88, 0.13, hues[3])};
    const bool on_light = commission.turn % 5 == 3;
    const int width = canvas.width();
    const int height = canvas.height();
    std::vector<Bin> bins(static_cast<std::size_t>(width) * height);
    const double scale = 0.46 * std::min(width, height) / extent.reach;
    // Each mote appears in one of the turned copies, in turn. A system without symmetry
    // stands upright.
    const double tilt = system.symmetry > 1 ? random.between(0, kTurn) : 0;
    std::vector<Point> axes;
    for (int i = 0; i < system.symmetry; ++i)
        axes.push_back(turned({scale, 0}, tilt + kTurn * i / system.symmetry));
    const Point centre =
        Point{width / 2.0, height / 2.0} - turned(extent.centre * scale, tilt);
    const int motes = width * height * 3;
    Mote mote;
    for (int i = 0; i < 40; ++i) advance(system, mote, random);
    std::size_t copy = 0;
    for (int i = 0; i < motes; ++i) {
        advance(system, mote, random);
        copy = copy + 1 < axes.size() ? copy + 1 : 0;
        const Point axis = axes[copy];
        const double x = mote.at.x * axis.x - mote.at.y * axis.y + centre.x;
        const double y = mote.at.x * axis.y + mote.at.y * axis.x + centre.y;
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        Bin& bin =
            bins[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
        bin.count += 1;
        bin.color += static_cast<float>(mote.color);
    }
    bins = smoothed(smoothed(bins, width, height), width, height);
    const Color ground =
        on_light ? oklch(0.95, 0.04, hues[1]) : oklch(0.13, 0.06, hues[1]);
    const Point middle{canvas.aspect() / 2, 0.5};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Bin& bin = bins[static_cast<std::size_t>(y) * width + x];
            const double far = length(canvas.point(x, y) - middle);
            Color c = ground * (1.25 - 0.8 * far);
            if (bin.count > 0.001F) {
                const double bright = logarithm(1 + bin.count) / logarithm(38);
                const Color tone = ramp.at(bin.color / bin.count);
                if (on_light) {
                    c = mix(
                        c, tone * (1.1 - 0.55 * clamp01(bright)), clamp01(bright * 1.2));
                } else {
                    c = c + tone * (1.7 * bright * bright) +
                        Color{1, 1, 1} * (0.25 * power(bright, 4));
                }
            }
            canvas.set(x, y, c);
        }
    }
    static constexpr const char* kNames[] = {"linear",
                                             "sinusoidal",
                                             "spherical",
                                             "swirl",
                                             "horseshoe",
                                             "polar",
                                             "disc",
                                             "heart",
                                             "julia",
                                             "bubble"};
    return {std::string("Flame, ") + kNames[static_cast<int>(system.steps[0].variation)],
            {"flame", "fractal"}};
}

}  // namespace haarmony::gallery
