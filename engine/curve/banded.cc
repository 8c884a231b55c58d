#include "engine/curve/banded.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/curve/with_dimension.h"

namespace haarmony::curve {

template <int kHalf>
Banded<kHalf>::Banded(std::size_t rows, const std::function<Row(std::size_t)>& row_of)
    : factors_(rows) {
    constexpr auto kWide = std::size_t(kHalf);
    // The rows of U, diagonal first, not yet divided by it.
    std::vector<std::array<double, kWide + 1>> upper(rows);
    for (std::size_t i = 0; i < rows; ++i) {
        Row row = row_of(i);
        Factor& factor = factors_[i];
        for (std::size_t back = std::min(kWide, i); back >= 1; --back) {
            const double multiple = row[kWide - back] / upper[i - back][0];
            for (std::size_t k = 0; k <= kWide; ++k)
                row[kWide - back + k] -= multiple * upper[i - back][k];
            factor.below[back - 1] = multiple;
        }
        for (std::size_t k = 0; k <= kWide; ++k)
            upper[i][k] = i + k < rows ? row[kWide + k] : 0;
        assert(upper[i][0] != 0);
        factor.inverse = 1 / upper[i][0];
        for (std::size_t k = 1; k <= kWide; ++k)
            factor.above[k - 1] = upper[i][k] * factor.inverse;
    }
    if (rows < kSettled) return;
    // How long an impulse rings. 1e-18 of it is beyond what a double adds to 1.
    const Factor& middle = factors_[rows / 2];
    std::array<double, kWide> last{};
    last[0] = 1;
    const auto rings = [](double x) { return std::abs(x) > 1e-18; };
    while (std::any_of(last.begin(), last.end(), rings)) {
        double next = 0;
        for (std::size_t k = 0; k < kWide; ++k) next -= middle.below[k] * last[k];
        std::rotate(last.rbegin(), last.rbegin() + 1, last.rend());
        last[0] = next;
        ++memory_;
    }
}

template <int kHalf>
typename Banded<kHalf>::Middle Banded<kHalf>::middle_of(std::size_t count) const {
    const std::size_t front = rows() / 2;
    return {front, count - (rows() - front)};
}

template <int kHalf>
void Banded<kHalf>::solve(std::span<double> b, int dimension) const {
    const std::size_t count = b.size() / std::size_t(dimension);
    assert(count == rows() || (count > rows() && rows() >= kSettled));
    with_dimension(dimension, [&](auto constant) {
        solve_rows<decltype(constant)::value>(b.data(), count);
    });
}

template <int kHalf>
void Banded<kHalf>::solve_around(std::span<double> b, int dimension) const {
    const std::size_t count = b.size() / std::size_t(dimension);
    assert(rows() >= kSettled && count > 0);
    with_dimension(dimension, [&](auto constant) {
        solve_circle<decltype(constant)::value>(b.data(), count);
    });
}

template class Banded<1>;
template class Banded<3>;

}  // namespace haarmony::curve
