#include "engine/curve/carried_fit.h"

#include <array>
#include <cassert>

namespace haarmony::curve {
namespace {

constexpr std::size_t kPlane = 2;
constexpr std::array kWithin = {0.125, 0.375, 0.625, 0.875};

std::array<double, 4> bernstein(double t) {
    const double s = 1 - t;
    return {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
}

double value(const Points& rows, std::size_t first, std::size_t dimension, double t) {
    const std::array<double, 4> b = bernstein(t);
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += b[i] * rows[first + i][dimension];
    return sum;
}

}  // namespace

void fit_carried(const Points& chain,
                 std::size_t first,
                 std::size_t last,
                 const Cuts& cuts,
                 Points& bezier,
                 std::size_t row) {
    assert(cuts.size() == last - first + 1 && chain.dimension() == bezier.dimension());
    for (std::size_t d = kPlane; d < std::size_t(chain.dimension()); ++d) {
        const double start = chain[3 * first][d];
        const double end = chain[3 * last][d];
        double aa = 0, ab = 0, bb = 0, a = 0, b = 0;
        for (std::size_t k = first; k < last; ++k) {
            for (const double within : kWithin) {
                const double from = cuts[k - first];
                const auto w = bernstein(from + within * (cuts[k - first + 1] - from));
                const double rest =
                    value(chain, 3 * k, d, within) - (w[0] * start + w[3] * end);
                aa += w[1] * w[1];
                ab += w[1] * w[2];
                bb += w[2] * w[2];
                a += w[1] * rest;
                b += w[2] * rest;
            }
        }
        // Singular only where all cuts fall together: a line between the ends serves.
        const double determinant = aa * bb - ab * ab;
        const bool solved = determinant > 1e-12 * aa * bb;
        bezier[row][d] = start;
        bezier[row + 1][d] =
            solved ? (a * bb - b * ab) / determinant : start + (end - start) / 3;
        bezier[row + 2][d] =
            solved ? (aa * b - ab * a) / determinant : end - (end - start) / 3;
        bezier[row + 3][d] = end;
    }
}

}  // namespace haarmony::curve
