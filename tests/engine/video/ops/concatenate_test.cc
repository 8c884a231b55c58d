// One source after the other.
#include "engine/video/ops/concatenate.h"

#include <gtest/gtest.h>

#include "tests/engine/video/ops/source_pictures.h"

namespace haarmony::video {
namespace {

using testing::GreyFrames;

std::vector<std::unique_ptr<FrameSource>> sources(const std::vector<int>& lengths,
                                                  int failing = -1) {
    std::vector<std::unique_ptr<FrameSource>> all;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        all.push_back(std::make_unique<GreyFrames>(
            FrameFormat{5, 3, {10, 1}}, lengths[i], static_cast<int>(i) == failing));
    }
    return all;
}

TEST(Concatenate, GivesOneAfterTheOther) {
    const auto source = concatenate(sources({2, 0, 3}));
    ASSERT_TRUE(source.has_value());
    std::vector<int> shades;
    for (const Picture& picture : testing::pictures_of(**source)) {
        shades.push_back(picture.at(4, 2).r);
    }
    EXPECT_EQ(shades, (std::vector<int>{0, 10, 0, 10, 20}));
    SourceFrame frame;
    const Result<bool> more = (*source)->next(frame);
    ASSERT_TRUE(more.has_value());
    EXPECT_FALSE(*more);
}

TEST(Concatenate, NothingIsRefused) {
    const auto source = concatenate({});
    ASSERT_FALSE(source.has_value());
    EXPECT_EQ(source.error().param, "clips");
}

TEST(Concatenate, AnotherSizeIsRefusedByNumber) {
    auto all = sources({1, 1});
    all.push_back(std::make_unique<GreyFrames>(FrameFormat{5, 4, {10, 1}}, 1, false));
    const auto source = concatenate(std::move(all));
    ASSERT_FALSE(source.has_value());
    EXPECT_EQ(source.error().param, "clips");
    EXPECT_NE(source.error().message.find("clip 2 is 5 x 4"), std::string::npos);
}

TEST(Concatenate, StopsWhereASourceFails) {
    const auto source = concatenate(sources({1, 1, 1}, 1));
    ASSERT_TRUE(source.has_value());
    SourceFrame frame;
    EXPECT_TRUE((*source)->next(frame).has_value());
    EXPECT_TRUE((*source)->next(frame).has_value());
    const Result<bool> more = (*source)->next(frame);
    ASSERT_FALSE(more.has_value());
    EXPECT_EQ(more.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace haarmony::video
