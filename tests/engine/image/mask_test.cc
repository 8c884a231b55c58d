#include "engine/image/mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <tuple>

#include "engine/image/haar_inverse.h"

namespace haarmony::image {
namespace {

constexpr int kFinest = 0;
constexpr int kCoarsest = 7;

struct Painting {
    std::unique_ptr<Plane> cover = std::make_unique<Plane>();
    std::unique_ptr<ColorPlanes> rgb = std::make_unique<ColorPlanes>();
};

// A third of the cells painted in full, a third in part, a third not at all; and a quarter
// of the picture with nothing in it.
Painting patches(unsigned seed) {
    Painting painting;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    for (int i = 0; i < kCoefficientCount; ++i) {
        const bool empty_quarter = i / kSide >= kSide / 2 && i % kSide < kSide / 2;
        const auto kind = random() % 3;
        const float part = share(random);
        (*painting.cover)[i] = empty_quarter || kind == 0 ? 0.0F
                               : kind == 1                ? 1.0F
                                                          : part;
        for (Plane& plane : *painting.rgb) {
            const float value = share(random);
            plane[i] = (*painting.cover)[i] > 0 ? value : 0.0F;
        }
    }
    return painting;
}

// Push-pull as it is defined, one block at a time.
class PushPull {
  public:
    PushPull(const Painting& painting, int channel)
        : cover_(*painting.cover), colors_((*painting.rgb)[channel]) {}

    double filled(int level, int y, int x) {
        if (level == kCoarsest) return known(level, y, x).color;
        const auto [found, is_new] = filled_.try_emplace({level, y, x}, 0.0);
        if (!is_new) return found->second;
        const Known self = known(level, y, x);
        double around = 0;
        for (const bool far_row : {false, true}) {
            for (const bool far_column : {false, true}) {
                around +=
                    (far_row ? 0.25 : 0.75) * (far_column ? 0.25 : 0.75) *
                    filled(
                        level + 1, block(level, y, far_row), block(level, x, far_column));
            }
        }
        return filled_[{level, y, x}] =
                   self.cover * self.color + (1 - self.cover) * around;
    }

  private:
    struct Known {
        double color = 0;
        double cover = 0;
    };

    // The block around a cell, or the next one on the side where the cell lies in it.
    static int block(int level, int cell, bool next) {
        const int last = (kSide >> (level + 1)) - 1;
        const int neighbour = cell % 2 == 0 ? cell / 2 - 1 : cell / 2 + 1;
        return next ? std::clamp(neighbour, 0, last) : cell / 2;
    }

    Known known(int level, int y, int x) {
        if (level == kFinest) return {colors_[y * kSide + x], cover_[y * kSide + x]};
        Known sum;
        for (int child = 0; child < 4; ++child) {
            const Known part = known(level - 1, 2 * y + child / 2, 2 * x + child % 2);
            sum.color += part.cover * part.color;
            sum.cover += part.cover;
        }
        if (sum.cover == 0) return {};
        return {sum.color / sum.cover, std::min(sum.cover, 1.0)};
    }

    const Plane& cover_;
    const Plane& colors_;
    std::map<std::tuple<int, int, int>, double> filled_;
};

TEST(ExtendPainted, IsPushPullFromTheDefinition) {
    const Painting before = patches(1);
    Painting after = patches(1);
    extend_painted(*after.cover, *after.rgb);
    for (int c = 0; c < kChannels; ++c) {
        PushPull oracle(before, c);
        for (int i = 0; i < kCoefficientCount; i += 37) {
            ASSERT_NEAR(
                (*after.rgb)[c][i], oracle.filled(kFinest, i / kSide, i % kSide), 1e-6)
                << "channel " << c << ", cell " << i / kSide << ", " << i % kSide;
        }
    }
}

TEST(ExtendPainted, LeavesWhatIsPaintedInFull) {
    const Painting before = patches(2);
    Painting after = patches(2);
    extend_painted(*after.cover, *after.rgb);
    for (int i = 0; i < kCoefficientCount; ++i) {
        if ((*before.cover)[i] < 1) continue;
        for (int c = 0; c < kChannels; ++c) {
            ASSERT_EQ((*after.rgb)[c][i], (*before.rgb)[c][i]) << i;
        }
    }
}

TEST(ExtendPainted, ContinuesOneColorExactly) {
    Painting painting = patches(3);
    for (int i = 0; i < kCoefficientCount; ++i) {
        for (int c = 0; c < kChannels; ++c) {
            (*painting.rgb)[c][i] = (*painting.cover)[i] > 0 ? 0.1F * float(c + 1) : 0.0F;
        }
    }
    extend_painted(*painting.cover, *painting.rgb);
    for (int c = 0; c < kChannels; ++c) {
        for (const float value : (*painting.rgb)[c])
            ASSERT_EQ(value, 0.1F * float(c + 1));
    }
}

TEST(ExtendPainted, OfOnePaintedCellIsThatCellEverywhere) {
    Painting painting;
    (*painting.cover)[77 * kSide + 5] = 1e-3F;
    for (Plane& plane : *painting.rgb) plane[77 * kSide + 5] = 0.7F;
    extend_painted(*painting.cover, *painting.rgb);
    for (const Plane& plane : *painting.rgb) {
        for (const float value : plane) ASSERT_EQ(value, 0.7F);
    }
}

// An antialiased edge: a little more or less of a cell is a little more or less of its colour.
TEST(ExtendPainted, ChangesLittleWhereTheCoverDoes) {
    constexpr float kStep = 1.0F / 255;
    const Painting start = patches(4);
    Painting before = patches(4);
    Painting after = patches(4);
    for (int i = 0; i < kCoefficientCount; ++i) {
        const float cover = (*start.cover)[i];
        if (cover > 0) (*after.cover)[i] = std::max(cover - kStep, cover / 2);
    }
    extend_painted(*before.cover, *before.rgb);
    extend_painted(*after.cover, *after.rgb);
    float largest = 0;
    for (int c = 0; c < kChannels; ++c) {
        for (int i = 0; i < kCoefficientCount; ++i) {
            largest =
                std::max(largest, std::fabs((*after.rgb)[c][i] - (*before.rgb)[c][i]));
        }
    }
    EXPECT_GT(largest, 0.0F);
    // Colours lie in [0, 1]; a cell mixes with its surroundings, which mix with theirs.
    EXPECT_LT(largest, 8 * kStep);
}

class WeighByCover : public testing::TestWithParam<Decomposition> {};

// The support of a wavelet is where the picture of its coefficient alone is not 0.
TEST_P(WeighByCover, MultipliesByTheMeanCoverOfTheSupport) {
    const Painting painting = patches(5);
    Plane weighed;
    weighed.fill(1.0F);
    weigh_by_cover(*painting.cover, GetParam(), weighed);
    EXPECT_EQ(weighed[0], 1.0F);
    for (int index = 1; index < kCoefficientCount; index += index < 40 ? 1 : 131) {
        Plane wavelet{};
        wavelet[index] = 1.0F;
        recompose(wavelet, kSide, GetParam());
        double sum = 0;
        int cells = 0;
        for (int i = 0; i < kCoefficientCount; ++i) {
            if (wavelet[i] == 0) continue;
            sum += double{(*painting.cover)[i]};
            ++cells;
        }
        ASSERT_NEAR(weighed[index], sum / cells, 1e-6)
            << index / kSide << ", " << index % kSide;
    }
}

INSTANTIATE_TEST_SUITE_P(Decompositions,
                         WeighByCover,
                         testing::Values(Decomposition::kStandard,
                                         Decomposition::kNonstandard));

int kept_of_rows(int painted_rows) {
    Plane cover{};
    std::fill_n(cover.begin(), painted_rows * kSide, 1.0F);
    return kept_coefficients(cover);
}

TEST(KeptCoefficients, AreAllWhereAllIsPaintedAndNoneWhereNothingIs) {
    EXPECT_EQ(kept_of_rows(kSide), kMaxCoefficients);
    EXPECT_EQ(kept_of_rows(0), 0);
}

TEST(KeptCoefficients, CountUnpaintedCellsFourfold) {
    EXPECT_EQ(kept_of_rows(kSide / 2), 20);      // 100 * 1 / (1 + 4)
    EXPECT_EQ(kept_of_rows(kSide / 4), 8);       // 100 * 1 / (1 + 12), rounded up
    EXPECT_EQ(kept_of_rows(3 * kSide / 4), 43);  // 100 * 3 / (3 + 4), rounded up
}

TEST(KeptCoefficients, AreAFewOfTheFirstDab) {
    EXPECT_EQ(kept_of_rows(1), kFewestCoefficients);
}

TEST(KeptCoefficients, GrowWithWhatIsPainted) {
    for (int rows = 1; rows <= kSide; ++rows) {
        EXPECT_GE(kept_of_rows(rows), kept_of_rows(rows - 1)) << rows;
    }
}

}  // namespace
}  // namespace haarmony::image
