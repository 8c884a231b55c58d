#include "ingest/gallery/palette.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace haarmony::gallery {
namespace {

constexpr int kRampSteps = 512;
constexpr int kGamutSteps = 12;

struct Lab {
    double l = 0;
    double a = 0;
    double b = 0;
};

double cube_root(double x) { return x < 0 ? -power(-x, 1.0 / 3) : power(x, 1.0 / 3); }

Lab to_lab(const Color& c) {
    const double l =
        cube_root(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b);
    const double m =
        cube_root(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b);
    const double s =
        cube_root(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Color from_lab(const Lab& lab) {
    const double l = lab.l + 0.3963377774 * lab.a + 0.2158037573 * lab.b;
    const double m = lab.l - 0.1055613458 * lab.a - 0.0638541728 * lab.b;
    const double s = lab.l - 0.0894841775 * lab.a - 1.2914855480 * lab.b;
    const double l3 = l * l * l;
    const double m3 = m * m * m;
    const double s3 = s * s * s;
    return {4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3,
            -1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3,
            -0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3};
}

bool displayable(const Color& c) {
    constexpr double kSlack = 1e-6;
    return std::min({c.r, c.g, c.b}) >= -kSlack &&
           std::max({c.r, c.g, c.b}) <= 1 + kSlack;
}

Color clipped(const Color& c) { return {clamp01(c.r), clamp01(c.g), clamp01(c.b)}; }

}  // namespace

Color oklch(double lightness, double chroma, double hue) {
    assert(chroma >= 0);
    const double a = cosine(hue * kTurn);
    const double b = sine(hue * kTurn);
    const Color wanted = from_lab({lightness, chroma * a, chroma * b});
    if (displayable(wanted)) return clipped(wanted);
    double inside = 0;
    double outside = chroma;
    for (int i = 0; i < kGamutSteps; ++i) {
        const double middle = (inside + outside) / 2;
        const bool fits = displayable(from_lab({lightness, middle * a, middle * b}));
        (fits ? inside : outside) = middle;
    }
    return clipped(from_lab({lightness, inside * a, inside * b}));
}

Ramp::Ramp(const std::vector<Stop>& stops) {
    assert(!stops.empty());
    std::vector<Lab> labs;
    labs.reserve(stops.size());
    for (const Stop& stop : stops) labs.push_back(to_lab(stop.color));
    table_.reserve(kRampSteps + 1);
    std::size_t next = 0;
    for (int i = 0; i <= kRampSteps; ++i) {
        const double t = static_cast<double>(i) / kRampSteps;
        while (next < stops.size() && stops[next].at <= t) ++next;
        if (next == 0 || next == stops.size()) {
            table_.push_back(next == 0 ? stops.front().color : stops.back().color);
            continue;
        }
        const Lab& low = labs[next - 1];
        const Lab& high = labs[next];
        const double u = (t - stops[next - 1].at) / (stops[next].at - stops[next - 1].at);
        const Color c = from_lab(
            {mix(low.l, high.l, u), mix(low.a, high.a, u), mix(low.b, high.b, u)});
        table_.push_back({std::max(0.0, c.r), std::max(0.0, c.g), std::max(0.0, c.b)});
    }
}

namespace {

std::vector<Ramp::Stop> spread(std::initializer_list<Color> colors) {
    std::vector<Ramp::Stop> stops;
    const auto last = static_cast<double>(std::max<std::size_t>(colors.size() - 1, 1));
    for (const Color& color : colors)
        stops.push_back({static_cast<double>(stops.size()) / last, color});
    return stops;
}

}  // namespace

Ramp::Ramp(std::initializer_list<Color> colors) : Ramp(spread(colors)) {}

Color Ramp::at(double t) const {
    const double position = clamp01(t) * kRampSteps;
    const int step = std::min(static_cast<int>(position), kRampSteps - 1);
    const auto i = static_cast<std::size_t>(step);
    return mix(table_[i], table_[i + 1], position - step);
}

std::vector<double> harmony(Random& random, double base_hue) {
    static constexpr double kOffsets[][5] = {
        {0, 0.06, -0.06, 0.11, 0.5},    // neighbours and an accent
        {0, 0.5, 0.04, 0.46, 0.54},     // opposites
        {0, 0.333, 0.667, 0.03, 0.36},  // triad
        {0, 0.42, 0.58, 0.05, -0.05},   // split opposite
        {0, 0.25, 0.5, 0.75, 0.05},     // square
    };
    const auto& offsets = random.pick(kOffsets);
    std::vector<double> hues;
    for (const double offset : offsets)
        hues.push_back(fraction(base_hue + offset + random.between(-0.012, 0.012) + 1));
    return hues;
}

Color shade_of(const Color& color, double factor) {
    Lab lab = to_lab(color);
    lab.l *= factor;
    const double chroma = factor > 1 ? 1 / factor : (1 + factor) / 2;
    lab.a *= chroma;
    lab.b *= chroma;
    const Color c = from_lab(lab);
    return {std::max(0.0, c.r), std::max(0.0, c.g), std::max(0.0, c.b)};
}

}  // namespace haarmony::gallery
