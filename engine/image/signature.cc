#include "engine/image/signature.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <optional>

#include "engine/image/color_planes.h"
#include "engine/image/color_space.h"
#include "engine/image/haar.h"
#include "engine/image/mask.h"
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

// The kind that the wavelet energy is measured in, wanted or not.
constexpr SignatureKind kMeasured;

// A channel's signature from its coefficients. `cover`: see area_average(), may be null.
ChannelSignature truncate_painted(const Plane* cover,
                                  Decomposition decomposition,
                                  Plane& coefficients) {
    if (cover == nullptr) return truncate(coefficients);
    weigh_by_cover(*cover, decomposition, coefficients);
    ChannelSignature channel = truncate(coefficients);
    channel.count = static_cast<std::uint8_t>(
        std::min<int>(channel.count, kept_coefficients(*cover)));
    return channel;
}

// Makes signatures of other kinds from the cells of one picture, a plane at a time.
class FromCells {
  public:
    FromCells(const ColorPlanes& rgb, const Plane* cover)
        : rgb_(rgb),
          cover_(cover),
          converted_(std::make_unique_for_overwrite<ColorPlanes>()),
          plane_(std::make_unique_for_overwrite<Plane>()) {}

    Signature make(const SignatureKind& kind) {
        if (space_ != kind.color_space) {
            *converted_ = rgb_;
            convert(kind.color_space, *converted_);
            space_ = kind.color_space;
        }
        Signature signature;
        signature.kind = kind;
        for (int c = 0; c < kChannels; ++c) {
            *plane_ = (*converted_)[c];
            decompose(*plane_, kSide, kind.decomposition);
            signature.channels[c] = truncate_painted(cover_, kind.decomposition, *plane_);
        }
        return signature;
    }

  private:
    const ColorPlanes& rgb_;
    const Plane* cover_;
    std::unique_ptr<ColorPlanes> converted_;
    std::unique_ptr<Plane> plane_;
    std::optional<ColorSpace> space_;  // of converted_
};

// The signature of kind kMeasured, made in place, and whether there is information.
Signature measure(ColorPlanes& planes, const Plane* cover) {
    Signature signature;
    signature.kind = kMeasured;
    convert(kMeasured.color_space, planes);
    double energy = 0.0;
    for (int c = 0; c < kChannels; ++c) {
        decompose(planes[c], kSide, kMeasured.decomposition);
        energy += wavelet_energy(planes[c]);
        signature.channels[c] =
            truncate_painted(cover, kMeasured.decomposition, planes[c]);
    }
    signature.low_information = energy < kLowInformationEnergy;
    return signature;
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
    static_assert(kSide <= kMaxSide);
    const auto planes = std::make_unique_for_overwrite<ColorPlanes>();
    const std::unique_ptr<const Plane> cover = area_average(picture, *planes);

    std::vector<Signature> signatures(kinds.size());
    std::optional<FromCells> cells;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == kMeasured) continue;
        if (!cells) cells.emplace(*planes, cover.get());
        signatures[i] = cells->make(kinds[i]);
    }
    const Signature measured = measure(*planes, cover.get());
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == kMeasured) signatures[i] = measured;
        signatures[i].low_information = measured.low_information;
    }
    return signatures;
}

}  // namespace haarmony::image
