// The few real pictures that millions of synthetic ones are cut from, small and in memory.
//
// Shape   the longest side is kSmallSide at most, both at least 1.
// Errors  kNotFound for a folder that cannot be read or holds no picture.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/executor.h"
#include "engine/core/result.h"
#include "tests/eval/degrade.h"
#include "tests/eval/picture_source.h"

namespace haarmony::eval {

// Half as many cells again as a signature looks at.
inline constexpr int kSmallSide = 192;

struct SmallPhotos {
    std::vector<RgbPicture> pictures;
    std::uint64_t digest = 0;  // of their sizes and pixels
    std::int64_t unreadable = 0;
};

// Those of a source that can be read, in its order.
[[nodiscard]] Result<SmallPhotos> load_small_photos(const PictureSource& source,
                                                    Executor& executor);

// `count` generated ones. Requires: count >= 1.
[[nodiscard]] SmallPhotos paint_small_photos(int count, Executor& executor);

}  // namespace haarmony::eval
