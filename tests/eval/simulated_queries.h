// Queries that were never scanned nor painted: stand-ins for the two sets of section 4.5.
//
// They are proxies. A real scan has its own noise, and a real painter gets shapes wrong and
// leaves things out; what holds here need not hold there.
//
// Threads one Random a thread.
// Source  sec. 4.5: "fuzzier, darker, and slightly misregistered"; "painted while looking at
//         thumbnail-sized versions".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ingest/gallery/random.h"
#include "tests/eval/degrade.h"

namespace haarmony::eval {

using gallery::Random;

// A picture with or without transparency.
struct QueryPicture {
    int width = 0;
    int height = 0;
    int channels = 3;  // 3, or 4 with straight alpha
    std::vector<std::uint8_t> pixels;

    [[nodiscard]] ImageView view() const {
        return {pixels.data(),
                width,
                height,
                channels,
                static_cast<std::ptrdiff_t>(width) * channels};
    }
};

[[nodiscard]] QueryPicture opaque(RgbPicture picture);

enum class QueryKind { kScanned, kPainted, kHalfPainted };

// "scanned", "painted" or "half painted".
[[nodiscard]] std::string query_kind_name(QueryKind kind);

// Turned by up to 1.5 degrees, moved by up to 2 % a side, at most 48 pixels long, gamma 1.3
// and 0.85 times as bright, with noise of 2 %.
[[nodiscard]] RgbPicture simulate_scan(const RgbPicture& picture, Random& random);

// `grid` x `grid` flat squares, 1.3 times as vivid, each channel off by up to 6 % and of five
// levels; then all of it moved by up to 3 % a side, so that no edge lies where a wavelet
// changes its sign: a hand does not know where that is. Requires: grid >= 2.
[[nodiscard]] RgbPicture simulate_painting(const RgbPicture& picture,
                                           int grid,
                                           Random& random);

// The same with a grid of 8 to 16.
[[nodiscard]] RgbPicture simulate_painting(const RgbPicture& picture, Random& random);

// The left, right, upper or lower half of it; the other half is transparent.
[[nodiscard]] QueryPicture keep_half(const RgbPicture& painting, Random& random);

// A painting of which one half is kept. Requires: grid is even.
[[nodiscard]] QueryPicture simulate_half_painting(const RgbPicture& picture,
                                                  int grid,
                                                  Random& random);

// A query of that kind: half paintings with a grid of 8, 10, 12, 14 or 16.
[[nodiscard]] QueryPicture simulate(QueryKind kind,
                                    const RgbPicture& picture,
                                    Random& random);

}  // namespace haarmony::eval
