#include "ingest/gallery/blossom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ingest/gallery/noise.h"

namespace haarmony::gallery {
namespace {

constexpr double kGoldenAngle = 2.39996322972865332;

// Half the width at t of the length, at most about 1.
double half_width(Outline outline, double t) {
    switch (outline) {
        case Outline::kRound:
            return power(sine(kPi * power(t, 1.4)), 0.62);
        case Outline::kPointed:
            return sine(kPi * power(t, 0.85)) * (1.1 - 0.35 * t);
        case Outline::kHeart:
            return power(sine(kPi * power(t, 1.9)), 0.5) * 1.05;
        case Outline::kNarrow:
            break;
    }
    return power(sine(kPi * power(t, 0.7)), 0.8);
}

std::vector<Point> petal_outline(Point root,
                                 double angle,
                                 double size,
                                 double breadth,
                                 Outline outline) {
    constexpr int kSteps = 14;
    std::vector<Point> left;
    std::vector<Point> right;
    for (int i = 0; i <= kSteps; ++i) {
        const double t = static_cast<double>(i) / kSteps;
        const double w = half_width(outline, t) * breadth * size * 0.5;
        // The tip of a heart is notched.
        const double notch = outline == Outline::kHeart && i == kSteps ? 0.12 : 0;
        left.push_back(root + turned({-w, -size * (t - notch)}, angle));
        right.push_back(root + turned({w, -size * (t - notch)}, angle));
    }
    left.insert(left.end(), right.rbegin(), right.rend());
    return left;
}

void cast_shadow(Canvas& canvas, const Mask& mask, double size, double strength) {
    Mask shadow = soften(canvas.frame(), mask, size * 0.06);
    shadow.top += std::max(1, static_cast<int>(size * 0.07 * canvas.height()));
    shadow.left += static_cast<int>(size * 0.03 * canvas.height());
    canvas.glaze(shadow, {0.12, 0.1, 0.16}, 0.62 * strength);
}

struct Colors {
    Color inner;
    Color outer;
};

Colors petal_colors(Random& random, double hue) {
    return {oklch(random.between(0.34, 0.5), 0.19, hue - 0.03),
            oklch(random.between(0.72, 0.86), 0.16, hue + 0.02)};
}

// Rings of petals, the outermost first.
void rings(Canvas& canvas,
           Point centre,
           double radius,
           int count,
           int layers,
           double breadth,
           Outline outline,
           const Colors& colors,
           Random& random) {
    const double start = random.between(0, kTurn);
    for (int layer = 0; layer < layers; ++layer) {
        const double size = radius * (1 - 0.72 * layer / layers);
        const int petals = std::max(5, count - layer);
        const double tone = 1 + 0.06 * layer;
        for (int i = 0; i < petals; ++i) {
            const double angle =
                start + kTurn * (i + 0.5 * layer) / petals + random.bell() * 0.02;
            const double reach = size * random.between(0.93, 1.05);
            paint_petal(canvas,
                        centre,
                        angle,
                        reach,
                        breadth,
                        outline,
                        colors.inner,
                        shade_of(colors.outer, tone * random.between(0.93, 1.04)),
                        layers > 3 ? 0.6 : 0.8);
        }
    }
}

// Seeds in the pattern of the golden angle.
void seed_head(Canvas& canvas,
               Point centre,
               double radius,
               int count,
               const Color& middle,
               const Color& rim) {
    canvas.fill(cover_disc(canvas.frame(), centre, radius), shade_of(rim, 0.7));
    for (int i = 0; i < count; ++i) {
        const double t = std::sqrt((i + 0.5) / count);
        const Point p = centre + turned({0, -radius * t}, i * kGoldenAngle);
        const Color c = mix(middle, rim, t);
        const double r = radius * 0.9 / std::sqrt(static_cast<double>(count));
        canvas.disc(p, r, c * 0.55);
        canvas.disc(p - Point{r * 0.25, r * 0.3}, r * 0.65, c);
    }
}

}  // namespace

const char* name_of(Species species) {
    static constexpr const char* kNames[] = {
        "Daisy", "Rose", "Sunflower", "Poppy", "Lotus", "Tulip", "Pansy", "Dahlia"};
    return kNames[static_cast<int>(species)];
}

void paint_petal(Canvas& canvas,
                 Point root,
                 double angle,
                 double size,
                 double breadth,
                 Outline outline,
                 const Color& inner,
                 const Color& outer,
                 double shadow) {
    const Mask mask =
        cover_polygon(canvas.frame(), petal_outline(root, angle, size, breadth, outline));
    if (mask.empty()) return;
    if (shadow > 0 && size > 6 * canvas.pixel()) cast_shadow(canvas, mask, size, shadow);
    const double c = cosine(-angle);
    const double s = sine(-angle);
    const auto seed = static_cast<std::uint32_t>(floor_int(angle * 1000));
    canvas.shade(mask, 1, [&](Point p) {
        const Point d = p - root;
        const double along = -(d.x * s + d.y * c) / size;
        const double across = (d.x * c - d.y * s) / (size * breadth * 0.5);
        const double vein = noise(across * 9 / (0.3 + along), along * 1.5, seed);
        const double fold =
            1 - 0.22 * (1 - std::fabs(across)) * (1 - along) + 0.1 * across;
        const Color tone =
            mix(inner,
                outer,
                smoothstep(-0.05, 0.85, along + 0.09 * vein + 0.12 * std::fabs(across)));
        return tone * (fold * (1 + 0.07 * vein));
    });
}

void paint_leaf(Canvas& canvas,
                Point root,
                double angle,
                double size,
                double breadth,
                const Color& color) {
    const Mask mask = cover_polygon(
        canvas.frame(), petal_outline(root, angle, size, breadth, Outline::kPointed));
    if (mask.empty()) return;
    if (size > 10 * canvas.pixel()) cast_shadow(canvas, mask, size, 0.6);
    const double c = cosine(-angle);
    const double s = sine(-angle);
    const Color vein = shade_of(color, 1.3);
    canvas.shade(mask, 1, [&](Point p) {
        const Point d = p - root;
        const double along = -(d.x * s + d.y * c) / size;
        const double across = (d.x * c - d.y * s) / (size * breadth * 0.5);
        const double side = fraction(along * 8 - std::fabs(across) * 1.6 + 4);
        const double line = std::max(smoothstep(0.1, 0.02, std::fabs(across)),
                                     0.5 * smoothstep(0.14, 0.03, std::fabs(side - 0.5)));
        const double light = 0.82 + (across > 0 ? 0.2 : 0) + 0.15 * std::fabs(side - 0.5);
        return mix(color * light, vein, 0.6 * line);
    });
}

void paint_blossom(Canvas& canvas,
                   Species species,
                   Point centre,
                   double radius,
                   double hue,
                   Random& random) {
    const Colors colors = petal_colors(random, hue);
    switch (species) {
        case Species::kDaisy: {
            const bool white = random.chance(0.4);
            const Colors own =
                white ? Colors{oklch(0.75, 0.06, hue), oklch(0.97, 0.02, hue)} : colors;
            rings(canvas, centre, radius, 17, 2, 0.3, Outline::kRound, own, random);
            seed_head(canvas,
                      centre,
                      radius * 0.27,
                      160,
                      oklch(0.86, 0.16, kGold),
                      oklch(0.66, 0.16, kOrange));
            return;
        }
        case Species::kRose: {
            constexpr int kPetals = 34;
            for (int i = 0; i < kPetals; ++i) {
                const double t = static_cast<double>(i) / kPetals;
                const double reach = radius * mix(0.98, 0.14, power(t, 0.8));
                const double angle = i * kGoldenAngle + random.bell() * 0.1;
                const Point root = centre + turned({0, reach * 0.2}, angle);
                paint_petal(canvas,
                            root,
                            angle,
                            reach * 1.1,
                            mix(1.15, 1.5, t),
                            Outline::kRound,
                            colors.inner,
                            shade_of(colors.outer, mix(1.04, 0.8, t)),
                            0.9);
            }
            return;
        }
        case Species::kSunflower: {
            const Colors own{oklch(0.66, 0.18, 0.16 + 0.05 * random.unit()),
                             oklch(0.88, 0.18, 0.26)};
            rings(canvas, centre, radius, 24, 2, 0.26, Outline::kPointed, own, random);
            seed_head(canvas,
                      centre,
                      radius * 0.48,
                      420,
                      oklch(0.45, 0.09, 0.2),
                      oklch(0.32, 0.08, 0.12));
            return;
        }
        case Species::kPoppy: {
            for (int i = 0; i < 6; ++i)
                paint_petal(canvas,
                            centre,
                            kTurn * i / 6 + (i > 2 ? 0.5 : 0),
                            radius * (i < 3 ? 1.0 : 0.86),
                            1.25,
                            Outline::kRound,
                            shade_of(colors.inner, 0.5),
                            colors.outer,
                            0.8);
            for (int i = 0; i < 60; ++i) {
                const double reach = radius * random.between(0.14, 0.3);
                const Point p = centre + turned({0, -reach}, random.between(0, kTurn));
                canvas.line(centre, p, radius * 0.006, {0.03, 0.02, 0.04});
                canvas.disc(p, radius * 0.02, {0.04, 0.03, 0.05});
            }
            canvas.disc(centre, radius * 0.13, oklch(0.62, 0.12, kLime));
            return;
        }
        case Species::kLotus:
            rings(canvas,
                  centre,
                  radius,
                  11,
                  5,
                  0.42,
                  Outline::kPointed,
                  {colors.outer, mix(colors.outer, Color{1, 1, 1}, 0.55)},
                  random);
            seed_head(canvas,
                      centre,
                      radius * 0.17,
                      60,
                      oklch(0.88, 0.16, kYellow),
                      oklch(0.8, 0.16, kGold));
            return;
        case Species::kTulip: {
            static constexpr std::array<std::array<double, 3>, 5> kCup = {
                {{-0.42, 1.0, 0.62},
                 {0.42, 1.0, 0.62},
                 {0.0, 1.06, 0.6},
                 {-0.2, 0.95, 0.72},
                 {0.2, 0.95, 0.72}}};
            for (const auto& [lean, height, breadth] : kCup)
                paint_petal(canvas,
                            centre + Point{0, radius * 0.8},
                            lean * 0.75,
                            radius * 1.75 * height,
                            breadth,
                            Outline::kPointed,
                            colors.inner,
                            colors.outer,
                            0.6);
            return;
        }
        case Species::kPansy: {
            const Color second = oklch(0.85, 0.16, hue + 0.35);
            static constexpr double kAngles[] = {-0.75, 0.75, -1.75, 1.75, kPi};
            for (int i = 0; i < 5; ++i)
                paint_petal(canvas,
                            centre,
                            kAngles[i],
                            radius,
                            i == 4 ? 1.3 : 1.05,
                            Outline::kHeart,
                            i < 2 ? colors.inner : Color{0.02, 0.005, 0.03},
                            i < 2 ? shade_of(colors.outer, 0.8) : second,
                            0.8);
            canvas.disc(centre, radius * 0.09, oklch(0.86, 0.18, kYellow));
            return;
        }
        case Species::kDahlia:
            rings(canvas, centre, radius, 21, 8, 0.33, Outline::kNarrow, colors, random);
            return;
    }
}

}  // namespace haarmony::gallery
