// How much arithmetic a level costs: counted, because time depends on the machine.
#include "engine/curve/filter_bank.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "engine/curve/multires_curve.h"
#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

// A double that counts what is done with it.
struct Counted {
    double value = 0;
    static inline std::size_t operations = 0;

    Counted& operator+=(Counted other) { return *this = *this + other; }
    Counted& operator-=(Counted other) { return *this = *this - other; }
    Counted& operator*=(double factor) { return *this = factor * *this; }
    friend Counted operator+(Counted a, Counted b) { return counted(a.value + b.value); }
    friend Counted operator-(Counted a, Counted b) { return counted(a.value - b.value); }
    friend Counted operator*(double a, Counted b) { return counted(a * b.value); }

    static Counted counted(double result) {
        ++operations;
        return {result};
    }
};

struct Counts {
    std::size_t decompose = 0;
    std::size_t reconstruct = 0;
};

// Takes a curve of two dimensions apart to level 0 and puts it together again.
Counts count_of(int level, Ends ends) {
    constexpr int kDimension = 2;
    const Points control = dense::random_curve(level, ends, kDimension, 3);
    std::vector<Counted> rows;
    for (const double number : control.numbers()) rows.push_back({number});
    std::vector<std::vector<Counted>> details;
    Counts counts;
    Counted::operations = 0;
    for (int j = level; j >= 1; --j) {
        details.emplace_back(segment_count(j - 1) * kDimension);
        filter_bank::analyze_level<kDimension>(
            rows.data(), j, ends, rows.data(), details.back().data());
    }
    counts.decompose = Counted::operations;
    // It is the same decomposition.
    const MultiresCurve curve = decompose(control, ends);
    for (std::size_t i = 0; i < curve.coarse.numbers().size(); ++i)
        EXPECT_EQ(rows[i].value, curve.coarse.numbers()[i]) << level;
    Counted::operations = 0;
    for (int j = 1; j <= level; ++j) {
        std::vector<Counted> finer(control_count(j, ends) * kDimension);
        filter_bank::synthesize_level<kDimension, true>(
            rows.data(), details[std::size_t(level - j)].data(), j, ends, finer.data());
        rows = finer;
    }
    counts.reconstruct = Counted::operations;
    return counts;
}

TEST(FilterBank, ArithmeticIsLinearInTheControlPoints) {
    for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
        Counts before = count_of(9, ends);
        for (int level = 10; level <= 14; ++level) {
            const Counts counts = count_of(level, ends);
            // One level more costs 17 operations a number of its control points to decompose,
            // 14.5 to reconstruct, and as much for the ends as every level does (closed: for
            // running around until the start is forgotten).
            const std::size_t more = 2 * segment_count(level - 1) * 2;
            const std::size_t for_ends = ends == Ends::kOpen ? 1000 : 2500;
            EXPECT_LE(counts.decompose - before.decompose, 17 * more + for_ends) << level;
            EXPECT_LE(counts.reconstruct - before.reconstruct, 29 * more / 2 + for_ends)
                << level;
            before = counts;
        }
    }
}

TEST(FilterBank, EveryRowIsSpecialOrInterior) {
    for (int level = 1; level <= 12; ++level) {
        for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
            const filter_bank::Interior interior = filter_bank::interior_of(level, ends);
            ASSERT_LE(interior.first, interior.last) << level;
            ASSERT_LE(interior.last, control_count(level - 1, ends)) << level;
            // The interior's taps all are those of kInteriorWavelet.
            const double scale = interior_wavelet_scale(level, ends);
            for (std::size_t i = interior.first; i < interior.last; ++i) {
                const std::size_t row = filter_bank::pivot_row(level, ends, i);
                const Taps six = wavelet_row(level, ends, row);
                ASSERT_EQ(six.count, 6) << level << ", " << i;
                EXPECT_EQ(six.first, filter_bank::first_of_six(i, ends))
                    << level << ", " << i;
                const Taps five = wavelet_row(level, ends, row + 1);
                ASSERT_EQ(five.count, 5) << level << ", " << i;
                EXPECT_EQ(five.first, six.first + 1) << level << ", " << i;
                for (std::size_t k = 0; k < 6; ++k)
                    EXPECT_EQ(six.value[k], kInteriorWavelet[2 * k] * scale) << level;
                for (std::size_t k = 0; k < 5; ++k)
                    EXPECT_EQ(five.value[k], kInteriorWavelet[2 * k + 1] * scale)
                        << level;
            }
        }
    }
}

}  // namespace
}  // namespace haarmony::curve
