#include "engine/curve/bspline_filters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>

namespace haarmony::curve {
namespace {

// A column of Q^j as integers, and the square of its norm times 2^j as a fraction.
struct IntegerColumn {
    std::size_t first;
    int count;
    std::array<std::int64_t, 11> value;
    double norm2_over;  // exact or rounded once: up to 2^82
    double norm2_under;
};

// The special columns from the left; those from the right are their mirror images.
constexpr std::array<IntegerColumn, 1> kWaveletsOfLevel1 = {{
    {0, 5, {1, -2, 3, -2, 1}, 2, 7},
}};
constexpr std::array<IntegerColumn, 1> kWaveletsOfLevel2 = {{
    {0, 6, {1368, -2064, 1793, -1053, 691, -240}, 4 * 31196288.0, 315},
}};
constexpr std::array<IntegerColumn, 2> kWaveletsOfLevel3 = {{
    {0,
     8,
     {1136914560,
      -1655323200,
      1321223960,
      -633094403,
      229000092,
      -46819570,
      3456748,
      -27877},
     27256875217617114112.0,
     105},
    {1,
     8,
     {-243649440,
      666995430,
      -881412943,
      956224942,
      -689203555,
      300343998,
      -74736797,
      13816670},
     8 * 871578288972245888.0,
     35},
}};
constexpr std::array<IntegerColumn, 3> kWavelets = {{
    {0,
     8,
     {1136914560,
      -1655323200,
      1321223960,
      -633094403,
      229000092,
      -46819570,
      3456748,
      -27877},
     27256875217617114112.0,
     105},
    {1,
     9,
     {-113407810560,
      310334449720,
      -409599117799,
      442436404716,
      -314778993806,
      131665074668,
      -27809640281,
      2055920496,
      -16580004},
     4495390681774587444930112.0,
     105},
    {2,
     10,
     {1228360,
      -6643465,
      26584020,
      -59678354,
      77343956,
      -58651607,
      25047312,
      -5312796,
      392832,
      -3168},
     20535305233863616.0,
     15},
}};
constexpr double kInteriorNorm2 = 675221664.0 / 5;

std::span<const IntegerColumn> special_wavelets(int level) {
    switch (level) {
        case 1:
            return kWaveletsOfLevel1;
        case 2:
            return kWaveletsOfLevel2;
        case 3:
            return kWaveletsOfLevel3;
        default:
            return kWavelets;
    }
}

// sqrt(2^level): rounded once, at odd levels.
double root_of_power(int level) {
    return std::ldexp(level % 2 == 0 ? 1 : std::sqrt(2.0), level / 2);
}

Filter scaled(const IntegerColumn& column, int level) {
    const double scale =
        root_of_power(level) / std::sqrt(column.norm2_over / column.norm2_under);
    Filter filter{column.first, column.count, {}};
    for (int i = 0; i < column.count; ++i)
        filter.value[i] = double(column.value[i]) * scale;
    return filter;
}

// P^j times 16, and I^j times 10080 * 2^j, from the left. A row or column of a level with
// fewer of them than special ones on both sides is listed for that level.
struct Stamp {
    std::size_t first;
    int count;
    std::array<double, 7> value;
};
constexpr std::array<Stamp, 4> kRefinement = {{
    {0, 2, {16, 8}},
    {1, 3, {8, 12, 3}},
    {2, 4, {4, 11, 8, 2}},
    {3, 5, {2, 8, 12, 8, 2}},
}};
constexpr std::array<Stamp, 2> kRefinementOfLevel1 = {{{0, 2, {16, 8}}, {1, 2, {8, 8}}}};
constexpr std::array<Stamp, 3> kRefinementOfLevel2 = {{
    {0, 2, {16, 8}},
    {1, 3, {8, 12, 3}},
    {2, 3, {4, 10, 4}},
}};
constexpr std::array<Stamp, 2> kGramOfLevel0 = {{
    {0, 4, {1440, 720, 288, 72}},
    {0, 4, {720, 864, 648, 288}},
}};
constexpr std::array<Stamp, 3> kGramOfLevel1 = {{
    {0, 4, {1440, 882, 180, 18}},
    {0, 5, {882, 2232, 1404, 504, 18}},
    {0, 5, {180, 1404, 1872, 1404, 180}},
}};
constexpr std::array<Stamp, 4> kGramOfLevel2 = {{
    {0, 4, {1440, 882, 186, 12}},
    {0, 5, {882, 2232, 1575, 348, 3}},
    {0, 6, {186, 1575, 3294, 2264, 238, 3}},
    {0, 7, {12, 348, 2264, 4832, 2264, 348, 12}},
}};
constexpr std::array<Stamp, 6> kGram = {{
    {0, 4, {1440, 882, 186, 12}},
    {0, 5, {882, 2232, 1575, 348, 3}},
    {0, 6, {186, 1575, 3294, 2264, 239, 2}},
    {0, 7, {12, 348, 2264, 4832, 2382, 240, 2}},
    {1, 7, {3, 239, 2382, 4832, 2382, 240, 2}},
    {2, 7, {2, 240, 2382, 4832, 2382, 240, 2}},
}};

std::span<const Stamp> refinement_stamps(int level) {
    switch (level) {
        case 1:
            return kRefinementOfLevel1;
        case 2:
            return kRefinementOfLevel2;
        default:
            return kRefinement;
    }
}
std::span<const Stamp> gram_stamps(int level) {
    switch (level) {
        case 0:
            return kGramOfLevel0;
        case 1:
            return kGramOfLevel1;
        case 2:
            return kGramOfLevel2;
        default:
            return kGram;
    }
}

// The run at the same distance from the other end, of `count` places.
template <int kMost>
Run<kMost> mirrored(Run<kMost> run, std::size_t count) {
    run.first = count - run.first - std::size_t(run.count);
    std::reverse(run.value.begin(), run.value.begin() + run.count);
    return run;
}

// A stamp of `index` of `count`, in a line of `length` places: special ones by the nearer
// end, the last one of the list `step` places further for each index beyond it.
template <int kMost>
Run<kMost> stamped(std::span<const Stamp> stamps,
                   std::size_t index,
                   std::size_t count,
                   std::size_t length,
                   std::size_t step,
                   double scale) {
    const bool back = index > (count - 1) / 2;
    const std::size_t from_end = back ? count - 1 - index : index;
    const Stamp& stamp = stamps[std::min(from_end, stamps.size() - 1)];
    Run<kMost> run{stamp.first, stamp.count, {}};
    if (from_end >= stamps.size()) run.first += step * (from_end - (stamps.size() - 1));
    for (int i = 0; i < stamp.count; ++i) run.value[i] = stamp.value[i] * scale;
    return back ? mirrored(run, length) : run;
}

// Of a closed curve: `values` with the middle one at `center`.
template <int kMost>
Run<kMost> around(std::span<const double> values,
                  std::size_t center,
                  std::size_t count,
                  double scale) {
    const std::size_t before = values.size() / 2 % count;
    Run<kMost> run{(center + count - before) % count, int(values.size()), {}};
    for (std::size_t i = 0; i < values.size(); ++i) run.value[i] = values[i] * scale;
    return run;
}

constexpr std::array<double, 5> kRefinementAround = {2, 8, 12, 8, 2};
constexpr std::array<double, 7> kGramAround = {2, 240, 2382, 4832, 2382, 240, 2};
constexpr std::array<double, 5> kJump = {1, -4, 6, -4, 1};

// The square of the norm of a wavelet of a closed curve, in the integers of kInteriorWavelet,
// times 2^level: below level 4 it meets itself on its way around.
double closed_norm2(int level) {
    switch (level) {
        case 1:
            return 175472640.0;
        case 2:
            return 32788594688.0 / 315;
        case 3:
            return 14182854656.0 / 105;
        default:
            return kInteriorNorm2;
    }
}
double gram_scale(int level) { return std::ldexp(1.0 / 10080, -level); }

// The number at `place` of an open curve's run, 0 outside.
template <int kMost>
double value_at(const Run<kMost>& run, std::size_t place) {
    const std::size_t at = place - run.first;  // wraps around to a large one
    return at < std::size_t(run.count) ? run.value[at] : 0;
}

// Row `row` of the columns [first, last] of a matrix of an open curve.
template <typename ColumnOf>
Taps row_of(std::size_t row, std::size_t first, std::size_t last, ColumnOf column_of) {
    Taps taps;
    for (std::size_t column = first; column <= last; ++column) {
        const double value = value_at(column_of(column), row);
        if (value == 0) continue;
        if (taps.count == 0) taps.first = column;
        assert(taps.first + std::size_t(taps.count) == column);
        taps.value[std::size_t(taps.count++)] = value;
    }
    return taps;
}

std::size_t minus(std::size_t a, std::size_t b) { return a < b ? 0 : a - b; }

}  // namespace

double interior_wavelet_scale(int level, Ends ends) {
    const double norm2 = ends == Ends::kClosed ? closed_norm2(level) : kInteriorNorm2;
    return root_of_power(level) / std::sqrt(norm2);
}

Filter refinement_column(int level, Ends ends, std::size_t column) {
    const std::size_t columns = control_count(level - 1, ends);
    const std::size_t rows = control_count(level, ends);
    assert(level >= 1 && column < columns);
    if (ends == Ends::kClosed) {
        return around<11>(kRefinementAround, 2 * column, rows, 1.0 / 16);
    }
    return stamped<11>(refinement_stamps(level), column, columns, rows, 2, 1.0 / 16);
}

Taps refinement_row(int level, Ends ends, std::size_t row) {
    const std::size_t columns = control_count(level - 1, ends);
    assert(level >= 1 && row < control_count(level, ends));
    if (ends == Ends::kClosed) {
        if (row % 2 == 1) return {row / 2, 2, {0.5, 0.5}};
        return {(row / 2 + columns - 1) % columns, 3, {0.125, 0.75, 0.125}};
    }
    const std::size_t near = row / 2;
    return row_of(row, minus(near, 1), std::min(near + 2, columns - 1), [&](auto column) {
        return refinement_column(level, ends, column);
    });
}

Filter wavelet_column(int level, Ends ends, std::size_t column) {
    const std::size_t columns = segment_count(level - 1);
    const std::size_t rows = control_count(level, ends);
    assert(level >= 1 && column < columns);
    if (ends == Ends::kClosed) {
        const double scale = interior_wavelet_scale(level, ends);
        return around<11>(kInteriorWavelet, 2 * column + 1, rows, scale);
    }
    const auto special = special_wavelets(level);
    const bool back = column >= (columns + 1) / 2;
    const std::size_t from_end = back ? columns - 1 - column : column;
    if (from_end < special.size()) {
        const Filter filter = scaled(special[from_end], level);
        return back ? mirrored(filter, rows) : filter;
    }
    const double scale = interior_wavelet_scale(level, ends);
    Filter filter{2 * column - 3, 11, {}};
    for (std::size_t i = 0; i < 11; ++i) filter.value[i] = kInteriorWavelet[i] * scale;
    return filter;
}

Taps wavelet_row(int level, Ends ends, std::size_t row) {
    const std::size_t columns = segment_count(level - 1);
    assert(level >= 1 && row < control_count(level, ends));
    const std::size_t near = row / 2;
    if (ends == Ends::kOpen)
        return row_of(
            row, minus(near, 4), std::min(near + 2, columns - 1), [&](auto column) {
                return wavelet_column(level, ends, column);
            });
    // Its taps are every second number of the wavelet, from the last to the first: six at
    // even rows, five at odd ones.
    const std::size_t parity = row % 2;
    const double scale = interior_wavelet_scale(level, ends);
    const std::size_t before = (parity == 0 ? 3 : 2) % columns;
    Taps taps{(near + columns - before) % columns, parity == 0 ? 6 : 5, {}};
    for (std::size_t i = 0; i < std::size_t(taps.count); ++i)
        taps.value[i] = kInteriorWavelet[2 * i + parity] * scale;
    return taps;
}

GramRow gram_row(int level, Ends ends, std::size_t row) {
    const std::size_t count = control_count(level, ends);
    assert(level >= 0 && row < count);
    if (ends == Ends::kClosed)
        return around<13>(kGramAround, row, count, gram_scale(level));
    return stamped<13>(gram_stamps(level), row, count, count, 1, gram_scale(level));
}

GramRow wavelet_gram_row(int level, Ends ends, std::size_t row) {
    const std::size_t columns = segment_count(level - 1);
    const std::size_t places = control_count(level, ends);
    assert(level >= 1 && row < columns);
    const auto product = [&](std::size_t other) {
        const Filter a = wavelet_column(level, ends, row);
        const Filter b = wavelet_column(level, ends, other);
        double sum = 0;
        for (std::size_t i = 0; i < std::size_t(a.count); ++i) {
            const GramRow gram = gram_row(level, ends, (a.first + i) % places);
            for (std::size_t k = 0; k < std::size_t(gram.count); ++k)
                for (std::size_t l = 0; l < std::size_t(b.count); ++l)
                    if ((gram.first + k) % places == (b.first + l) % places)
                        sum += a.value[i] * gram.value[k] * b.value[l];
        }
        return sum;
    };
    GramRow run;
    if (ends == Ends::kClosed && columns >= 13) {
        run.first = (row + columns - 6) % columns;
        run.count = 13;
    } else {
        const std::size_t last = std::min(row + 6, columns - 1);
        run.first = ends == Ends::kClosed ? 0 : minus(row, 6);
        run.count = int((ends == Ends::kClosed ? columns : last + 1) - run.first);
    }
    for (std::size_t i = 0; i < std::size_t(run.count); ++i)
        run.value[i] = product((run.first + i) % columns);
    return run;
}

Run<5> jump_row(int level, Ends ends, std::size_t row) {
    const std::size_t rows = segment_count(level - 1);
    assert(level >= 1 && row < rows);
    if (ends == Ends::kClosed)
        return around<5>(kJump, 2 * row + 1, control_count(level, ends), 1);
    if (level == 1) return {0, 5, {1, -2, 2, -2, 1}};
    if (row == 0) return {0, 5, {6, -12, 9, -4, 1}};
    if (row == rows - 1) return {2 * row, 5, {1, -4, 9, -12, 6}};
    return {2 * row, 5, kJump};
}

}  // namespace haarmony::curve
