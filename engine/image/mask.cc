#include "engine/image/mask.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace haarmony::image {
namespace {

// Written so that equal ends give exactly that value, t = 0 exactly `from`, and t = 1
// exactly `to` if `from` is 0.
double mix(double from, double to, double t) { return from + t * (to - from); }

// One level of the pyramid: what is known of each block, and how well.
struct Level {
    int side = 0;
    std::vector<std::array<double, kChannels>> colors;
    std::vector<double> cover;
};

Level finest(const Plane& cover, const ColorPlanes& rgb) {
    Level level{kSide, {}, {cover.begin(), cover.end()}};
    level.colors.resize(cover.size());
    for (std::size_t i = 0; i < cover.size(); ++i) {
        for (int c = 0; c < kChannels; ++c) level.colors[i][c] = double{rgb[c][i]};
    }
    return level;
}

// Each block of 2 x 2 as one: the mean of what is painted, known as well as one painted cell
// of the four would be. Without this bound the blocks along the edge of the painted part
// would still be half unknown, and far colours would reach into them.
Level pull(const Level& fine) {
    Level coarse{fine.side / 2, {}, {}};
    for (int y = 0; y < coarse.side; ++y) {
        for (int x = 0; x < coarse.side; ++x) {
            std::array<double, kChannels> color{};
            double cover = 0;
            for (const int offset : {0, 1, fine.side, fine.side + 1}) {
                const std::size_t i = std::size_t(2 * y * fine.side + 2 * x + offset);
                if (fine.cover[i] <= 0) continue;
                cover += fine.cover[i];
                for (int c = 0; c < kChannels; ++c) {
                    color[c] = mix(color[c], fine.colors[i][c], fine.cover[i] / cover);
                }
            }
            coarse.colors.push_back(color);
            coarse.cover.push_back(std::min(cover, 1.0));
        }
    }
    return coarse;
}

// The two blocks of the coarser level nearest to a cell along one axis; the cell's centre
// lies a quarter of the way from `near` to `far`.
struct Neighbours {
    int near = 0;
    int far = 0;
};

Neighbours neighbours(int cell, int coarse_side) {
    const int near = cell / 2;
    const int far = cell % 2 == 0 ? near - 1 : near + 1;
    return {near, std::clamp(far, 0, coarse_side - 1)};
}

// Fills what the finer level does not know with the coarser one, which is known everywhere.
void push(const Level& coarse, Level& fine) {
    constexpr double kQuarter = 0.25;
    for (int y = 0; y < fine.side; ++y) {
        const Neighbours rows = neighbours(y, coarse.side);
        for (int x = 0; x < fine.side; ++x) {
            const std::size_t i = std::size_t(y) * fine.side + x;
            if (fine.cover[i] >= 1) continue;
            const Neighbours columns = neighbours(x, coarse.side);
            const auto at = [&](int row, int column) {
                return coarse.colors[std::size_t(row) * coarse.side + column];
            };
            const auto near_near = at(rows.near, columns.near);
            const auto near_far = at(rows.near, columns.far);
            const auto far_near = at(rows.far, columns.near);
            const auto far_far = at(rows.far, columns.far);
            for (int c = 0; c < kChannels; ++c) {
                const double around = mix(mix(near_near[c], near_far[c], kQuarter),
                                          mix(far_near[c], far_far[c], kQuarter),
                                          kQuarter);
                fine.colors[i][c] = mix(around, fine.colors[i][c], fine.cover[i]);
            }
        }
    }
}

// Replaces the values by the means over the supports of the wavelets of one dimension: of
// index 1 all of them, of 2i and 2i + 1 the two halves of i's. Index 0 is index 1.
void support_means(float* values, std::ptrdiff_t stride) {
    std::array<float, 2 * kSide> means{};
    for (int i = 0; i < kSide; ++i) means[kSide + i] = values[i * stride];
    for (int i = kSide - 1; i > 0; --i) {
        means[i] = (means[2 * i] + means[2 * i + 1]) * 0.5F;
    }
    means[0] = means[1];
    for (int i = 0; i < kSide; ++i) values[i * stride] = means[i];
}

// Over the supports of the standard wavelets.
void rectangle_means(Plane& plane) {
    for (int i = 0; i < kSide; ++i) support_means(plane.data() + i * kSide, 1);
    for (int j = 0; j < kSide; ++j) support_means(plane.data() + j, kSide);
}

// Over the supports of the non-standard wavelets: of level k, 2^k x 2^k squares, the same
// for the three wavelets (row, column + 2^k), (row + 2^k, column), (row + 2^k, column + 2^k).
void square_means(Plane& plane) {
    std::vector<float> fine(plane.begin(), plane.end());
    for (int side = kSide / 2; side > 0; side /= 2) {
        std::vector<float> coarse;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const float* const block = fine.data() + 4 * y * side + 2 * x;
                const float mean =
                    (block[0] + block[1] + block[2 * side] + block[2 * side + 1]) * 0.25F;
                coarse.push_back(mean);
                plane[y * kSide + x + side] = mean;
                plane[(y + side) * kSide + x] = mean;
                plane[(y + side) * kSide + x + side] = mean;
            }
        }
        fine = std::move(coarse);
    }
}

}  // namespace

void extend_painted(const Plane& cover, ColorPlanes& rgb) {
    assert(std::ranges::any_of(cover, [](float share) { return share > 0; }));
    std::vector<Level> levels{finest(cover, rgb)};
    while (levels.back().side > 1) levels.push_back(pull(levels.back()));
    for (std::size_t i = levels.size() - 1; i > 0; --i) push(levels[i], levels[i - 1]);
    for (int c = 0; c < kChannels; ++c) {
        for (int i = 0; i < kCoefficientCount; ++i) {
            rgb[c][i] = static_cast<float>(levels[0].colors[i][c]);
        }
    }
}

void weigh_by_cover(const Plane& cover,
                    Decomposition decomposition,
                    Plane& coefficients) {
    Plane means = cover;
    if (decomposition == Decomposition::kStandard) {
        rectangle_means(means);
    } else {
        square_means(means);
    }
    means[0] = 1;
    for (int i = 0; i < kCoefficientCount; ++i) coefficients[i] *= means[i];
}

int kept_coefficients(const Plane& cover) {
    const double painted = std::accumulate(cover.begin(), cover.end(), 0.0);
    const double unpainted = kCoefficientCount - painted;
    if (painted <= 0) return 0;
    const double share = painted / (painted + kUnpaintedCost * unpainted);
    return std::max(kFewestCoefficients,
                    static_cast<int>(std::ceil(kMaxCoefficients * share)));
}

}  // namespace haarmony::image
