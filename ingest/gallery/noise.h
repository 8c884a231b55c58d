// Smooth random fields of the plane: the raw matter of clouds, mountains and marble.
//
// Units   one lattice cell is one unit of the arguments; values about [-1, 1].
// Threads const-safe.
// Source  Perlin: Improving noise (2002); Musgrave: ridged multifractals;
//         Worley: A cellular texture basis function (1996).
#pragma once

#include <cstdint>

namespace haarmony::gallery {

// Gradient noise; 0 at the lattice points.
[[nodiscard]] double noise(double x, double y, std::uint32_t seed);

// Octaves of noise, each of double frequency and half amplitude.
[[nodiscard]] double fbm(double x, double y, int octaves, std::uint32_t seed);

// The same with sharp crests, in [0, 1].
[[nodiscard]] double ridged(double x, double y, int octaves, std::uint32_t seed);

struct Cell {
    double nearest = 0;    // distance to the nearest feature point
    double second = 0;     // distance to the one after it
    std::uint32_t id = 0;  // a random value of the nearest point's own
};
[[nodiscard]] Cell cell(double x, double y, std::uint32_t seed);

// A random value of a lattice point.
[[nodiscard]] std::uint32_t lattice_hash(int x, int y, std::uint32_t seed);

// The same in [0, 1).
[[nodiscard]] double lattice_unit(int x, int y, std::uint32_t seed);

}  // namespace haarmony::gallery
