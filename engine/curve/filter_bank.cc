#include "engine/curve/filter_bank.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace haarmony::curve::filter_bank {
namespace {

// From here on filters differ from level to level by a factor alone.
constexpr int kStampLevel = 5;
// From here on the middle of the factored matrices has settled.
constexpr int kSettledLevel = 8;
static_assert((std::size_t{1} << (kSettledLevel - 1)) >= Banded<3>::kSettled);

// All rows of a level below kStampLevel; of that level as many as Interior leaves out at
// either end, those at the back from the last one on.
struct SpecialRows {
    std::vector<SpecialRow> front;
    std::vector<SpecialRow> back;
};

SpecialRows make_special_rows(int level) {
    constexpr Ends kOpen = Ends::kOpen;
    const auto row_of = [&](std::size_t row) {
        return SpecialRow{refinement_row(level, kOpen, row),
                          wavelet_row(level, kOpen, row)};
    };
    const std::size_t rows = control_count(level, kOpen);
    const Interior interior = interior_of(level, kOpen);
    SpecialRows special;
    if (level < kStampLevel) {
        for (std::size_t row = 0; row < rows; ++row) special.front.push_back(row_of(row));
    } else {
        for (std::size_t row = 0; row + 1 < 2 * interior.first; ++row)
            special.front.push_back(row_of(row));
        for (std::size_t row = rows; row-- + 1 > 2 * interior.last;)
            special.back.push_back(row_of(row));
    }
    return special;
}

const SpecialRows& special_rows(int level) {
    static const std::array<SpecialRows, kStampLevel> tables = {make_special_rows(1),
                                                                make_special_rows(2),
                                                                make_special_rows(3),
                                                                make_special_rows(4),
                                                                make_special_rows(5)};
    return tables[std::size_t(std::min(level, kStampLevel) - 1)];
}

// T^j Q^j.
Banded<3> make_jumps_of_wavelets(int level) {
    return {segment_count(level - 1), [level](std::size_t row) {
                const Run<5> jump = jump_row(level, Ends::kOpen, row);
                Banded<3>::Row products{};
                for (std::size_t k = 0; k < products.size(); ++k) {
                    const std::size_t column = row + k - 3;  // wraps to a large one
                    if (column >= segment_count(level - 1)) continue;
                    const Filter wavelet = wavelet_column(level, Ends::kOpen, column);
                    for (std::size_t i = 0; i < 5; ++i) {
                        const std::size_t at = jump.first + i - wavelet.first;
                        if (at < std::size_t(wavelet.count))
                            products[k] += jump.value[i] * wavelet.value[at];
                    }
                }
                return products;
            }};
}

Banded<1> make_pivot_rows(int level) {
    return {control_count(level - 1, Ends::kOpen), [level](std::size_t point) {
                const Taps taps = refinement_row(
                    level, Ends::kOpen, pivot_row(level, Ends::kOpen, point));
                Banded<1>::Row row{};
                for (std::size_t i = 0; i < std::size_t(taps.count); ++i)
                    row[taps.first + i + 1 - point] = taps.value[i];
                return row;
            }};
}

}  // namespace

Interior interior_of(int level, Ends ends) {
    const std::size_t details = segment_count(level - 1);
    if (ends == Ends::kOpen) {
        if (level < kStampLevel) return {};
        return {7, details - 5};
    }
    if (details < 6) return {};
    return {3, details - 2};
}

SharedRow special_row(int level, std::size_t row) {
    const SpecialRows& rows = special_rows(level);
    if (row < rows.front.size()) return {&rows.front[row], 0};
    const std::size_t from_back = control_count(level, Ends::kOpen) - 1 - row;
    return {&rows.back[from_back],
            segment_count(level - 1) - segment_count(kStampLevel - 1)};
}

double special_scale(int level) {
    return level <= kStampLevel ? 1 : std::sqrt(std::ldexp(1.0, level - kStampLevel));
}

const Factors& factors_of(int level, Ends ends) {
    static const std::vector<Factors> factors = [] {
        std::vector<Factors> made;
        for (int j = 1; j <= kSettledLevel; ++j)
            made.push_back({make_jumps_of_wavelets(j), make_pivot_rows(j)});
        return made;
    }();
    const int like = ends == Ends::kOpen ? std::min(level, kSettledLevel) : kSettledLevel;
    return factors[std::size_t(like - 1)];
}

double jump_scale(int level, Ends ends) {
    // Below kSettledLevel an open curve has factors of its own.
    if (ends == Ends::kOpen && level <= kSettledLevel) return 1;
    return interior_wavelet_scale(kSettledLevel, Ends::kOpen) /
           interior_wavelet_scale(level, ends);
}

}  // namespace haarmony::curve::filter_bank
