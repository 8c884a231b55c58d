#include "server/app/query_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/image/aspect.h"
#include "engine/image/window.h"
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
    return look_at(picture.view(), picture.width, picture.height, look)
        .signatures.at({})
        .front();
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
        EXPECT_EQ(found.signatures.at(kind),
                  std::vector{image::make_signature(picture.view(), kind)});
    EXPECT_EQ(found.log_aspect, image::log_aspect(400, 300));
}

// White margins of a fifth of the width on both sides.
TEST(QueryPicture, AutocropLooksWithinTheBorders) {
    const image::Pixels content = image::scene(60, 40, 3);
    image::Pixels framed = image::flat(100, 40, {255, 255, 255});
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 60; ++x)
            for (int channel = 0; channel < 3; ++channel)
                framed.at(20 + x, y, channel) = content.at(x, y, channel);
    LookOptions look;
    look.autocrop = true;
    const QueryPicture found = look_at(framed.view(), 1000, 400, look);
    EXPECT_EQ(found.signatures.at({}),
              std::vector{image::make_signature(content.view())});
    EXPECT_EQ(found.log_aspect, image::log_aspect(600, 400));
    EXPECT_EQ(look_at(content.view(), 60, 40, look).signatures.at({}),
              found.signatures.at({}));
}

TEST(QueryPicture, APartIsTriedAtEveryWindow) {
    const image::Pixels picture = image::scene(60, 40, 3);
    LookOptions look;
    look.partial = true;
    look.kinds = {{}, {image::ColorSpace::kRgb, image::Decomposition::kNonstandard}};
    const QueryPicture found = look_at(picture.view(), 60, 40, look);
    for (const image::SignatureKind& kind : look.kinds) {
        const auto expected = image::window_signatures(picture.view(), kind);
        const std::vector<image::Signature>& windows = found.signatures.at(kind);
        ASSERT_EQ(windows.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_EQ(windows[i], expected[i].signature);
    }
}

}  // namespace
}  // namespace haarmony::server
