// Banded equations whose rows are all alike but for a few at the ends: A x = b in linear time.
//   bspline_filters.h -> [banded.h] -> multires_curve.h
//
// L D U without pivoting. As the rows of A are alike, those of the factors converge within a
// few dozen, so that only the ends are stored, however long x is.
//
// Shape   x and b are rows of `dimension` numbers; x takes the place of b.
// Errors  none; a shape that does not fit is a caller's bug and asserts.
// Threads const-thread-safe.
// Cost    2 * kHalf + 1 multiplications a number.
// Source  sec. 3.2.2: "banded systems"; the closed case runs the recursion around the curve
//         until its start no longer matters (Unser, Aldroubi and Eden 1993).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace haarmony::curve {

// kHalf: entries on either side of the diagonal.
template <int kHalf>
class Banded {
  public:
    // Row i of A: the entries at columns i - kHalf .. i + kHalf; those outside are not read.
    using Row = std::array<double, std::size_t(2 * kHalf) + 1>;

    // Factors A of `rows` rows. Requires: A can be factored without pivoting.
    Banded(std::size_t rows, const std::function<Row(std::size_t)>& row_of);

    [[nodiscard]] std::size_t rows() const { return factors_.size(); }

    // x of A x = b, where A has rows() rows, or more of them like the middle one.
    // Requires: dimension numbers for each row; kSettled rows at least if there are more.
    void solve(std::span<double> b, int dimension) const;

    // The same of the circulant matrix whose rows are all like the middle one.
    // Requires: rows() >= kSettled, A symmetric in its middle.
    void solve_around(std::span<double> b, int dimension) const;

    // The same for `count` rows of a kind of number that doubles can multiply.
    template <int kDimension, typename Number>
    void solve_rows(Number* x, std::size_t count) const;
    template <int kDimension, typename Number>
    void solve_circle(Number* x, std::size_t count) const;

    // So many rows that the factors in the middle no longer change: those of our matrices
    // settle within 40 rows of either end.
    static constexpr std::size_t kSettled = 128;

  private:
    struct Factor {
        std::array<double, kHalf> below{};  // L: of the rows 1, 2, ... before
        double inverse = 0;                 // 1 / D
        std::array<double, kHalf> above{};  // U: of the rows 1, 2, ... after
    };

    // Of `count` rows, those that repeat the middle one.
    struct Middle {
        std::size_t first = 0;
        std::size_t last = 0;
    };
    [[nodiscard]] Middle middle_of(std::size_t count) const;

    std::vector<Factor> factors_;
    std::size_t memory_ = 0;  // steps until the middle has forgotten where it began
};

// The last kHalf rows that a recursion has passed, the newest first.
template <int kHalf, int kDimension, typename Number>
struct Passed {
    Number row[kHalf][kDimension] = {};

    // From `x` what was passed is taken, times `factor`; then it is passed itself.
    void step(Number* x, const std::array<double, std::size_t(kHalf)>& factor) {
        for (int d = 0; d < kDimension; ++d) {
            Number rest = x[d];
            // The newest last: the others need not wait for it.
            for (int k = kHalf - 1; k >= 0; --k) rest -= factor[k] * row[k][d];
            for (int k = kHalf - 1; k > 0; --k) row[k][d] = row[k - 1][d];
            row[0][d] = rest;
            x[d] = rest;
        }
    }
};

template <int kHalf>
template <int kDimension, typename Number>
void Banded<kHalf>::solve_rows(Number* x, std::size_t count) const {
    // The middle's factor is copied, so that it stays in registers. Before the first row there
    // is none: its factors are 0, and so is what was passed.
    const Middle middle = middle_of(count);
    const Factor repeated = factors_[rows() / 2];
    const auto back = [&](std::size_t i) -> const Factor& {
        return factors_[rows() - (count - i)];
    };
    Passed<kHalf, kDimension, Number> before;
    for (std::size_t i = 0; i < middle.first; ++i)
        before.step(x + i * kDimension, factors_[i].below);
    for (std::size_t i = middle.first; i < middle.last; ++i)
        before.step(x + i * kDimension, repeated.below);
    for (std::size_t i = middle.last; i < count; ++i)
        before.step(x + i * kDimension, back(i).below);

    Passed<kHalf, kDimension, Number> after;
    const auto step_back = [&](std::size_t i, const Factor& factor) {
        Number* const row = x + i * kDimension;
        for (int d = 0; d < kDimension; ++d) row[d] *= factor.inverse;
        after.step(row, factor.above);
    };
    for (std::size_t i = count; i-- > middle.last;) step_back(i, back(i));
    for (std::size_t i = middle.last; i-- > middle.first;) step_back(i, repeated);
    for (std::size_t i = middle.first; i-- > 0;) step_back(i, factors_[i]);
}

template <int kHalf>
template <int kDimension, typename Number>
void Banded<kHalf>::solve_circle(Number* x, std::size_t count) const {
    const Factor middle = factors_[rows() / 2];
    std::array<Number, kDimension> heard{};
    // The recursion starts as many rows early as it remembers, wherever on the circle (or
    // several times around it) that is.
    Passed<kHalf, kDimension, Number> before;
    const std::size_t early = memory_ % count;
    for (std::size_t step = 0, i = (count - early) % count; step < memory_; ++step) {
        std::copy_n(x + i * kDimension, kDimension, heard.begin());
        before.step(heard.data(), middle.below);
        if (++i == count) i = 0;
    }
    for (std::size_t i = 0; i < count; ++i) before.step(x + i * kDimension, middle.below);

    for (std::size_t i = 0; i < count * kDimension; ++i) x[i] *= middle.inverse;
    Passed<kHalf, kDimension, Number> after;
    for (std::size_t step = 0, i = early; step < memory_; ++step) {
        if (i-- == 0) i = count - 1;
        std::copy_n(x + i * kDimension, kDimension, heard.begin());
        after.step(heard.data(), middle.above);
    }
    for (std::size_t i = count; i-- > 0;) after.step(x + i * kDimension, middle.above);
}

extern template class Banded<1>;
extern template class Banded<3>;

}  // namespace haarmony::curve
