#include "engine/video/link_clip.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/video/time_sums.h"
#include "tests/engine/video/raw_source.h"

namespace haarmony::video {
namespace {

using testing::complete_tree;
using testing::random_clip;
using testing::RawClip;

// Writes down what it is told.
class RecordingSink final : public ClipSink {
  public:
    [[nodiscard]] Result<void> begin(const ClipShape&, std::uint32_t delta) override {
        calls.push_back("begin " + std::to_string(delta));
        return {};
    }
    [[nodiscard]] Result<void> add(Siblings siblings) override {
        calls.push_back(std::to_string(siblings.address.time_level) + "/" +
                        std::to_string(siblings.address.index) + " " +
                        std::to_string(siblings.nodes.count));
        return {};
    }
    [[nodiscard]] Result<void> finish() override {
        calls.emplace_back("finish");
        return {};
    }
    std::vector<std::string> calls;
};

class LinkClip : public ::testing::Test {
  protected:
    // Frames of 32 x 32 noise, each as often as `repeats` says.
    explicit LinkClip(const std::vector<std::int64_t>& repeats = {1, 1, 2, 1, 1})
        : clip_(random_clip(32, 32, static_cast<int>(repeats.size()), 70)),
          frames_(memory_),
          sums_(clip_.format, frames_) {
        for (std::size_t t = 0; t < repeats.size(); ++t) {
            const ImageTree tree = complete_tree(clip_.frames[t], clip_.format);
            EXPECT_TRUE(sums_.add(tree, repeats[t]).has_value());
        }
        Result<SpooledNodes> nodes = sums_.finish();
        EXPECT_TRUE(nodes.has_value());
        nodes_ = *std::move(nodes);
    }
    Result<void> run(const LinkOptions& options) {
        return link_clip(*ClipShape::make(clip_.format, sums_.frames()),
                         nodes_,
                         frames_,
                         sink_,
                         options);
    }

    RawClip clip_;
    MemorySpool memory_;
    FrameSpool frames_;
    TimeSums sums_;
    SpooledNodes nodes_;
    RecordingSink sink_;
};

TEST_F(LinkClip, ParentsComeBeforeChildrenAndTheFirstHalfBeforeTheSecond) {
    LinkOptions options;
    options.delta = 7;
    std::vector<std::int64_t> told;
    options.written = [&told](std::int64_t nodes) -> Result<void> {
        told.push_back(nodes);
        return {};
    };
    ASSERT_TRUE(run(options).has_value());
    // Six frames; the third and the fourth are one.
    const std::vector<std::string> expected = {
        "begin 7", "0/0 1", "1/0 2", "2/0 2", "3/0 2", "2/1 1", "3/2 2", "finish"};
    EXPECT_EQ(sink_.calls, expected);
    EXPECT_EQ(told, (std::vector<std::int64_t>{1, 3, 5, 7, 8, 10}));
}

TEST_F(LinkClip, ALayerWithMoreThanRefsCanNameIsRefused) {
    LinkOptions options;
    options.max_index = 31;  // two siblings have 16 bricks each at level 5
    EXPECT_TRUE(run(options).has_value());
    sink_.calls.clear();
    options.max_index = 30;
    const Result<void> done = run(options);
    ASSERT_FALSE(done.has_value());
    EXPECT_EQ(done.error().code, ErrorCode::kTooLarge);
    EXPECT_EQ(sink_.calls, (std::vector<std::string>{"begin 0", "0/0 1"}));
}

}  // namespace
}  // namespace haarmony::video
