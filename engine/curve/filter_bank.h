// One level of analysis and synthesis, for numbers of any kind: doubles, and in the tests
// numbers that count what is done with them.
//   bspline_filters.h, banded.h -> [filter_bank.h] -> multires_curve.h
//
// Shape    rows of kDimension numbers one after the other; counts follow from the level.
// Errors   none; a wrong shape is a caller's bug.
// Threads  const-thread-safe.
// Cost     17 operations a number of C^j to analyse, 14.5 to synthesise.
// Source   sec. 3.2.1, equations (3.2) to (3.4); sec. 3.2.2.
#pragma once

#include <algorithm>
#include <cstddef>

#include "engine/curve/banded.h"
#include "engine/curve/bspline_filters.h"
#include "engine/curve/level.h"

namespace haarmony::curve::filter_bank {

// Analysis without A^j and B^j, which are full: the rows of T^j annihilate P^j, so that
//   T^j Q^j D^(j-1) = T^j C^j            half-bandwidth 3, dominated by its diagonal
// gives the details; then P^j C^(j-1) = C^j - Q^j D^(j-1) holds in every row, and the first,
// the last and every odd row of P^j make a tridiagonal matrix. Compared with the Gram
// matrices, I^(j-1) C = (P^j)^T I^j C^j and J^j D = (Q^j)^T I^j C^j, the right sides have 5
// and 7 terms a row instead of 11 and 17, and the matrices are better conditioned (2 and 19
// instead of 27 for I^j).

// The coarse points whose two rows, 2 i - 1 and 2 i of an open curve, 2 i and 2 i + 1 of a
// closed one, have neighbours on all sides that are like all others: [first, last).
struct Interior {
    std::size_t first = 0;
    std::size_t last = 0;
};
[[nodiscard]] Interior interior_of(int level, Ends ends);

// Rows of P^j and Q^j that Interior leaves out. All levels share the tables of a short one:
// columns count from `shift` on, wavelets are to be multiplied by special_scale().
struct SpecialRow {
    Taps refinement;
    Taps wavelet;
};
struct SharedRow {
    const SpecialRow* row = nullptr;
    std::size_t shift = 0;
};
// Of an open curve. Requires: a row that Interior leaves out.
[[nodiscard]] SharedRow special_row(int level, std::size_t row);
[[nodiscard]] double special_scale(int level);

// The row of P^j that stands for coarse point `point`: the first, odd ones, the last.
[[nodiscard]] inline std::size_t pivot_row(int level, Ends ends, std::size_t point) {
    if (ends == Ends::kClosed) return 2 * point;
    if (point == 0) return 0;
    return std::min(2 * point - 1, control_count(level, ends) - 1);
}

struct Factors {
    Banded<3> jumps_of_wavelets;
    Banded<1> pivot_rows;
};
[[nodiscard]] const Factors& factors_of(int level, Ends ends);
// What T^j C^j lacks beside the factored matrix, which a longer curve borrows.
[[nodiscard]] double jump_scale(int level, Ends ends);

// Adds `factor` times the sum of a run's numbers times the rows it stands for.
template <int kDimension, int kMost, typename Number>
void add(const Run<kMost>& run,
         const Number* rows,
         std::size_t count,
         double factor,
         Number* sum) {
    std::size_t row = run.first;
    for (std::size_t i = 0; i < std::size_t(run.count); ++i) {
        const double value = factor * run.value[i];
        for (int d = 0; d < kDimension; ++d) sum[d] += value * rows[row * kDimension + d];
        if (++row == count) row = 0;
    }
}

// The six and the five numbers of a wavelet that meet in a row.
template <int kDimension, typename Number>
Number six_taps(const Number* details, int d) {
    const auto at = [&](int i) { return details[i * kDimension + d]; };
    static_assert(kInteriorWavelet[0] == -1);
    return kInteriorWavelet[2] * (at(1) + at(4)) + kInteriorWavelet[4] * (at(2) + at(3)) -
           (at(0) + at(5));
}
template <int kDimension, typename Number>
Number five_taps(const Number* details, int d) {
    const auto at = [&](int i) { return details[i * kDimension + d]; };
    return kInteriorWavelet[1] * (at(0) + at(4)) + kInteriorWavelet[3] * (at(1) + at(3)) +
           kInteriorWavelet[5] * at(2);
}

// The first detail of the six that a coarse point's own row looks at.
[[nodiscard]] inline std::size_t first_of_six(std::size_t point, Ends ends) {
    return point - (ends == Ends::kOpen ? 4 : 3);
}

// T^j C^j.
template <int kDimension, typename Number>
void write_jumps(const Number* control, int level, Ends ends, Number* jumps) {
    const std::size_t details = segment_count(level - 1);
    const std::size_t count = control_count(level, ends);
    const double scale = jump_scale(level, ends);
    const auto at_end = [&](std::size_t k) {
        Number* const jump = jumps + k * kDimension;
        std::fill_n(jump, kDimension, Number());
        add<kDimension>(jump_row(level, ends, k), control, count, scale, jump);
    };
    at_end(0);
    const std::size_t before = ends == Ends::kOpen ? 0 : 1;
    for (std::size_t k = 1; k + 1 < details; ++k) {
        const Number* const row = control + (2 * k - before) * kDimension;
        const auto at = [&](int i, int d) { return row[i * kDimension + d]; };
        for (int d = 0; d < kDimension; ++d)
            jumps[k * kDimension + d] = scale * (at(0, d) + at(4, d) + 6.0 * at(2, d) -
                                                 4.0 * (at(1, d) + at(3, d)));
    }
    if (details > 1) at_end(details - 1);
}

// C^j - Q^j D^(j-1) in the pivot rows. `coarse` may be `control`: a row is read before any
// row that reaches it is written.
template <int kDimension, typename Number>
void write_pivots(const Number* control,
                  const Number* details,
                  int level,
                  Ends ends,
                  Number* coarse) {
    const std::size_t count = segment_count(level - 1);
    const std::size_t points = control_count(level - 1, ends);
    const double scale = interior_wavelet_scale(level, ends);
    const double scale_of_special = special_scale(level);
    const auto special = [&](std::size_t i) {
        const std::size_t row = pivot_row(level, ends, i);
        Number* const rest = coarse + i * kDimension;
        std::copy_n(control + row * kDimension, kDimension, rest);
        if (ends == Ends::kClosed) {
            add<kDimension>(wavelet_row(level, ends, row), details, count, -1, rest);
            return;
        }
        const auto [shared, shift] = special_row(level, row);
        add<kDimension>(shared->wavelet,
                        details + shift * kDimension,
                        count,
                        -scale_of_special,
                        rest);
    };
    const Interior interior = interior_of(level, ends);
    for (std::size_t i = 0; i < interior.first; ++i) special(i);
    for (std::size_t i = interior.first; i < interior.last; ++i) {
        const Number* const taps = details + first_of_six(i, ends) * kDimension;
        const Number* const row = control + pivot_row(level, ends, i) * kDimension;
        for (int d = 0; d < kDimension; ++d)
            coarse[i * kDimension + d] = row[d] - scale * six_taps<kDimension>(taps, d);
    }
    for (std::size_t i = interior.last; i < points; ++i) special(i);
}

// C^(j-1) and D^(j-1) of C^j. `coarse` may be `control`.
template <int kDimension, typename Number>
void analyze_level(const Number* control,
                   int level,
                   Ends ends,
                   Number* coarse,
                   Number* details) {
    const Factors& factors = factors_of(level, ends);
    const std::size_t count = segment_count(level - 1);
    const std::size_t points = control_count(level - 1, ends);
    write_jumps<kDimension>(control, level, ends, details);
    if (ends == Ends::kOpen) {
        factors.jumps_of_wavelets.template solve_rows<kDimension>(details, count);
    } else {
        factors.jumps_of_wavelets.template solve_circle<kDimension>(details, count);
    }
    write_pivots<kDimension>(control, details, level, ends, coarse);
    if (ends == Ends::kOpen) {
        factors.pivot_rows.template solve_rows<kDimension>(coarse, points);
    } else {
        factors.pivot_rows.template solve_circle<kDimension>(coarse, points);
    }
}

// C^j of C^(j-1) and, if kDetailed, D^(j-1).
template <int kDimension, bool kDetailed, typename Number>
void synthesize_level(const Number* coarse,
                      const Number* details,
                      int level,
                      Ends ends,
                      Number* control) {
    const std::size_t points = control_count(level - 1, ends);
    const std::size_t count = segment_count(level - 1);
    const double scale = interior_wavelet_scale(level, ends);
    const double scale_of_special = special_scale(level);
    const auto add_rows = [&](const Taps& refinement,
                              const Taps& wavelet,
                              std::size_t shift,
                              double factor,
                              Number* sum) {
        add<kDimension>(refinement, coarse + shift * kDimension, points, 1, sum);
        if constexpr (kDetailed)
            add<kDimension>(wavelet, details + shift * kDimension, count, factor, sum);
    };
    const auto special = [&](std::size_t row) {
        Number* const sum = control + row * kDimension;
        std::fill_n(sum, kDimension, Number());
        if (ends == Ends::kClosed) {
            add_rows(refinement_row(level, ends, row),
                     wavelet_row(level, ends, row),
                     0,
                     1,
                     sum);
            return;
        }
        const auto [shared, shift] = special_row(level, row);
        add_rows(shared->refinement, shared->wavelet, shift, scale_of_special, sum);
    };
    const std::size_t rows = control_count(level, ends);
    const Interior interior = interior_of(level, ends);
    const std::size_t before = ends == Ends::kOpen && interior.first > 0 ? 1 : 0;
    for (std::size_t row = 0; row < 2 * interior.first - before; ++row) special(row);
    for (std::size_t i = interior.first; i < interior.last; ++i) {
        const Number* const c = coarse + i * kDimension;
        Number* const own = control + (2 * i - before) * kDimension;
        for (int d = 0; d < kDimension; ++d) {
            own[d] = 0.125 * (c[d - kDimension] + c[d + kDimension]) + 0.75 * c[d];
            own[d + kDimension] = 0.5 * (c[d] + c[d + kDimension]);
            if constexpr (kDetailed) {
                const Number* const taps = details + first_of_six(i, ends) * kDimension;
                own[d] += scale * six_taps<kDimension>(taps, d);
                own[d + kDimension] +=
                    scale * five_taps<kDimension>(taps + kDimension, d);
            }
        }
    }
    for (std::size_t row = 2 * interior.last - before; row < rows; ++row) special(row);
}

}  // namespace haarmony::curve::filter_bank
