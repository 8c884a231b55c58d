#include "engine/image/window.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace haarmony::image {
namespace {

// Steps of a tenth of the target: half of one is a shift that coefficients bear.
constexpr std::array<int, 4> kPlacesOf60 = {0, 13, 27, 40};

constexpr auto kPlacements = [] {
    std::array<Placement, 23> all = {{{0, 0, 100},
                                      {0, 0, 80},
                                      {20, 0, 80},
                                      {10, 10, 80},
                                      {0, 20, 80},
                                      {20, 20, 80},
                                      {20, 20, 60}}};
    std::size_t next = 7;
    for (const int top : kPlacesOf60) {
        for (const int left : kPlacesOf60) all[next++] = {left, top, 60};
    }
    return all;
}();

// Samples of the picture along each side: 60 and 80 % of whole canvases.
constexpr int kSamples = 192;

struct Rgba {
    int side = 0;
    std::vector<std::uint8_t> bytes;

    [[nodiscard]] std::uint8_t* at(int x, int y) {
        return bytes.data() + (std::ptrdiff_t{y} * side + x) * 4;
    }
    [[nodiscard]] ImageView view() const {
        return {bytes.data(), side, side, 4, std::ptrdiff_t{4} * side};
    }
};

// The pixels that one sample stands for along one axis, at least one.
struct Pixels {
    int begin = 0;
    int end = 0;
};

Pixels pixels_of(int sample, int length) {
    const auto border = [&](int i) {
        return static_cast<int>(std::int64_t{i} * length / kSamples);
    };
    const int begin = border(sample);
    return {begin, std::max(begin + 1, border(sample + 1))};
}

// The mean of a block, colours weighed by alpha, rounded to the nearest.
void average(const ImageView& picture, Pixels columns, Pixels rows, std::uint8_t* out) {
    std::array<std::uint64_t, 4> sum{};
    std::uint64_t count = 0;
    for (int y = rows.begin; y < rows.end; ++y) {
        const std::uint8_t* pixel =
            picture.row(y) + std::ptrdiff_t{columns.begin} * picture.channels;
        for (int x = columns.begin; x < columns.end; ++x, pixel += picture.channels) {
            const unsigned alpha = picture.channels == 4 ? pixel[3] : 255U;
            for (int c = 0; c < 3; ++c) {
                sum[c] += alpha * pixel[picture.channels == 1 ? 0 : c];
            }
            sum[3] += alpha;
            ++count;
        }
    }
    for (int c = 0; c < 3 && sum[3] > 0; ++c) {
        out[c] = static_cast<std::uint8_t>((sum[c] + sum[3] / 2) / sum[3]);
    }
    out[3] = static_cast<std::uint8_t>((sum[3] + count / 2) / count);
}

Rgba sampled(const ImageView& picture) {
    Rgba small{kSamples, std::vector<std::uint8_t>(std::size_t{4} * kSamples * kSamples)};
    for (int y = 0; y < kSamples; ++y) {
        for (int x = 0; x < kSamples; ++x) {
            average(picture,
                    pixels_of(x, picture.width),
                    pixels_of(y, picture.height),
                    small.at(x, y));
        }
    }
    return small;
}

Rgba placed(Rgba& picture, const Placement& placement) {
    const int side = kSamples * 100 / placement.side;
    Rgba canvas{side, std::vector<std::uint8_t>(std::size_t{4} * side * side)};
    for (int y = 0; y < kSamples; ++y) {
        std::copy_n(
            picture.at(0, y),
            4 * kSamples,
            canvas.at(placement.left * side / 100, placement.top * side / 100 + y));
    }
    return canvas;
}

// How a picture of kSamples x kSamples lies off: moved by samples, then scaled by
// numerator / denominator about its middle.
struct Offset {
    int right = 0;
    int down = 0;
    int numerator = 1;
    int denominator = 1;
};

constexpr int kMove = 4;  // samples: one fiftieth

constexpr std::array<Offset, 10> kOffsets = {{{-kMove, -kMove, 1, 1},
                                              {0, -kMove, 1, 1},
                                              {kMove, -kMove, 1, 1},
                                              {-kMove, 0, 1, 1},
                                              {kMove, 0, 1, 1},
                                              {-kMove, kMove, 1, 1},
                                              {0, kMove, 1, 1},
                                              {kMove, kMove, 1, 1},
                                              {0, 0, 19, 20},
                                              {0, 0, 21, 20}}};

// The sample that is shown at `place` along one axis: the nearest one there is.
int shown_at(int place, int move, const Offset& offset) {
    // Twice the distance of its middle from that of the picture.
    const int twice = (2 * place + 1 - kSamples) * offset.denominator;
    const int from = (twice + kSamples * offset.numerator) / (2 * offset.numerator);
    return std::clamp(from - move, 0, kSamples - 1);
}

Rgba moved(Rgba& picture, const Offset& offset) {
    Rgba canvas{kSamples,
                std::vector<std::uint8_t>(std::size_t{4} * kSamples * kSamples)};
    for (int y = 0; y < kSamples; ++y) {
        const int from_y = shown_at(y, offset.down, offset);
        for (int x = 0; x < kSamples; ++x) {
            std::copy_n(picture.at(shown_at(x, offset.right, offset), from_y),
                        4,
                        canvas.at(x, y));
        }
    }
    return canvas;
}

// Rounded to the nearest. A bound that only weights of nearly 0 everywhere can reach.
std::int32_t scaled(std::int32_t weight, std::int64_t to, std::int64_t from) {
    return static_cast<std::int32_t>(
        std::min<std::int64_t>((weight * to + from / 2) / from, kMaxWeight));
}

}  // namespace

std::span<const Placement> placements() { return kPlacements; }

std::vector<WindowSignature> window_signatures(const ImageView& picture,
                                               const SignatureKind& kind) {
    std::vector<WindowSignature> windows;
    Rgba small = sampled(picture);
    for (const Placement& placement : kPlacements) {
        if (placement == Placement{}) {
            windows.push_back({placement, make_signature(picture, kind)});
        } else {
            const Rgba canvas = placed(small, placement);
            windows.push_back({placement, make_signature(canvas.view(), kind)});
        }
    }
    return windows;
}

std::vector<Signature> moved_signatures(const ImageView& picture,
                                        const SignatureKind& kind) {
    std::vector<Signature> signatures;
    Rgba small = sampled(picture);
    for (const Offset& offset : kOffsets) {
        signatures.push_back(make_signature(moved(small, offset).view(), kind));
    }
    return signatures;
}

Query with_weight_sum(const Query& query, std::int64_t weight_sum) {
    assert(weight_sum >= 0);
    if (query.weight_sum == 0) return query;
    Query result = query;
    result.weight_sum = 0;
    for (QueryTerm& term : result.terms) {
        term.weight = scaled(term.weight, weight_sum, query.weight_sum);
        result.weight_sum += term.weight;
    }
    for (std::int32_t& weight : result.average_weight) {
        weight = scaled(weight, weight_sum, query.weight_sum);
    }
    result.aspect_weight = scaled(query.aspect_weight, weight_sum, query.weight_sum);
    return result;
}

}  // namespace haarmony::image
