#include "engine/video/frame_spool.h"

#include <gtest/gtest.h>

#include "tests/engine/video/faulty_spool.h"
#include "tests/engine/video/plain_frame.h"

namespace haarmony::video {
namespace {

using testing::exact_frame;
using testing::FaultySpool;
using testing::random_clip;

TEST(FrameSpool, GivesBackEveryFrame) {
    const auto clip = random_clip(37, 23, 4, 1);
    MemorySpool spool;
    FrameSpool frames(spool);
    std::vector<ExactFrame> put;
    std::vector<SpooledFrame> where;
    for (const NodeAddress at : {NodeAddress{0, 0}, {1, 1}, {2, 0}, {2, 3}}) {
        put.push_back(exact_frame(clip, at));
        const Result<SpooledFrame> spooled = frames.put(put.back());
        ASSERT_TRUE(spooled.has_value());
        where.push_back(*spooled);
    }
    ExactFrame got;
    for (std::size_t i = put.size(); i-- > 0;) {
        ASSERT_TRUE(frames.get(where[i], got).has_value());
        EXPECT_EQ(got, put[i]);
    }
}

TEST(FrameSpool, EveryChangedByteIsNoticed) {
    FaultySpool spool;
    FrameSpool frames(spool);
    const ExactFrame frame = exact_frame(random_clip(8, 8, 1, 2), {0, 0});
    const Result<SpooledFrame> where = frames.put(frame);
    ASSERT_TRUE(where.has_value());
    ExactFrame got;
    ASSERT_GT(spool.size(), sizeof(Brick) + sizeof(TreeNode));
    for (std::uint64_t byte = 0; byte < spool.size(); ++byte) {
        spool.flip(byte);
        const Result<void> read = frames.get(*where, got);
        ASSERT_FALSE(read.has_value()) << byte;
        EXPECT_EQ(read.error().code, ErrorCode::kIo);
        spool.flip(byte);
    }
    EXPECT_TRUE(frames.get(*where, got).has_value());
    EXPECT_EQ(got, frame);
}

TEST(FrameSpool, PassesOnWhatTheSpoolMeetsAtEveryCall) {
    const ExactFrame frame = exact_frame(random_clip(8, 8, 1, 3), {0, 0});
    const auto run = [&frame](FaultySpool& spool) -> Result<void> {
        FrameSpool frames(spool);
        const Result<SpooledFrame> where = frames.put(frame);
        if (!where) return where.error();
        ExactFrame got;
        return frames.get(*where, got);
    };
    testing::expect_failures_passed_on(6, run);
}

}  // namespace
}  // namespace haarmony::video
