#include "server/app/query_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/image/aspect.h"
#include "tests/engine/image/all_kinds.h"
#include "tests/engine/image/pictures.h"

namespace haarmony::server {
namespace {

// A scene whose left half is opaque; the rest fades out.
image::Pixels half_transparent() {
    image::Pixels pixels = image::noise(64, 48, 4, 5);
    for (int y = 0; y < pixels.height; ++y)
        for (int x = 0; x < pixels.width; ++x)
            pixels.at(x, y, 3) = static_cast<std::uint8_t>(x < 32 ? 255 : 255 - 4 * x);
    return pixels;
}

// By the definition of compositing over black, in floating point.
image::Pixels over_black(const image::Pixels& picture) {
    image::Pixels opaque = image::flat(picture.width, picture.height, {0, 0, 0});
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                opaque.at(x, y, channel) = static_cast<std::uint8_t>(std::floor(
                    picture.at(x, y, channel) * (picture.at(x, y, 3) / 255.0) + 0.5));
    return opaque;
}

image::Signature signature_of(const image::Pixels& picture, Mask mask) {
    LookOptions look;
    look.mask = mask;
    return look_at(picture.view(), picture.width, picture.height, look).signatures.at({});
}

TEST(QueryPicture, MaskNoneCountsTransparencyAsBlack) {
    const image::Pixels picture = half_transparent();
    EXPECT_EQ(signature_of(picture, Mask::kNone),
              image::make_signature(over_black(picture).view()));
}

TEST(QueryPicture, MaskAlphaIsTheRuleOfIngest) {
    const image::Pixels picture = half_transparent();
    EXPECT_EQ(signature_of(picture, Mask::kAlpha), image::make_signature(picture.view()));
    EXPECT_NE(signature_of(picture, Mask::kAlpha), signature_of(picture, Mask::kNone));
}

TEST(QueryPicture, MaskMakesNoDifferenceToAnOpaquePicture) {
    const image::Pixels picture = image::scene(40, 30, 3);
    EXPECT_EQ(signature_of(picture, Mask::kAlpha), signature_of(picture, Mask::kNone));
}

TEST(QueryPicture, HasASignatureOfEachKindAndItsShape) {
    const image::Pixels picture = image::scene(40, 30, 3);
    LookOptions look;
    look.kinds = image::all_kinds();
    const QueryPicture found = look_at(picture.view(), 400, 300, look);
    ASSERT_EQ(found.signatures.size(), look.kinds.size());
    for (const image::SignatureKind& kind : look.kinds)
        EXPECT_EQ(found.signatures.at(kind), image::make_signature(picture.view(), kind));
    EXPECT_EQ(found.log_aspect, image::log_aspect(400, 300));
}

}  // namespace
}  // namespace haarmony::server
