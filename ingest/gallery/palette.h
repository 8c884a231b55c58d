// Colours that go together: OKLCH to linear light, ramps, and schemes around one hue.
//
// Units   Color is linear light with sRGB primaries, 1 = display white, may exceed 1;
//         lightness and chroma as in OKLab; hues in turns (kRed .. kMagenta below).
// Threads const-safe.
// Source  Ottosson: A perceptual color space for image processing (2020).
#pragma once

#include <initializer_list>
#include <vector>

#include "ingest/gallery/elementary.h"
#include "ingest/gallery/random.h"

namespace haarmony::gallery {

struct Color {
    double r = 0;
    double g = 0;
    double b = 0;
};

[[nodiscard]] inline Color operator+(const Color& a, const Color& b) {
    return {a.r + b.r, a.g + b.g, a.b + b.b};
}
[[nodiscard]] inline Color operator*(const Color& a, double s) {
    return {a.r * s, a.g * s, a.b * s};
}
[[nodiscard]] inline Color operator*(const Color& a, const Color& b) {
    return {a.r * b.r, a.g * b.g, a.b * b.b};
}
[[nodiscard]] inline Color mix(const Color& a, const Color& b, double t) {
    return a + (b + a * -1.0) * t;
}
[[nodiscard]] inline double luminance(const Color& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

inline constexpr double kRed = 0.07;
inline constexpr double kOrange = 0.155;
inline constexpr double kGold = 0.235;
inline constexpr double kYellow = 0.295;
inline constexpr double kLime = 0.345;
inline constexpr double kGreen = 0.405;
inline constexpr double kTeal = 0.505;
inline constexpr double kCyan = 0.57;
inline constexpr double kSkyBlue = 0.66;
inline constexpr double kBlue = 0.735;
inline constexpr double kViolet = 0.81;
inline constexpr double kPurple = 0.87;
inline constexpr double kMagenta = 0.93;

// The colour of this lightness and hue whose chroma is the wanted one, or as much of it
// as fits into sRGB. Requires: lightness in [0, 1], chroma >= 0.
[[nodiscard]] Color oklch(double lightness, double chroma, double hue);

// The same from a braced list, whose parts are worked out in the order in which they are
// written: several random parts as plain arguments would differ between compilers.
struct Lch {
    double lightness;
    double chroma;
    double hue;
};
[[nodiscard]] inline Color oklch(const Lch& color) {
    return oklch(color.lightness, color.chroma, color.hue);
}

// A smooth way through several colours, interpolated in OKLab and tabulated.
class Ramp {
  public:
    struct Stop {
        double at;
        Color color;
    };
    // Requires: stops ascending in `at`, at least one.
    explicit Ramp(const std::vector<Stop>& stops);
    // Stops at equal distances from 0 to 1.
    Ramp(std::initializer_list<Color> colors);

    // Clamped to the ends outside of [0, 1].
    [[nodiscard]] Color at(double t) const;
    // Goes round: at(0) follows at(1). Requires: the first and last stop are equal.
    [[nodiscard]] Color around(double t) const { return at(fraction(t)); }

  private:
    std::vector<Color> table_;
};

// Hues that harmonise with a base hue: neighbours, opposites, triads.
[[nodiscard]] std::vector<double> harmony(Random& random, double base_hue);

// The colour itself with its lightness multiplied in OKLab (a shade or a tint).
[[nodiscard]] Color shade_of(const Color& color, double factor);

}  // namespace haarmony::gallery
