// Elementary functions made of IEEE additions, multiplications and divisions only: the
// library's sin, exp and pow differ between versions and processors by an ulp, and one
// ulp can move a star or flip a fractal's pixel. With these a seed is the same picture
// on every machine, so lists of results made on generated pictures hold everywhere.
//
// Units   angles in radians.
// Scale   absolute error of sine, cosine, arc_tangent below 1e-8; relative error of
//         exponential and power (of moderate exponents) below 1e-8, of logarithm 1e-11.
// Threads const-safe.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace haarmony::gallery {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTurn = 2 * kPi;

// The largest integer not above x. Requires: |x| < 2^31.
[[nodiscard]] inline int floor_int(double x) {
    const int truncated = static_cast<int>(x);
    return truncated - (x < truncated ? 1 : 0);
}

[[nodiscard]] inline double clamp(double x, double low, double high) {
    return x < low ? low : (x > high ? high : x);
}
[[nodiscard]] inline double clamp01(double x) { return clamp(x, 0, 1); }
[[nodiscard]] inline double mix(double a, double b, double t) { return a + (b - a) * t; }
[[nodiscard]] inline double fraction(double x) { return x - floor_int(x); }

// 0 below `from`, 1 above `to`, smooth between. `from` may be the larger one.
[[nodiscard]] inline double smoothstep(double from, double to, double x) {
    const double t = clamp01((x - from) / (to - from));
    return t * t * (3 - 2 * t);
}

// Requires: |x| < 1e9.
[[nodiscard]] inline double sine(double x) {
    double r = x - floor_int(x / kTurn + 0.5) * kTurn;
    if (r > kPi / 2) r = kPi - r;
    if (r < -kPi / 2) r = -kPi - r;
    const double s = r * r;
    return r * (1 + s * (-1.0 / 6 +
                         s * (1.0 / 120 +
                              s * (-1.0 / 5040 + s * (1.0 / 362880 +
                                                      s * (-1.0 / 39916800 +
                                                           s * (1.0 / 6227020800.0)))))));
}
[[nodiscard]] inline double cosine(double x) { return sine(x + kPi / 2); }

// 0 where the true value is below 2^-1000. Requires: x < 690.
[[nodiscard]] inline double exponential(double x) {
    if (x < -690) return 0;
    const double halves = x * 1.44269504088896340736;
    const int whole = floor_int(halves + 0.5);
    const double r = (halves - whole) * 0.69314718055994530942;
    double term = 1;
    for (int i = 8; i >= 1; --i) term = 1 + r / i * term;
    return term * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + whole) << 52);
}

// Requires: x a positive normal number.
[[nodiscard]] inline double logarithm(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    int exponent = static_cast<int>(bits >> 52) - 1023;
    double mantissa = std::bit_cast<double>((bits & 0x000F'FFFF'FFFF'FFFFULL) |
                                            0x3FF0'0000'0000'0000ULL);
    if (mantissa > 1.41421356) {
        mantissa /= 2;
        ++exponent;
    }
    const double t = (mantissa - 1) / (mantissa + 1);
    const double s = t * t;
    const double series =
        1 + s * (1.0 / 3 +
                 s * (1.0 / 5 +
                      s * (1.0 / 7 + s * (1.0 / 9 + s * (1.0 / 11 + s * (1.0 / 13))))));
    return exponent * 0.69314718055994530942 + 2 * t * series;
}

// 0 for a base of 0. Requires: base >= 0.
[[nodiscard]] inline double power(double base, double exponent) {
    return base < 1e-300 ? 0 : exponential(exponent * logarithm(base));
}

// The angle of (x, y), in (-pi, pi]; 0 at the origin.
[[nodiscard]] inline double arc_tangent(double y, double x) {
    const double ax = std::fabs(x);
    const double ay = std::fabs(y);
    if (ax + ay < 1e-300) return 0;
    double t = ax > ay ? ay / ax : ax / ay;
    double base = 0;
    if (t > 0.41421356) {
        base = kPi / 4;
        t = (t - 1) / (t + 1);
    }
    const double s = t * t;
    double series = 0;
    for (int i = 19; i >= 1; i -= 2) series = 1.0 / i - s * series;
    double angle = base + t * series;
    if (ay > ax) angle = kPi / 2 - angle;
    if (x < 0) angle = kPi - angle;
    return y < 0 ? -angle : angle;
}

}  // namespace haarmony::gallery
