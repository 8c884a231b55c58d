#include "tests/eval/packed_signature.h"

#include <algorithm>
#include <cassert>

namespace haarmony::eval {

std::span<const std::int16_t> PackedSignature::largest(int channel, int m) const {
    assert(m >= 0);
    const auto kept = static_cast<std::size_t>(std::min<int>(m, count[channel]));
    return std::span(indices[channel]).first(kept);
}

PackedSignature pack(const image::Signature& signature) {
    assert(signature.kind == image::SignatureKind{});
    PackedSignature packed;
    packed.low_information = signature.low_information ? 1 : 0;
    for (int c = 0; c < image::kChannels; ++c) {
        const auto kept = signature.channels[c].largest(kPackedCoefficients);
        packed.average[c] = signature.channels[c].average;
        packed.count[c] = static_cast<std::uint8_t>(kept.size());
        std::ranges::copy(kept, packed.indices[c].begin());
    }
    return packed;
}

image::Signature unpack(const PackedSignature& packed) {
    image::Signature signature;
    signature.low_information = packed.low_information != 0;
    for (int c = 0; c < image::kChannels; ++c) {
        image::ChannelSignature& channel = signature.channels[c];
        channel.average = packed.average[c];
        channel.count = packed.count[c];
        std::ranges::copy(packed.largest(c, kPackedCoefficients),
                          channel.indices.begin());
    }
    return signature;
}

}  // namespace haarmony::eval
