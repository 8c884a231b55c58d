#include "engine/image/signature.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <optional>

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

namespace {

void decompose_all(ColorPlanes& planes, Decomposition decomposition) {
    static_assert(kSide <= kMaxSide);
    for (Plane& plane : planes) decompose(plane, kSide, decomposition);
}

Signature truncate_all(const ColorPlanes& coefficients, const SignatureKind& kind) {
    Signature signature;
    signature.kind = kind;
    for (int c = 0; c < kChannels; ++c) {
        signature.channels[c] = truncate(coefficients[c]);
    }
    return signature;
}

std::vector<Signature> signatures_of_cells(const ColorPlanes& rgb,
                                           std::span<const SignatureKind> kinds) {
    constexpr SignatureKind kMeasured;
    const auto measured = std::make_unique<ColorPlanes>(rgb);
    convert(kMeasured.color_space, *measured);
    decompose_all(*measured, kMeasured.decomposition);
    double energy = 0.0;
    for (const Plane& plane : *measured) energy += wavelet_energy(plane);

    const auto converted = std::make_unique_for_overwrite<ColorPlanes>();
    const auto coefficients = std::make_unique_for_overwrite<ColorPlanes>();
    std::optional<ColorSpace> space;
    std::vector<Signature> signatures;
    for (const SignatureKind& kind : kinds) {
        if (kind == kMeasured) {
            signatures.push_back(truncate_all(*measured, kind));
            continue;
        }
        if (space != kind.color_space) {
            *converted = rgb;
            convert(kind.color_space, *converted);
            space = kind.color_space;
        }
        *coefficients = *converted;
        decompose_all(*coefficients, kind.decomposition);
        signatures.push_back(truncate_all(*coefficients, kind));
    }
    for (Signature& signature : signatures) {
        signature.low_information = energy < kLowInformationEnergy;
    }
    return signatures;
}

}  // namespace

Signature make_signature(const ImageView& picture, const SignatureKind& kind) {
    return make_signatures(picture, {&kind, 1}).front();
}

Signature make_signature(const ImageView& picture) {
    return make_signature(picture, SignatureKind{});
}

std::vector<Signature> make_signatures(const ImageView& picture,
                                       std::span<const SignatureKind> kinds) {
    const auto rgb = std::make_unique_for_overwrite<ColorPlanes>();
    area_average(picture, *rgb);
    return signatures_of_cells(*rgb, kinds);
}

}  // namespace haarmony::image
