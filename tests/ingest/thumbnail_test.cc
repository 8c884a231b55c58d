#include "ingest/thumbnail.h"

#include <gtest/gtest.h>

#include "ingest/dimensions.h"
#include "ingest/jpeg.h"
#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

ImageView view_of(const Raster& raster) {
    return {raster.pixels.data(),
            raster.width,
            raster.height,
            raster.channels,
            static_cast<std::ptrdiff_t>(raster.row_bytes())};
}

TEST(Thumbnail, LongestSideIs256AndNothingIsEnlarged) {
    struct Case {
        int width, height, thumb_width, thumb_height;
    };
    for (const Case& size : {Case{512, 512, 256, 256},
                             Case{1024, 300, 256, 75},
                             Case{300, 1024, 75, 256},
                             Case{257, 2, 256, 2},
                             Case{10'000, 1, 256, 1},
                             Case{1, 10'000, 1, 256},
                             Case{256, 256, 256, 256},
                             Case{17, 31, 17, 31},
                             Case{1, 1, 1, 1}}) {
        const Raster picture = sample_picture(size.width, size.height, 3);
        const auto thumbnail = make_thumbnail(view_of(picture));
        ASSERT_TRUE(thumbnail) << thumbnail.error().message;
        EXPECT_EQ(jpeg_dimensions(*thumbnail),
                  (Dimensions{size.thumb_width, size.thumb_height}))
            << size.width << " x " << size.height;
    }
}

TEST(Thumbnail, TransparentIsWhiteAndGreyStaysGrey) {
    const Raster clear = flat_picture(300, 300, {200, 10, 10, 0});
    const auto white = make_thumbnail(view_of(clear));
    ASSERT_TRUE(white);
    const auto decoded = decode_jpeg(*white, 1 << 20);
    ASSERT_TRUE(decoded);
    EXPECT_LE(largest_difference(*decoded, flat_picture(256, 256, {255, 255, 255})), 1);

    const auto grey = make_thumbnail(view_of(flat_picture(300, 300, {77})));
    ASSERT_TRUE(grey);
    EXPECT_EQ(decode_jpeg(*grey, 1 << 20)->channels, 1);
}

TEST(Thumbnail, ShowsThePicture) {
    const Raster picture = sample_picture(256, 192, 3);
    const auto thumbnail = make_thumbnail(view_of(picture));
    ASSERT_TRUE(thumbnail);
    const auto decoded = decode_jpeg(*thumbnail, 1 << 20);
    ASSERT_TRUE(decoded);
    // Quality 80 with halved colour: the patch's edge is soft, the rest is close.
    EXPECT_LE(mean_difference(*decoded, picture), 4.0);
}

TEST(EncodeJpeg, HigherQualityIsCloser) {
    const Raster picture = sample_picture(120, 90, 3);
    double before = 256;
    for (const int quality : {5, 40, 95}) {
        const auto file = encode_jpeg(view_of(picture), quality);
        ASSERT_TRUE(file);
        const double difference = mean_difference(*decode_jpeg(*file, 1 << 20), picture);
        EXPECT_LT(difference, before) << quality;
        before = difference;
    }
}

TEST(EncodeJpeg, AlphaIsLaidOverWhiteAtFullSize) {
    const Raster half = flat_picture(40, 30, {0, 0, 0, 128});
    const auto file = encode_jpeg(view_of(half), 100);
    ASSERT_TRUE(file);
    EXPECT_LE(largest_difference(*decode_jpeg(*file, 1 << 20),
                                 flat_picture(40, 30, {127, 127, 127})),
              1);
}

TEST(EncodeJpeg, SidesBeyondWhatTheFormatHoldsAreAnError) {
    const Raster wide = flat_picture(70'000, 1, {9});
    const auto file = encode_jpeg(view_of(wide), 80);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(file.error().message.find("70000 x 1"), std::string::npos);
}

}  // namespace
}  // namespace haarmony::ingest
