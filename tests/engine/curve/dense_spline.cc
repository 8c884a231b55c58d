#include "tests/engine/curve/dense_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>
#include <utility>

#include "tests/engine/curve/gauss.h"

namespace haarmony::curve::dense {
namespace {

double knot(int level, std::size_t number) {
    const double last = std::ldexp(1, level);
    return std::clamp(double(number) - 3, 0.0, last) / last;
}

double by_recursion(int level, std::size_t index, int degree, double u) {
    if (degree == 0) {
        const double from = knot(level, index);
        const double to = knot(level, index + 1);
        // Half-open, but for the last segment, which has its end.
        return from < to && u >= from && (u < to || (u == 1 && to == 1)) ? 1 : 0;
    }
    double value = 0;
    const double left = knot(level, index + degree) - knot(level, index);
    const double right = knot(level, index + degree + 1) - knot(level, index + 1);
    if (left > 0) {
        value +=
            (u - knot(level, index)) / left * by_recursion(level, index, degree - 1, u);
    }
    if (right > 0) {
        value += (knot(level, index + degree + 1) - u) / right *
                 by_recursion(level, index + 1, degree - 1, u);
    }
    return value;
}

// The cubic B-spline of knots -2 .. 2.
double cardinal(double x) {
    const double a = std::abs(x);
    if (a >= 2) return 0;
    if (a >= 1) return (2 - a) * (2 - a) * (2 - a) / 6;
    return 2.0 / 3 - a * a + a * a * a / 2;
}

// <Phi^rows | Phi^columns>, exact: Gauss with 4 points on segments where both are cubic.
Matrix make_inner_products(int rows, int columns, Ends ends) {
    Matrix products(points_of(rows, ends), std::vector<double>(points_of(columns, ends)));
    const double segments = std::ldexp(1, std::max(rows, columns));
    for (double segment = 0; segment < segments; ++segment) {
        for (std::size_t k = 0; k < kGaussPlace.size(); ++k) {
            const double u = (segment + 0.5 + 0.5 * kGaussPlace[k]) / segments;
            for (std::size_t i = 0; i < products.size(); ++i) {
                const double left = basis(rows, ends, i, u);
                if (left == 0) continue;
                for (std::size_t j = 0; j < products[i].size(); ++j) {
                    products[i][j] += kGaussWeight[k] / (2 * segments) * left *
                                      basis(columns, ends, j, u);
                }
            }
        }
    }
    return products;
}

const Matrix& inner_products(int rows, int columns, Ends ends) {
    static std::map<std::tuple<int, int, Ends>, Matrix> known;
    Matrix& products = known[{rows, columns, ends}];
    if (products.empty()) products = make_inner_products(rows, columns, ends);
    return products;
}

// x of a x = b, column by column, with pivots.
Matrix solve(Matrix a, Matrix b) {
    const std::size_t n = a.size();
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t pivot = c;
        for (std::size_t r = c + 1; r < n; ++r) {
            if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
        }
        std::swap(a[c], a[pivot]);
        std::swap(b[c], b[pivot]);
        for (std::size_t r = 0; r < n; ++r) {
            if (r == c) continue;
            const double factor = a[r][c] / a[c][c];
            for (std::size_t k = c; k < n; ++k) a[r][k] -= factor * a[c][k];
            for (std::size_t k = 0; k < b[r].size(); ++k) b[r][k] -= factor * b[c][k];
        }
    }
    for (std::size_t r = 0; r < n; ++r) {
        for (double& number : b[r]) number /= a[r][r];
    }
    return b;
}

// Best approximation in another level: exact where that is finer.
Points to_level(const Points& control, Ends ends, int level) {
    int own = 0;
    while (points_of(own, ends) != control.size()) ++own;
    const Matrix& mixed = inner_products(level, own, ends);
    Matrix right(mixed.size(), std::vector<double>(std::size_t(control.dimension())));
    for (std::size_t i = 0; i < mixed.size(); ++i) {
        for (std::size_t j = 0; j < control.size(); ++j) {
            for (std::size_t d = 0; d < right[i].size(); ++d) {
                right[i][d] += mixed[i][j] * control[j][d];
            }
        }
    }
    const Matrix solution = solve(inner_products(level, level, ends), right);
    Points result(solution.size(), control.dimension());
    for (std::size_t i = 0; i < solution.size(); ++i) {
        std::ranges::copy(solution[i], result[i].begin());
    }
    return result;
}

struct Window {
    std::size_t first;
    std::size_t count;
};

// The rows of wavelet `row` of an open curve's level: the table of minimal supports.
Window window(int level, std::size_t row) {
    const std::size_t rows = std::size_t{1} << level;
    if (level == 0) return {0, 5};
    const std::size_t from_end = std::min(row, rows - 1 - row);
    Window found{0, 0};
    if (level == 1) {
        found = {0, 6};
    } else if (level == 2) {
        found = {from_end, 8};
    } else if (from_end < 3) {
        found = {from_end, 8 + from_end};
    } else {
        found = {2 * from_end - 3, 11};
    }
    const std::size_t points = points_of(level + 1, Ends::kOpen);
    if (row != from_end) found.first = points - found.first - found.count;
    return found;
}

}  // namespace

std::size_t points_of(int level, Ends ends) {
    return (std::size_t{1} << level) + (ends == Ends::kOpen ? 3 : 0);
}

double basis(int level, Ends ends, std::size_t index, double u) {
    if (ends == Ends::kOpen) {
        if (u < knot(level, index) || u > knot(level, index + 4)) return 0;
        return by_recursion(level, index, 3, u);
    }
    const double period = std::ldexp(1, level);
    double value = 0;
    for (int lap = -3; lap <= 3; ++lap) {
        value += cardinal(u * period - double(index) + lap * period);
    }
    return value;
}

std::vector<double> point(const Points& control, Ends ends, double u) {
    int level = 0;
    while (points_of(level, ends) != control.size()) ++level;
    std::vector<double> place(std::size_t(control.dimension()));
    for (std::size_t i = 0; i < control.size(); ++i) {
        if (std::ranges::count(control[i], 0) == control.dimension()) continue;
        const double value = basis(level, ends, i, u);
        for (std::size_t d = 0; d < place.size(); ++d) place[d] += value * control[i][d];
    }
    return place;
}

std::vector<double> slope(const Points& control, Ends ends, double u) {
    int level = 0;
    while (points_of(level, ends) != control.size()) ++level;
    const double segments = std::ldexp(1, level);
    const double start = std::min(std::floor(u * segments), segments - 1);
    const double x = u * segments - start;
    constexpr std::array<double, 4> kNodes = {0.125, 0.375, 0.625, 0.875};
    std::vector<double> result(std::size_t(control.dimension()));
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
        double derivative = 0;
        double scale = 1;
        for (std::size_t k = 0; k < kNodes.size(); ++k) {
            if (k == i) continue;
            scale *= kNodes[i] - kNodes[k];
            double product = 1;
            for (std::size_t m = 0; m < kNodes.size(); ++m) {
                if (m != i && m != k) product *= x - kNodes[m];
            }
            derivative += product;
        }
        const std::vector<double> place =
            point(control, ends, (start + kNodes[i]) / segments);
        for (std::size_t d = 0; d < result.size(); ++d) {
            result[d] += segments * derivative / scale * place[d];
        }
    }
    return result;
}

Points project(const Points& control, Ends ends, int level) {
    return to_level(control, ends, level);
}

Points refine(const Points& control, Ends ends, int level) {
    return to_level(control, ends, level);
}

Points wavelet(int level, std::size_t row) {
    const Matrix& mixed = inner_products(level, level + 1, Ends::kOpen);
    const Window rows = window(level, row);
    // Normal equations of what is orthogonal to the level, with the first number held at 1.
    Matrix square(rows.count - 1, std::vector<double>(rows.count - 1));
    Matrix right(rows.count - 1, std::vector<double>(1));
    for (const std::vector<double>& products : mixed) {
        for (std::size_t i = 1; i < rows.count; ++i) {
            const double left = products[rows.first + i] * 1e4;
            right[i - 1][0] -= left * products[rows.first] * 1e4;
            for (std::size_t j = 1; j < rows.count; ++j) {
                square[i - 1][j - 1] += left * products[rows.first + j] * 1e4;
            }
        }
    }
    const Matrix others = solve(square, right);
    Points control(points_of(level + 1, Ends::kOpen), 1);
    control[rows.first][0] = 1;
    for (std::size_t i = 1; i < rows.count; ++i) {
        control[rows.first + i][0] = others[i - 1][0];
    }
    const Matrix& gram = inner_products(level + 1, level + 1, Ends::kOpen);
    double norm2 = 0;
    for (std::size_t i = 0; i < control.size(); ++i) {
        for (std::size_t j = 0; j < control.size(); ++j) {
            norm2 += control[i][0] * gram[i][j] * control[j][0];
        }
    }
    double scale = 1 / std::sqrt(norm2);
    const double top = level == 0 ? 0 : peak(control, Ends::kOpen);
    if (point(control, Ends::kOpen, top)[0] < 0) scale = -scale;
    for (double& number : control.numbers()) number *= scale;
    return control;
}

Points combination(const Points& sum, const std::vector<Points>& columns) {
    Matrix square(columns.size(), std::vector<double>(columns.size()));
    Matrix right(columns.size(), std::vector<double>(std::size_t(sum.dimension())));
    for (std::size_t a = 0; a < columns.size(); ++a) {
        for (std::size_t i = 0; i < sum.size(); ++i) {
            for (std::size_t b = 0; b < columns.size(); ++b) {
                square[a][b] += columns[a][i][0] * columns[b][i][0];
            }
            for (std::size_t d = 0; d < right[a].size(); ++d) {
                right[a][d] += columns[a][i][0] * sum[i][d];
            }
        }
    }
    const Matrix weights = solve(square, right);
    Points result(weights.size(), sum.dimension());
    for (std::size_t a = 0; a < weights.size(); ++a) {
        std::ranges::copy(weights[a], result[a].begin());
    }
    return result;
}

double peak(const Points& control, Ends ends) {
    constexpr int kSamples = 1 << 9;
    const auto size = [&](double u) { return std::abs(point(control, ends, u)[0]); };
    double best = 0;
    for (int i = 1; i <= kSamples; ++i) {
        if (size(double(i) / kSamples) > size(best)) best = double(i) / kSamples;
    }
    double from = std::max(0.0, best - 1.0 / kSamples);
    double to = std::min(1.0, best + 1.0 / kSamples);
    for (int i = 0; i < 60; ++i) {
        const double a = from + (to - from) / 3;
        const double b = to - (to - from) / 3;
        (size(a) < size(b) ? from : to) = size(a) < size(b) ? a : b;
    }
    return (from + to) / 2;
}

Points sum(const Points& a, double weight, const Points& b) {
    Points result = a;
    for (std::size_t i = 0; i < result.numbers().size(); ++i) {
        result.numbers()[i] += weight * b.numbers()[i];
    }
    return result;
}

double distance(const Points& a, const Points& b) {
    if (a.size() != b.size() || a.dimension() != b.dimension()) {
        return std::numeric_limits<double>::infinity();
    }
    double most = 0;
    for (std::size_t i = 0; i < a.numbers().size(); ++i) {
        most = std::max(most, std::abs(a.numbers()[i] - b.numbers()[i]));
    }
    return most;
}

Points random_curve(int level, Ends ends, int dimension, std::uint32_t seed) {
    std::mt19937 random(seed);
    Points control(points_of(level, ends), dimension);
    std::array<double, kMostDimensions> at{};
    for (std::size_t i = 0; i < control.size(); ++i) {
        for (int d = 0; d < dimension; ++d) {
            at[d] += double(random()) / 4294967296.0 * 80 - 40;
            control[i][d] = at[d];
        }
    }
    return control;
}

}  // namespace haarmony::curve::dense
