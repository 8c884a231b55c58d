#include "engine/image/color_space.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "engine/image/cie.h"

namespace haarmony::image {
namespace {

struct Channel {
    std::string_view name;
    ChannelRange range;
};

using Channels = std::array<Channel, kChannels>;

// The ends of Lab and Luv, to six places: a* at green and magenta, b* at blue and yellow, u* at
// green and red, v* between blue and magenta and at green.
constexpr Channels kYiq = {
    {{"Y", {0, 1}}, {"I", {-kMaxI, kMaxI}}, {"Q", {-kMaxQ, kMaxQ}}}};
constexpr Channels kRgb = {{{"R", {0, 1}}, {"G", {0, 1}}, {"B", {0, 1}}}};
constexpr Channels kHsv = {{{"V", {0, 1}}, {"S cos H", {-1, 1}}, {"S sin H", {-1, 1}}}};
constexpr Channels kLab = {
    {{"L*", {0, 1}}, {"a*", {-0.861884, 0.982497}}, {"b*", {-1.078537, 0.944877}}}};
constexpr Channels kLuv = {
    {{"L*", {0, 1}}, {"u*", {-0.830805, 1.750526}}, {"v*", {-1.341094, 1.074164}}}};

const Channel& channel_of(ColorSpace space, int channel) {
    assert(channel >= 0 && channel < kChannels);
    switch (space) {
        case ColorSpace::kYiq:
            break;
        case ColorSpace::kRgb:
            return kRgb[channel];
        case ColorSpace::kHsv:
            return kHsv[channel];
        case ColorSpace::kLab:
            return kLab[channel];
        case ColorSpace::kLuv:
            return kLuv[channel];
    }
    return kYiq[channel];
}

struct Direction {
    float cosine;
    float sine;
};

// Of the angle sixth * 60 degrees. Requires: -1 <= sixth <= 1. The series end where their next
// term is below 4e-9; the library's sine may differ between machines, and signatures may not.
Direction direction(float sixth) {
    constexpr float kSixthTurn = 1.04719755F;
    const float angle = kSixthTurn * sixth;
    const float square = angle * angle;
    float cosine = -1.0F / 3628800;
    for (const float inverse : {1.0F / 40320, -1.0F / 720, 1.0F / 24, -0.5F, 1.0F}) {
        cosine = cosine * square + inverse;
    }
    float sine = -1.0F / 39916800;
    for (const float inverse :
         {1.0F / 362880, -1.0F / 5040, 1.0F / 120, -1.0F / 6, 1.0F}) {
        sine = sine * square + inverse;
    }
    return {cosine, sine * angle};
}

}  // namespace

ChannelRange channel_range(ColorSpace space, int channel) {
    return channel_of(space, channel).range;
}

std::string_view channel_name(ColorSpace space, int channel) {
    return channel_of(space, channel).name;
}

void convert(ColorSpace space, ColorPlanes& planes) {
    switch (space) {
        case ColorSpace::kYiq:
            return rgb_to_yiq(planes);
        case ColorSpace::kRgb:
            return;
        case ColorSpace::kHsv:
            return rgb_to_hsv(planes);
        case ColorSpace::kLab:
            return rgb_to_lab(planes);
        case ColorSpace::kLuv:
            return rgb_to_luv(planes);
    }
}

//   Y = 0.299000 R + 0.587000 G + 0.114000 B
//   I = 0.595716 R - 0.274453 G - 0.321263 B
//   Q = 0.211456 R - 0.522591 G + 0.311135 B
// The rows add up to 1, 0 and 0, which is what lets G be taken out of each.
void rgb_to_yiq(ColorPlanes& planes) {
    float* const first = planes[0].data();
    float* const second = planes[1].data();
    float* const third = planes[2].data();
    for (int i = 0; i < kCoefficientCount; ++i) {
        const float green = second[i];
        const float red = first[i] - green;
        const float blue = third[i] - green;
        first[i] = green + (0.299F * red + 0.114F * blue);
        second[i] = 0.595716F * red - 0.321263F * blue;
        third[i] = 0.211456F * red + 0.311135F * blue;
    }
}

// With V the largest and C = V - the smallest: S = C / V, and H is at most a sixth of a turn
// away from the largest primary, which is red at 0, green at 120 and blue at 240 degrees.
void rgb_to_hsv(ColorPlanes& planes) {
    constexpr float kHalfRootOf3 = 0.866025404F;
    for (int i = 0; i < kCoefficientCount; ++i) {
        const float red = planes[0][i];
        const float green = planes[1][i];
        const float blue = planes[2][i];
        const float value = std::max({red, green, blue});
        const float chroma = value - std::min({red, green, blue});
        planes[0][i] = value;
        planes[1][i] = 0.0F;
        planes[2][i] = 0.0F;
        if (chroma <= 0.0F) continue;

        const bool is_red = value == red;
        const bool is_green = !is_red && value == green;
        const float ahead = is_red ? green - blue : is_green ? blue - red : red - green;
        const Direction hue = direction(ahead / chroma);
        const float cosine = is_red ? 1.0F : -0.5F;
        const float sine = is_red ? 0.0F : is_green ? kHalfRootOf3 : -kHalfRootOf3;
        const float saturation = chroma / value;
        planes[1][i] = saturation * (hue.cosine * cosine - hue.sine * sine);
        planes[2][i] = saturation * (hue.sine * cosine + hue.cosine * sine);
    }
}

}  // namespace haarmony::image
