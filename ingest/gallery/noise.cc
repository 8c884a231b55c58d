#include "ingest/gallery/noise.h"

#include <cmath>

#include "ingest/gallery/elementary.h"

namespace haarmony::gallery {
namespace {

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

// Sixteen directions; eight would show as a grid in slow gradients.
constexpr double kGradients[16][2] = {{1, 0},
                                      {0.92388, 0.38268},
                                      {0.70711, 0.70711},
                                      {0.38268, 0.92388},
                                      {0, 1},
                                      {-0.38268, 0.92388},
                                      {-0.70711, 0.70711},
                                      {-0.92388, 0.38268},
                                      {-1, 0},
                                      {-0.92388, -0.38268},
                                      {-0.70711, -0.70711},
                                      {-0.38268, -0.92388},
                                      {0, -1},
                                      {0.38268, -0.92388},
                                      {0.70711, -0.70711},
                                      {0.92388, -0.38268}};

// `corner` is a sum of multiples of the coordinates; one more multiplication is enough
// for the four bits that are taken, and noise is where most pictures spend their time.
double slope(std::uint32_t corner, double dx, double dy) {
    corner = (corner ^ (corner >> 15)) * 0x2C1B3C6DU;
    const auto& g = kGradients[corner >> 28];
    return g[0] * dx + g[1] * dy;
}

constexpr std::uint32_t kAcross = 0x9E3779B1U;
constexpr std::uint32_t kDown = 0x85EBCA77U;

}  // namespace

std::uint32_t lattice_hash(int x, int y, std::uint32_t seed) {
    std::uint32_t h = seed ^ (static_cast<std::uint32_t>(x) * 0x9E3779B1U) ^
                      (static_cast<std::uint32_t>(y) * 0x85EBCA77U);
    h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
    h = (h ^ (h >> 12)) * 0x297A2D39U;
    return h ^ (h >> 15);
}

double lattice_unit(int x, int y, std::uint32_t seed) {
    return lattice_hash(x, y, seed) * 0x1.0p-32;
}

double noise(double x, double y, std::uint32_t seed) {
    const int ix = floor_int(x);
    const int iy = floor_int(y);
    const double dx = x - ix;
    const double dy = y - iy;
    const double u = fade(dx);
    const std::uint32_t corner = seed * 0xC2B2AE3DU +
                                 static_cast<std::uint32_t>(ix) * kAcross +
                                 static_cast<std::uint32_t>(iy) * kDown;
    const double top = mix(slope(corner, dx, dy), slope(corner + kAcross, dx - 1, dy), u);
    const double bottom = mix(slope(corner + kDown, dx, dy - 1),
                              slope(corner + kAcross + kDown, dx - 1, dy - 1),
                              u);
    // The extremes of gradient noise lie at +-sqrt(1/2).
    return mix(top, bottom, fade(dy)) * 1.41421356;
}

double fbm(double x, double y, int octaves, std::uint32_t seed) {
    double sum = 0;
    double amplitude = 0.6;
    for (int i = 0; i < octaves; ++i) {
        sum +=
            amplitude * noise(x, y, seed + static_cast<std::uint32_t>(i) * 0x68E31DA4U);
        // Turned by an angle of no symmetry, so that the lattices never line up.
        const double turned = 2 * (0.8 * x - 0.6 * y);
        y = 2 * (0.6 * x + 0.8 * y);
        x = turned;
        amplitude /= 2;
    }
    return sum;
}

double ridged(double x, double y, int octaves, std::uint32_t seed) {
    double sum = 0;
    double amplitude = 0.5;
    double weight = 1;
    for (int i = 0; i < octaves; ++i) {
        const double n = noise(x, y, seed + static_cast<std::uint32_t>(i) * 0x68E31DA4U);
        double crest = 1 - std::fabs(n);
        crest *= crest;
        sum += amplitude * crest * weight;
        weight = clamp01(crest * 1.6);
        const double turned = 2 * (0.8 * x - 0.6 * y);
        y = 2 * (0.6 * x + 0.8 * y);
        x = turned;
        amplitude /= 2;
    }
    return clamp01(sum);
}

Cell cell(double x, double y, std::uint32_t seed) {
    const int ix = floor_int(x);
    const int iy = floor_int(y);
    Cell found{9, 9, 0};
    for (int j = iy - 1; j <= iy + 1; ++j) {
        for (int i = ix - 1; i <= ix + 1; ++i) {
            const std::uint32_t id = lattice_hash(i, j, seed);
            const double dx = i + (id & 0xFFFF) * 0x1.0p-16 - x;
            const double dy = j + (id >> 16) * 0x1.0p-16 - y;
            const double distance = dx * dx + dy * dy;
            if (distance < found.nearest) {
                found = {distance, found.nearest, id};
            } else if (distance < found.second) {
                found.second = distance;
            }
        }
    }
    return {std::sqrt(found.nearest), std::sqrt(found.second), found.id};
}

}  // namespace haarmony::gallery
