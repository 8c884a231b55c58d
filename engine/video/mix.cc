#include "engine/video/mix.h"

#include <cstddef>

namespace haarmony::video {

Rgba mixed(const std::array<Rgba, 4>& pixels,
           std::uint32_t weight_left,
           std::uint32_t weight_above) {
    constexpr std::uint64_t kOne = std::uint64_t{1} << kWayBits;
    assert(weight_left <= kOne && weight_above <= kOne);
    if (pixels[0] == pixels[1] && pixels[0] == pixels[2] && pixels[0] == pixels[3]) {
        return pixels[0];
    }
    if (pixels[0].a == 255 && pixels[1].a == 255 && pixels[2].a == 255 &&
        pixels[3].a == 255) {  // mean() without a division
        const std::uint64_t right = kOne - weight_left;
        const std::uint64_t below = kOne - weight_above;
        const auto channel = [&](std::uint8_t Rgba::*c) {
            const std::uint64_t above_sum =
                pixels[0].*c * std::uint64_t{weight_left} + pixels[1].*c * right;
            const std::uint64_t below_sum =
                pixels[2].*c * std::uint64_t{weight_left} + pixels[3].*c * right;
            const std::uint64_t sum = above_sum * weight_above + below_sum * below;
            return static_cast<std::uint8_t>((sum + kOne * kOne / 2) >> (2 * kWayBits));
        };
        return {channel(&Rgba::r), channel(&Rgba::g), channel(&Rgba::b), 255};
    }
    PixelSum sum = sum_of(pixels[0], weight_left * std::uint64_t{weight_above});
    sum += sum_of(pixels[1], (kOne - weight_left) * weight_above);
    sum += sum_of(pixels[2], weight_left * (kOne - weight_above));
    sum += sum_of(pixels[3], (kOne - weight_left) * (kOne - weight_above));
    return mean(sum, kOne * kOne);
}

Picture mixed(const Picture& first,
              const Picture& second,
              std::uint32_t weight,
              int bits) {
    assert(first.width == second.width && first.height == second.height);
    Picture result(first.width, first.height);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        result.pixels[i] = mixed(first.pixels[i], second.pixels[i], weight, bits);
    }
    return result;
}

}  // namespace haarmony::video
