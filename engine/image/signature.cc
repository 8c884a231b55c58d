#include "engine/image/signature.h"

#include <algorithm>
#include <cassert>
#include <memory>

#include "engine/image/color_planes.h"
#include "engine/image/color_space.h"
#include "engine/image/haar.h"
#include "engine/image/resample.h"
#include "engine/image/truncation.h"

namespace haarmony::image {

std::span<const std::int16_t> ChannelSignature::largest(int m) const {
    assert(m >= 0);
    return std::span(indices).first(std::size_t(std::min<int>(m, count)));
}

bool operator==(const ChannelSignature& a, const ChannelSignature& b) {
    return a.average == b.average &&
           std::ranges::equal(a.largest(kMaxCoefficients), b.largest(kMaxCoefficients));
}

Signature make_signature(const ImageView& picture) {
    static_assert(kSide <= kMaxSide);
    const auto planes = std::make_unique<ColorPlanes>();
    area_average(picture, *planes);
    rgb_to_yiq(*planes);

    Signature signature;
    double energy = 0.0;
    for (int c = 0; c < kChannels; ++c) {
        Plane& plane = (*planes)[c];
        decompose(plane, kSide);
        energy += wavelet_energy(plane);
        signature.channels[c] = truncate(plane);
    }
    signature.low_information = energy < kLowInformationEnergy;
    return signature;
}

}  // namespace haarmony::image
