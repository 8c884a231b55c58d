#include "tests/eval/rival_metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <memory>

#include "engine/image/color_planes.h"
#include "engine/image/resample.h"

namespace haarmony::eval {
namespace {

constexpr int kCellSide = image::kSide / 8;

// 128 * 128 * 3 differences of a byte stay below 2^24, their squares below 2^32: 32-bit
// sums are exact, and twice as many fit into a vector register.
static_assert(std::uint64_t{image::kCoefficientCount} * 3 * 255 * 255 < (1ULL << 32));

std::uint32_t absolute_sum(const std::uint8_t* a,
                           const std::uint8_t* b,
                           std::size_t count) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        sum += static_cast<std::uint32_t>(std::abs(a[i] - b[i]));
    }
    return sum;
}

std::uint32_t square_sum(const std::uint8_t* a,
                         const std::uint8_t* b,
                         std::size_t count) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const int difference = a[i] - b[i];
        sum += static_cast<std::uint32_t>(difference * difference);
    }
    return sum;
}

template <std::size_t N>
std::uint64_t absolute_sum(const std::array<std::int32_t, N>& a,
                           const std::array<std::int32_t, N>& b) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < N; ++i)
        sum += static_cast<std::uint64_t>(std::abs(a[i] - b[i]));
    return sum;
}

template <std::size_t N>
std::uint64_t square_sum(const std::array<std::int32_t, N>& a,
                         const std::array<std::int32_t, N>& b) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < N; ++i) {
        const std::int64_t difference = std::int64_t{a[i]} - b[i];
        sum += difference * difference;
    }
    return static_cast<std::uint64_t>(sum);
}

}  // namespace

MetricName rival_name(Rival rival) {
    switch (rival) {
        case Rival::kL1Full:
            return {"L1", "128x128"};
        case Rival::kL2Full:
            return {"L2", "128x128"};
        case Rival::kL1Cells:
            return {"L1", "8x8"};
        case Rival::kL2Cells:
            return {"L2", "8x8"};
        case Rival::kHistogram:
            break;
    }
    return {"histogram", "6x6x6"};
}

RivalFeatures describe_rivals(const ImageView& picture) {
    const auto planes = std::make_unique<image::ColorPlanes>();
    (void)image::area_average(picture, *planes);
    RivalFeatures features;
    features.square.resize(std::size_t{image::kCoefficientCount} * 3);
    for (int y = 0; y < image::kSide; ++y) {
        for (int x = 0; x < image::kSide; ++x) {
            const int place = y * image::kSide + x;
            std::size_t bin = 0;
            for (int c = 0; c < 3; ++c) {
                const auto value =
                    static_cast<std::uint8_t>(std::lround((*planes)[c][place] * 255.0F));
                features.square[std::size_t(place) * 3 + c] = value;
                features.cells[((y / kCellSide) * 8 + x / kCellSide) * 3 + c] += value;
                bin = bin * 6 + value * 6 / 256;
            }
            ++features.histogram[bin];
        }
    }
    return features;
}

std::uint64_t distance(Rival rival, const RivalFeatures& a, const RivalFeatures& b) {
    assert(a.square.size() == b.square.size());
    switch (rival) {
        case Rival::kL1Full:
            return absolute_sum(a.square.data(), b.square.data(), a.square.size());
        case Rival::kL2Full:
            return square_sum(a.square.data(), b.square.data(), a.square.size());
        case Rival::kL1Cells:
            return absolute_sum(a.cells, b.cells);
        case Rival::kL2Cells:
            return square_sum(a.cells, b.cells);
        case Rival::kHistogram:
            break;
    }
    return absolute_sum(a.histogram, b.histogram);
}

}  // namespace haarmony::eval
