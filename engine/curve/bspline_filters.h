// The filters of every level as short runs of numbers: columns and rows of P^j and Q^j, rows
// of the Gram matrices I^j and J^j, and of the rows that annihilate P^j.
//   level.h -> [bspline_filters.h] -> banded.h, multires_curve.h, sweep_edit.h
//
// Shape   P^j and Q^j have control_count(j) rows; P^j as many columns as level j - 1 has
//         points, Q^j has 2^(j-1): the wavelets of level j - 1. J^j is (Q^j)^T I^j Q^j: the
//         dissertation's J^(j-1).
// Scale   wavelets have unit L2 norm on [0, 1] and are positive at their peak; I^j and J^j
//         are inner products on [0, 1].
// Errors  none; an index or a level out of range is a caller's bug and asserts.
// Threads const-thread-safe.
// Source  sec. 3.2.2, Figures 3.2 and 3.3; minimal support makes Q^j unique up to scale.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "engine/curve/level.h"

namespace haarmony::curve {

// The numbers of a row or column that are not 0. Of a closed curve `first` is in range, the
// places first, first + 1, ... are taken modulo the count, and what meets is to be added.
template <int kMost>
struct Run {
    std::size_t first = 0;
    int count = 0;
    std::array<double, kMost> value{};

    [[nodiscard]] std::span<const double> values() const& {
        return std::span(value).first(std::size_t(count));
    }
    // They would be gone with the run.
    void values() const&& = delete;
};
using Filter = Run<11>;   // a column of P or Q
using Taps = Run<6>;      // a row of P or Q
using GramRow = Run<13>;  // a row of I or J

// Requires: level >= 1, an index in range.
[[nodiscard]] Filter refinement_column(int level, Ends ends, std::size_t column);  // P^j
[[nodiscard]] Taps refinement_row(int level, Ends ends, std::size_t row);
[[nodiscard]] Filter wavelet_column(int level, Ends ends, std::size_t column);  // Q^j
[[nodiscard]] Taps wavelet_row(int level, Ends ends, std::size_t row);

// <Phi^j | Phi^j>. Requires: level >= 0.
[[nodiscard]] GramRow gram_row(int level, Ends ends, std::size_t row);
// <Psi^(j-1) | Psi^(j-1)>. Requires: level >= 1.
[[nodiscard]] GramRow wavelet_gram_row(int level, Ends ends, std::size_t row);

// A row of T^j, where T^j P^j = 0: the jump of the third derivative at the knot that level j
// has and level j - 1 has not, up to a factor. It looks at five control points; its first is
// 2 * row (closed: 2 * row - 1). Requires: level >= 1.
[[nodiscard]] Run<5> jump_row(int level, Ends ends, std::size_t row);

// An interior column of Q^j up to a factor, and that factor: columns 3 and up of an open curve,
// as far from its other end, begin at row 2 * column - 3; all of a closed one at 2 * column - 4.
inline constexpr std::array<double, 11> kInteriorWavelet =
    {-1, 124, -1677, 7904, -18482, 24264, -18482, 7904, -1677, 124, -1};
// Below level 4 an open curve has no such column.
[[nodiscard]] double interior_wavelet_scale(int level, Ends ends);

}  // namespace haarmony::curve
