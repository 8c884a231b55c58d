#include "engine/curve/least_squares.h"

#include <algorithm>
#include <cassert>

#include "engine/curve/bspline.h"

namespace haarmony::curve {
namespace {

// A point that counts as a million leaves rounding of 1e-10 in the equations, and the pull
// of a straight line over a hundred control points is a hundredth of the stiffness.
constexpr double kLeastOfDiagonal = 1e-10;

// Each round takes the bias of a direction that the points determine with weight w from b
// to b * kStiffness / w.
constexpr int kRounds = 2;

}  // namespace

LeastSquares::LeastSquares(int level, Ends ends, int dimension)
    : level_(level),
      ends_(ends),
      count_(control_count(level, ends)),
      right_(count_, dimension) {
    matrix_.border_rows = ends == Ends::kClosed ? std::min<std::size_t>(3, count_) : 0;
    matrix_.band.resize(count_ - matrix_.border_rows);
    if (matrix_.border_rows > 0) matrix_.border.resize(matrix_.band.size());
}

void LeastSquares::add(double u, std::span<const double> point, double weight) {
    assert(point.size() == std::size_t(right_.dimension()));
    const BasisAt basis = basis_at(level_, ends_, u);
    std::array<std::size_t, 4> row{};
    // Without a division: this is done for every sample. A closed curve may have one point.
    for (std::size_t i = 0; i < 4; ++i) {
        row[i] = basis.first + i;
        while (row[i] >= count_) row[i] -= count_;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            // Above the diagonal is the mirror; on it lie both orders of wrapped functions.
            if (row[k] <= row[i])
                matrix_.add(row[i], row[k], weight * basis.value[i] * basis.value[k]);
        }
        const std::span<double> right = right_[row[i]];
        for (std::size_t axis = 0; axis < point.size(); ++axis)
            right[axis] += weight * basis.value[i] * point[axis];
    }
}

Points LeastSquares::solve(std::span<const double> first,
                           std::span<const double> last) const {
    double largest = 0;
    for (const std::array<double, 4>& row : matrix_.band)
        largest = std::max(largest, row[0]);
    for (std::size_t i = 0; i < matrix_.border_rows; ++i)
        largest = std::max(largest, matrix_.corner[i][i]);
    assert(largest > 0);
    const double stiffness = std::max(kStiffness, kLeastOfDiagonal * largest);

    Matrix factors = matrix_;
    const std::size_t edges = ends_ == Ends::kOpen ? count_ - 1 : count_;
    for (std::size_t i = 0; i < edges; ++i) {
        const std::size_t next = (i + 1) % count_;
        if (next == i) continue;
        const double weight = stiffness * edge(i);
        factors.add(i, i, weight);
        factors.add(next, next, weight);
        factors.add(std::max(i, next), std::min(i, next), -weight);
    }
    Points control = right_;
    const auto fix = [&](std::size_t row, std::span<const double> value) {
        if (value.empty()) return;
        assert(ends_ == Ends::kOpen && value.size() == control[row].size());
        std::ranges::copy(value, control[row].begin());
        factors.fix(row, control);
    };
    fix(0, first);
    fix(count_ - 1, last);
    factors.factor();
    factors.solve(control);

    // What is left of the equations without stiffness is the stiffness times the last step.
    Points step = control;
    for (int round = 0; round < kRounds; ++round) {
        step = times_edges(step, stiffness);
        if (!first.empty()) std::ranges::fill(step[0], 0.0);
        if (!last.empty()) std::ranges::fill(step[count_ - 1], 0.0);
        factors.solve(step);
        for (std::size_t i = 0; i < control.numbers().size(); ++i)
            control.numbers()[i] += step.numbers()[i];
    }
    return control;
}

double LeastSquares::edge(std::size_t i) const {
    if (ends_ == Ends::kClosed) return 1;
    // Means of three knots (Greville abscissae): a straight line has them as control points.
    const auto knot = [&](std::size_t k) {
        return double(std::min(k < 3 ? 0 : k - 3, segment_count(level_)));
    };
    return 3 / (knot(i + 4) - knot(i + 1));
}

Points LeastSquares::times_edges(const Points& control, double stiffness) const {
    Points product(count_, control.dimension());
    const std::size_t edges = ends_ == Ends::kOpen ? count_ - 1 : count_;
    for (std::size_t i = 0; i < edges; ++i) {
        const std::size_t next = (i + 1) % count_;
        const double weight = stiffness * edge(i);
        for (std::size_t axis = 0; axis < std::size_t(control.dimension()); ++axis) {
            const double pull = weight * (control[i][axis] - control[next][axis]);
            product[i][axis] += pull;
            product[next][axis] -= pull;
        }
    }
    return product;
}

void LeastSquares::Matrix::add(std::size_t row, std::size_t column, double value) {
    if (row < band.size()) {
        band[row][row - column] += value;
    } else if (column < band.size()) {
        border[column][row - band.size()] += value;
    } else {
        const std::size_t i = row - band.size();
        const std::size_t k = column - band.size();
        corner[i][k] += value;
        if (i != k) corner[k][i] += value;
    }
}

// The unknown `row` becomes the value that `right` holds for it.
void LeastSquares::Matrix::fix(std::size_t row, Points& right) {
    const auto move = [&](std::size_t other, double& entry) {
        for (std::size_t axis = 0; axis < right[row].size(); ++axis)
            right[other][axis] -= entry * right[row][axis];
        entry = 0;
    };
    for (std::size_t d = 1; d < 4; ++d) {
        if (d <= row) move(row - d, band[row][d]);
        if (row + d < band.size()) move(row + d, band[row + d][d]);
    }
    band[row][0] = 1;
}

// L D L^T of the band, then of what the border leaves of its corner.
void LeastSquares::Matrix::factor() {
    for (std::size_t i = 0; i < band.size(); ++i) {
        for (std::size_t d = std::min<std::size_t>(3, i); d > 0; --d) {
            const std::size_t column = i - d;
            double sum = band[i][d];
            for (std::size_t e = d + 1; e <= std::min<std::size_t>(3, i); ++e)
                sum -= band[i][e] * band[i - e][0] * band[column][e - d];
            band[i][d] = sum / band[column][0];
        }
        for (std::size_t d = 1; d <= std::min<std::size_t>(3, i); ++d)
            band[i][0] -= band[i][d] * band[i][d] * band[i - d][0];
    }
    for (std::size_t k = 0; k < border_rows; ++k) {
        for (std::size_t i = 0; i < band.size(); ++i) {
            for (std::size_t d = 1; d <= std::min<std::size_t>(3, i); ++d)
                border[i][k] -= band[i][d] * border[i - d][k];
        }
    }
    for (std::size_t i = 0; i < band.size() && border_rows > 0; ++i) {
        for (std::size_t k = 0; k < border_rows; ++k) {
            for (std::size_t l = 0; l < border_rows; ++l)
                corner[k][l] -= border[i][k] * border[i][l] / band[i][0];
        }
        for (double& entry : border[i]) entry /= band[i][0];
    }
    for (std::size_t k = 0; k < border_rows; ++k) {
        for (std::size_t l = k + 1; l < border_rows; ++l) {
            const double part = corner[l][k] / corner[k][k];
            for (std::size_t c = k + 1; c < border_rows; ++c)
                corner[l][c] -= part * corner[k][c];
            corner[l][k] = part;
        }
    }
}

void LeastSquares::Matrix::solve(Points& right) const {
    const std::size_t rows = band.size();
    for (std::size_t axis = 0; axis < std::size_t(right.dimension()); ++axis) {
        const auto x = [&](std::size_t i) -> double& { return right[i][axis]; };
        for (std::size_t i = 0; i < rows; ++i) {
            for (std::size_t d = 1; d <= std::min<std::size_t>(3, i); ++d)
                x(i) -= band[i][d] * x(i - d);
            for (std::size_t k = 0; k < border_rows; ++k)
                x(rows + k) -= border[i][k] * x(i);
        }
        for (std::size_t k = 0; k < border_rows; ++k) {
            for (std::size_t l = 0; l < k; ++l) x(rows + k) -= corner[k][l] * x(rows + l);
        }
        for (std::size_t k = border_rows; k-- > 0;) {
            for (std::size_t l = k + 1; l < border_rows; ++l)
                x(rows + k) -= corner[k][l] * x(rows + l);
            x(rows + k) /= corner[k][k];
        }
        for (std::size_t i = rows; i-- > 0;) {
            x(i) /= band[i][0];
            for (std::size_t k = 0; k < border_rows; ++k)
                x(i) -= border[i][k] * x(rows + k);
            for (std::size_t d = 1; d < 4 && i + d < rows; ++d)
                x(i) -= band[i + d][d] * x(i + d);
        }
    }
}

}  // namespace haarmony::curve
