#include "tests/bench/ingest/large_jpeg.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>

#include "ingest/raster.h"
#include "ingest/thumbnail.h"

namespace haarmony::bench {
namespace {

constexpr int kQuality = 90;

// Where result coordinate `at` lies between two source pixels.
struct Between {
    int low = 0;
    int high = 0;
    float share = 0;  // of `high`
};

Between between(int at, int to, int from) {
    const double place =
        std::clamp((at + 0.5) * from / to - 0.5, 0.0, static_cast<double>(from - 1));
    Between result;
    result.low = static_cast<int>(place);
    result.high = std::min(result.low + 1, from - 1);
    result.share = static_cast<float>(place - result.low);
    return result;
}

}  // namespace

std::vector<std::uint8_t> large_jpeg(const ImageView& picture,
                                     double grain,
                                     unsigned seed) {
    assert(picture.channels == 1 || picture.channels == 3);
    const double factor =
        std::sqrt(kLargePixels / (static_cast<double>(picture.width) * picture.height));
    const int width = std::max(1, static_cast<int>(std::lround(picture.width * factor)));
    const int height =
        std::max(1, static_cast<int>(std::lround(picture.height * factor)));
    ingest::Raster large(width, height, picture.channels);
    std::mt19937 random(seed);
    // Drawn once: the grain of a row starts anywhere in it.
    std::normal_distribution<float> normal(0.0F, static_cast<float>(grain));
    std::vector<float> noise(1 << 16);
    if (grain > 0) std::ranges::generate(noise, [&] { return normal(random); });
    const int channels = picture.channels;
    for (int y = 0; y < height; ++y) {
        const Between rows = between(y, height, picture.height);
        const std::uint8_t* const upper = picture.row(rows.low);
        const std::uint8_t* const lower = picture.row(rows.high);
        std::uint8_t* out = large.row(y);
        std::size_t grain_at = random() % noise.size();
        for (int x = 0; x < width; ++x) {
            const Between columns = between(x, width, picture.width);
            for (int c = 0; c < channels; ++c) {
                const auto sample = [&](const std::uint8_t* row) {
                    const float left = row[columns.low * channels + c];
                    const float right = row[columns.high * channels + c];
                    return left + columns.share * (right - left);
                };
                const float value =
                    sample(upper) + rows.share * (sample(lower) - sample(upper));
                grain_at = (grain_at + 1) % noise.size();
                *out++ = static_cast<std::uint8_t>(
                    std::clamp(value + noise[grain_at] + 0.5F, 0.0F, 255.0F));
            }
        }
    }
    const ImageView view = {large.pixels.data(),
                            width,
                            height,
                            channels,
                            static_cast<std::ptrdiff_t>(large.row_bytes())};
    return ingest::encode_jpeg(view, kQuality).value();
}

}  // namespace haarmony::bench
