// Smooth noise: random numbers on a lattice, and in between what lies between.
//   [lattice_noise.h] -> wind.h, panorama.h
//
// Scale  values in [-1, 1); about as many lattice points as units.
#pragma once

#include <cmath>
#include <cstdint>

namespace haarmony::video {

// Every bit of the result depends on every bit of the value.
[[nodiscard]] constexpr std::uint32_t scrambled(std::uint32_t value) {
    value = (value ^ value >> 16) * 0x7FEB352DU;
    value = (value ^ value >> 15) * 0x846CA68BU;
    return value ^ value >> 16;
}

class LatticeNoise {
  public:
    explicit constexpr LatticeNoise(std::uint32_t seed) : seed_(seed) {}

    [[nodiscard]] double operator()(double x, double y, double z) const {
        const double fx = std::floor(x), fy = std::floor(y), fz = std::floor(z);
        const double u = eased(x - fx), v = eased(y - fy), w = eased(z - fz);
        const auto ix = static_cast<std::int32_t>(fx), iy = static_cast<std::int32_t>(fy),
                   iz = static_cast<std::int32_t>(fz);
        const auto plane = [&](std::int32_t k) {
            return between(between(at(ix, iy, k), at(ix + 1, iy, k), u),
                           between(at(ix, iy + 1, k), at(ix + 1, iy + 1, k), u),
                           v);
        };
        return between(plane(iz), plane(iz + 1), w);
    }

  private:
    static double eased(double t) { return t * t * (3 - 2 * t); }
    static double between(double a, double b, double t) { return a + (b - a) * t; }
    [[nodiscard]] double at(std::int32_t x, std::int32_t y, std::int32_t z) const {
        const std::uint32_t bits =
            scrambled(scrambled(scrambled(seed_ + static_cast<std::uint32_t>(x)) +
                                static_cast<std::uint32_t>(y)) +
                      static_cast<std::uint32_t>(z));
        return static_cast<double>(bits) / 2147483648.0 - 1;
    }

    std::uint32_t seed_;
};

}  // namespace haarmony::video
