// Points of a curve or of its details, row after row: the currency of engine/curve.
//   [points.h] -> bspline.h, multires_curve.h, bezier.h
//
// Shape   a row has `dimension` numbers: x, y, then whatever is carried along (thickness,
//         colour: sec. 3.6). Control points, details and samples are all such rows.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe.
// Source  sec. 3.2.1: C^j and D^j as columns of points.
#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace haarmony::curve {

inline constexpr int kMostDimensions = 8;

class Points {
  public:
    Points() = default;
    // All numbers are 0. Requires: 1 <= dimension <= kMostDimensions.
    Points(std::size_t count, int dimension)
        : dimension_(dimension), numbers_(count * std::size_t(dimension)) {
        assert(dimension >= 1 && dimension <= kMostDimensions);
    }

    [[nodiscard]] int dimension() const { return dimension_; }
    [[nodiscard]] bool empty() const { return numbers_.empty(); }
    [[nodiscard]] std::size_t size() const {
        return dimension_ == 0 ? 0 : numbers_.size() / std::size_t(dimension_);
    }

    // A row.
    [[nodiscard]] std::span<double> operator[](std::size_t row) {
        return std::span(numbers_).subspan(row * std::size_t(dimension_),
                                           std::size_t(dimension_));
    }
    [[nodiscard]] std::span<const double> operator[](std::size_t row) const {
        return std::span(numbers_).subspan(row * std::size_t(dimension_),
                                           std::size_t(dimension_));
    }

    // Row after row.
    [[nodiscard]] std::span<double> numbers() { return numbers_; }
    [[nodiscard]] std::span<const double> numbers() const { return numbers_; }

    friend bool operator==(const Points&, const Points&) = default;

  private:
    int dimension_ = 0;
    std::vector<double> numbers_;
};

}  // namespace haarmony::curve
