#include "tests/eval/brute_force.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdlib>

#include "engine/image/signature.h"
#include "tests/eval/heap_select.h"
#include "tests/eval/vector_clones.h"

namespace haarmony::eval {
namespace {

constexpr int kCellSide = image::kSide / 8;
// Distances of so many pictures are computed before they are looked at.
constexpr std::size_t kBatch = 256;

// On the features' own narrow types: compilers know the sum of absolute byte differences.
struct AbsoluteDifference {
    template <typename T>
    [[gnu::always_inline]] std::uint32_t operator()(T a, T b) const {
        return static_cast<std::uint32_t>(std::abs(a - b));
    }
};

struct SquaredDifference {
    template <typename T>
    [[gnu::always_inline]] std::uint32_t operator()(T a, T b) const {
        const int difference = a - b;
        return static_cast<std::uint32_t>(difference * difference);
    }
};

template <typename Difference, typename Features>
[[gnu::always_inline]] inline void distances_of(const Features& query,
                                                const Features* pictures,
                                                std::size_t count,
                                                std::uint32_t* distances) {
    const Difference difference;
    for (std::size_t p = 0; p < count; ++p) {
        std::uint32_t sum = 0;
        for (std::size_t i = 0; i < query.size(); ++i)
            sum += difference(query[i], pictures[p][i]);
        distances[p] = sum;
    }
}

template <typename Difference, typename Features>
HAARMONY_EVAL_AVX2 void distances_avx2(const Features& query,
                                       const Features* pictures,
                                       std::size_t count,
                                       std::uint32_t* distances) {
    distances_of<Difference>(query, pictures, count, distances);
}

template <typename Difference, typename Features>
void distances_any(const Features& query,
                   const Features* pictures,
                   std::size_t count,
                   std::uint32_t* distances) {
    distances_of<Difference>(query, pictures, count, distances);
}

template <typename Difference, typename Features>
std::vector<NearPlace> closest(const Features& query,
                               std::span<const Features> pictures,
                               int limit) {
    const auto distances_to = has_avx2() ? distances_avx2<Difference, Features>
                                         : distances_any<Difference, Features>;
    HeapSelect<NearPlace> nearest(static_cast<std::size_t>(limit));
    std::array<std::uint32_t, kBatch> distances{};
    for (std::size_t first = 0; first < pictures.size(); first += kBatch) {
        const std::size_t count = std::min(kBatch, pictures.size() - first);
        distances_to(query, pictures.data() + first, count, distances.data());
        for (std::size_t i = 0; i < count; ++i)
            nearest.offer({distances[i], static_cast<std::uint32_t>(first + i)});
    }
    return nearest.take();
}

}  // namespace

CompactFeatures compact_features(const RgbPicture& picture) {
    assert(picture.width == image::kSide && picture.height == image::kSide);
    CompactFeatures features;
    std::array<std::uint32_t, 8 * 8 * 3> sums{};
    for (int y = 0; y < image::kSide; ++y) {
        const std::uint8_t* pixel =
            picture.rgb.data() + static_cast<std::size_t>(y) * image::kSide * 3;
        for (int x = 0; x < image::kSide; ++x, pixel += 3) {
            const int cell = ((y / kCellSide) * 8 + x / kCellSide) * 3;
            std::size_t bin = 0;
            for (int c = 0; c < 3; ++c) {
                sums[cell + c] += pixel[c];
                bin = bin * 6 + pixel[c] * 6U / 256;
            }
            ++features.histogram[bin];
        }
    }
    constexpr std::uint32_t kCells = kCellSide * kCellSide;
    for (std::size_t i = 0; i < sums.size(); ++i)
        features.cells[i] = static_cast<std::uint8_t>((sums[i] + kCells / 2) / kCells);
    return features;
}

std::vector<NearPlace> closest_l1(const CellBytes& query,
                                  std::span<const CellBytes> pictures,
                                  int limit) {
    return closest<AbsoluteDifference>(query, pictures, limit);
}

std::vector<NearPlace> closest_l2(const CellBytes& query,
                                  std::span<const CellBytes> pictures,
                                  int limit) {
    return closest<SquaredDifference>(query, pictures, limit);
}

std::vector<NearPlace> closest_histogram(const HistogramCounts& query,
                                         std::span<const HistogramCounts> pictures,
                                         int limit) {
    return closest<AbsoluteDifference>(query, pictures, limit);
}

}  // namespace haarmony::eval
