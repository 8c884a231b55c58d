#include "engine/curve/bspline_filters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/engine/curve/dense_spline.h"
#include "tests/engine/curve/gauss.h"

namespace haarmony::curve {
namespace {

using dense::Matrix;

constexpr Ends kBothEnds[] = {Ends::kOpen, Ends::kClosed};

// A row or column written out; what meets on a circle is added up.
template <int kMost>
std::vector<double> spread(const Run<kMost>& run, std::size_t count) {
    std::vector<double> line(count);
    for (std::size_t i = 0; i < std::size_t(run.count); ++i)
        line[(run.first + i) % count] += run.value[i];
    return line;
}

// All control points of a level as unit vectors, as many at once as a point has numbers.
Points units(std::size_t count, std::size_t first) {
    Points points(count, kMostDimensions);
    for (std::size_t d = 0; d < std::size_t(kMostDimensions) && first + d < count; ++d)
        points[first + d][d] = 1;
    return points;
}

// <Phi^j | Phi^j> by Gauss quadrature, exact on each segment: the products have degree 6.
Matrix inner_products(int level, Ends ends) {
    const std::size_t count = control_count(level, ends);
    const double segments = std::ldexp(1, level);
    Matrix products(count, std::vector<double>(count));
    std::vector<double> values(count);
    for (double segment = 0; segment < segments; ++segment) {
        for (std::size_t k = 0; k < 4; ++k) {
            const double u = (segment + 0.5 + 0.5 * kGaussPlace[k]) / segments;
            for (std::size_t i = 0; i < count; ++i)
                values[i] = dense::basis(level, ends, i, u);
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t l = 0; l < count; ++l)
                    products[i][l] +=
                        kGaussWeight[k] / (2 * segments) * values[i] * values[l];
        }
    }
    return products;
}

TEST(BsplineFilters, RefinementIsTheSameCurveAtTheFinerLevel) {
    for (const Ends ends : kBothEnds) {
        for (int level = 1; level <= 5; ++level) {
            const std::size_t columns = control_count(level - 1, ends);
            const std::size_t rows = control_count(level, ends);
            Points refined;
            for (std::size_t column = 0; column < columns; ++column) {
                const std::size_t batch = column / kMostDimensions * kMostDimensions;
                if (column == batch)
                    refined = dense::refine(units(columns, batch), ends, level);
                const auto filter = spread(refinement_column(level, ends, column), rows);
                for (std::size_t row = 0; row < rows; ++row) {
                    EXPECT_NEAR(filter[row], refined[row][column - batch], 1e-12)
                        << level << ": " << row << ", " << column;
                    EXPECT_EQ(spread(refinement_row(level, ends, row), columns)[column],
                              filter[row])
                        << level << ": " << row << ", " << column;
                }
            }
        }
    }
}

// The oracle solves normal equations and so has half the digits; that the filters have all of
// them is the next test's.
TEST(BsplineFilters, WaveletsOfAnOpenCurveAreTheOnlyOnesOfMinimalSupport) {
    for (int level = 1; level <= 4; ++level) {
        const std::size_t rows = control_count(level, Ends::kOpen);
        for (std::size_t column = 0; column < (segment_count(level - 1) + 1) / 2;
             ++column) {
            const Points wavelet = dense::wavelet(level - 1, column);
            const auto filter = spread(wavelet_column(level, Ends::kOpen, column), rows);
            for (std::size_t row = 0; row < rows; ++row)
                EXPECT_NEAR(filter[row], wavelet[row][0], 1e-4)
                    << level << ": " << row << ", " << column;
        }
    }
}

TEST(BsplineFilters, WaveletsAreOrthogonalToTheCoarserLevelAndOfUnitNorm) {
    for (const Ends ends : kBothEnds) {
        for (int level = 1; level <= 9; ++level) {
            const std::size_t rows = control_count(level, ends);
            const std::size_t columns = segment_count(level - 1);
            for (std::size_t k = 0; k < columns; k = k < 6 ? k + 1 : 2 * k) {
                const auto wavelet = spread(wavelet_column(level, ends, k), rows);
                std::vector<double> image(rows);  // I^j Q^j
                double norm2 = 0;
                for (std::size_t row = 0; row < rows; ++row) {
                    const auto gram = spread(gram_row(level, ends, row), rows);
                    for (std::size_t i = 0; i < rows; ++i)
                        image[row] += gram[i] * wavelet[i];
                    norm2 += image[row] * wavelet[row];
                }
                EXPECT_NEAR(norm2, 1, 1e-13) << level << ", " << k;
                for (std::size_t c = 0; c < control_count(level - 1, ends); ++c) {
                    const auto coarse = spread(refinement_column(level, ends, c), rows);
                    double inner = 0;
                    for (std::size_t row = 0; row < rows; ++row)
                        inner += coarse[row] * image[row];
                    EXPECT_NEAR(inner, 0, 1e-14) << level << ", " << k << ", " << c;
                }
            }
        }
    }
}

TEST(BsplineFilters, WaveletsOfAClosedCurveArePositiveAtTheirPeak) {
    for (int level = 1; level <= 6; ++level) {
        const std::size_t rows = control_count(level, Ends::kClosed);
        const std::size_t columns = segment_count(level - 1);
        for (std::size_t k = 0; k < columns; ++k) {
            Points wavelet(rows, 1);
            const auto filter = spread(wavelet_column(level, Ends::kClosed, k), rows);
            for (std::size_t row = 0; row < rows; ++row) wavelet[row][0] = filter[row];
            const double middle = (double(k) + 0.5) / double(columns);
            const double peak = dense::point(wavelet, Ends::kClosed, middle)[0];
            for (double u = 0; u < 1; u += 1.0 / 1024)
                EXPECT_LE(std::abs(dense::point(wavelet, Ends::kClosed, u)[0]),
                          peak + 1e-12)
                    << level << ", " << k << ", " << u;
        }
    }
}

TEST(BsplineFilters, RowsAndColumnsOfWaveletsAreOneMatrix) {
    for (const Ends ends : kBothEnds) {
        for (int level = 1; level <= 7; ++level) {
            const std::size_t rows = control_count(level, ends);
            const std::size_t columns = segment_count(level - 1);
            Matrix matrix;
            for (std::size_t row = 0; row < rows; ++row)
                matrix.push_back(spread(wavelet_row(level, ends, row), columns));
            for (std::size_t column = 0; column < columns; ++column) {
                const auto filter = spread(wavelet_column(level, ends, column), rows);
                for (std::size_t row = 0; row < rows; ++row)
                    EXPECT_NEAR(matrix[row][column], filter[row], 1e-12)
                        << level << ": " << row << ", " << column;
            }
        }
    }
}

TEST(BsplineFilters, GramMatricesAreInnerProducts) {
    for (const Ends ends : kBothEnds) {
        for (int level = 0; level <= 4; ++level) {
            const std::size_t count = control_count(level, ends);
            const Matrix products = inner_products(level, ends);
            for (std::size_t row = 0; row < count; ++row) {
                const auto gram = spread(gram_row(level, ends, row), count);
                for (std::size_t i = 0; i < count; ++i)
                    EXPECT_NEAR(gram[i], products[row][i], 1e-15)
                        << level << ": " << row << ", " << i;
            }
        }
    }
}

TEST(BsplineFilters, GramMatrixOfWaveletsIsQTransposedIQ) {
    for (const Ends ends : kBothEnds) {
        for (int level = 1; level <= 6; ++level) {
            const std::size_t rows = control_count(level, ends);
            const std::size_t columns = segment_count(level - 1);
            Matrix wavelets;
            for (std::size_t k = 0; k < columns; ++k)
                wavelets.push_back(spread(wavelet_column(level, ends, k), rows));
            for (std::size_t k = 0; k < columns; ++k) {
                const auto found = spread(wavelet_gram_row(level, ends, k), columns);
                for (std::size_t l = 0; l < columns; ++l) {
                    double sum = 0;
                    for (std::size_t row = 0; row < rows; ++row) {
                        const auto gram = spread(gram_row(level, ends, row), rows);
                        for (std::size_t i = 0; i < rows; ++i)
                            sum += wavelets[k][row] * gram[i] * wavelets[l][i];
                    }
                    EXPECT_NEAR(found[l], sum, 1e-13) << level << ": " << k << ", " << l;
                }
            }
        }
    }
}

TEST(BsplineFilters, JumpsOfTheThirdDerivativeAnnihilateWhatIsCoarse) {
    for (const Ends ends : kBothEnds) {
        for (int level = 1; level <= 7; ++level) {
            const std::size_t rows = control_count(level, ends);
            for (std::size_t k = 0; k < segment_count(level - 1); ++k) {
                const auto jump = spread(jump_row(level, ends, k), rows);
                for (std::size_t c = 0; c < control_count(level - 1, ends); ++c) {
                    const auto coarse = spread(refinement_column(level, ends, c), rows);
                    double sum = 0;
                    for (std::size_t row = 0; row < rows; ++row)
                        sum += jump[row] * coarse[row];
                    EXPECT_EQ(sum, 0) << level << ": " << k << ", " << c;
                }
            }
        }
    }
}

TEST(BsplineFilters, InteriorWaveletsAreOneStampTimesAScale) {
    for (const Ends ends : kBothEnds) {
        const Filter filter = wavelet_column(9, ends, 100);
        EXPECT_EQ(filter.first, ends == Ends::kOpen ? 197U : 196U);
        for (std::size_t i = 0; i < kInteriorWavelet.size(); ++i)
            EXPECT_EQ(filter.value[i],
                      kInteriorWavelet[i] * interior_wavelet_scale(9, ends));
    }
}

}  // namespace
}  // namespace haarmony::curve
