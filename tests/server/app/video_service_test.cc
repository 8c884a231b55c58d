// Which clips are open, and how much of them is decoded.
#include "server/app/video_service.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/video/mrv_clip.h"
#include "tests/engine/video/random_links.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::server {
namespace {

using Clip = std::shared_ptr<const OpenVideo>;

constexpr std::size_t kPlenty = std::size_t{1} << 30;

class VideoServiceTest : public testing::Test {
  protected:
    void open(std::size_t layer_cache_bytes, std::size_t open_clips) {
        VideoServiceOptions options;
        options.database_path = folder_.file("x.db");
        options.layer_cache_bytes = layer_cache_bytes;
        options.open_clips = open_clips;
        service_.reset();
        auto opened = VideoService::open(options);
        ASSERT_TRUE(opened) << opened.error().message;
        service_ = std::move(opened).value();
    }
    // Another seed, another clip.
    std::int64_t add(std::uint32_t seed) {
        const auto bytes =
            video::testing::mrv_bytes(video::testing::linked_clip(40, 30, 6, seed));
        const std::string built = folder_.file("built");
        schema::write_bytes(built,
                            {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        schema::Video row;
        row.revision = "00000000deadbeef";
        row.width = 40;
        row.height = 30;
        row.frames = 6;
        const auto added = service_->add(built, row, {});
        EXPECT_TRUE(added) << added.error().message;
        return added ? added->id : 0;
    }
    Clip clip(std::int64_t id) {
        auto found = service_->clip(id);
        EXPECT_TRUE(found) << found.error().message;
        return found ? *found : nullptr;
    }
    static void show_all(const Clip& shown) {
        const video::TimeTree& clip = shown->clip();
        for (std::int64_t t = 0; t < clip.shape().frames(); ++t)
            EXPECT_TRUE(
                clip.frame({clip.shape().time_levels(), t}, clip.shape().space_levels())
                    .has_value());
    }
    static std::uint64_t decoded_chunks(const Clip& shown) {
        return dynamic_cast<const video::MrvClip&>(shown->clip()).decoded_chunks();
    }

    schema::ScratchFolder folder_;
    std::unique_ptr<VideoService> service_;
};

TEST_F(VideoServiceTest, WhatHasBeenShownIsNotDecodedAgainWhileThereIsRoom) {
    open(kPlenty, 4);
    const std::int64_t one = add(1);
    const std::int64_t two = add(2);
    show_all(clip(one));
    show_all(clip(two));
    const std::uint64_t chunks = decoded_chunks(clip(one));
    EXPECT_GT(chunks, 0U);
    show_all(clip(one));
    EXPECT_EQ(decoded_chunks(clip(one)), chunks);
}

TEST_F(VideoServiceTest, TheLayersOfAllClipsTogetherStayWithinTheirBytes) {
    open(kPlenty, 4);
    const std::vector<std::int64_t> ids{add(1), add(2), add(3)};
    show_all(clip(ids[0]));
    const std::size_t whole = service_->layer_bytes();
    ASSERT_GT(whole, 0U);

    // A clip that is larger than all the room is shown all the same.
    for (const std::size_t room : {whole / 3, whole, 2 * whole}) {
        open(room, 4);
        for (int round = 0; round < 2; ++round)
            for (const std::int64_t id : ids) {
                show_all(clip(id));
                EXPECT_LE(service_->layer_bytes(), room);
            }
        EXPECT_GT(service_->layer_bytes(), 0U);
    }
}

TEST_F(VideoServiceTest, TheClipThatWasLongestUnusedIsClosedAndItsLayersGo) {
    open(kPlenty, 2);
    const std::vector<std::int64_t> ids{add(1), add(2), add(3)};
    std::vector<std::weak_ptr<const OpenVideo>> held;
    for (const int i : {0, 1}) {
        show_all(clip(ids[static_cast<std::size_t>(i)]));
        held.push_back(clip(ids[static_cast<std::size_t>(i)]));
    }
    const std::size_t two = service_->layer_bytes();
    (void)clip(ids[0]);
    (void)clip(ids[2]);
    EXPECT_FALSE(held[0].expired());
    EXPECT_TRUE(held[1].expired());
    EXPECT_LT(service_->layer_bytes(), two);
    // It is opened again.
    show_all(clip(ids[1]));
    EXPECT_TRUE(held[0].expired());
}

TEST_F(VideoServiceTest, AClipThatIsRemovedIsReadableForWhoHasItAndKeptForNobody) {
    open(kPlenty, 2);
    const std::int64_t id = add(1);
    Clip shown = clip(id);
    ASSERT_TRUE(service_->remove(id));
    show_all(shown);
    EXPECT_EQ(service_->clip(id).error().code, ErrorCode::kNotFound);
    EXPECT_GT(service_->layer_bytes(), 0U);
    shown.reset();
    EXPECT_EQ(service_->layer_bytes(), 0U);
}

}  // namespace
}  // namespace haarmony::server
