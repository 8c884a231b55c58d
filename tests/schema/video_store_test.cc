#include "schema/video_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

Result<void> agree(const Video&) { return {}; }

class Videos : public testing::Test {
  protected:
    [[nodiscard]] static Video video(const std::string& name) {
        Video made;
        made.revision = "00000000deadbeef";
        made.name = name;
        made.width = 100;
        made.height = 60;
        made.frames = 13;
        made.rate_numerator = 30'000;
        made.rate_denominator = 1'001;
        made.delta = 0.1;
        made.storage = {27, 6, 5, 4, 3, 1'000'000'000'000, 1};
        return made;
    }
    [[nodiscard]] static FrameSignature frame(std::int64_t node, std::uint8_t byte) {
        return {0, 0, 4, node, 1, {byte, 0, byte}};
    }
    Video add(const Video& made, const std::vector<FrameSignature>& frames = {}) {
        return expect(store_.add(made, frames, agree));
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    VideoStore store_{database_};
};

TEST_F(Videos, ComeBackAsTheyWereStored) {
    Video want = video("a clip \xC3\xA9");
    want.indexed = true;
    want.job = 5;
    const Video added = add(want);
    const Video found = expect(store_.get(added.id));
    EXPECT_EQ(found.id, 1);
    EXPECT_EQ(found.revision, want.revision);
    EXPECT_EQ(found.name, want.name);
    EXPECT_EQ(found.width, 100);
    EXPECT_EQ(found.height, 60);
    EXPECT_EQ(found.frames, 13);
    EXPECT_EQ(found.rate_numerator, 30'000);
    EXPECT_EQ(found.rate_denominator, 1'001);
    EXPECT_EQ(found.delta, 0.1);
    EXPECT_EQ(found.storage, want.storage);
    EXPECT_TRUE(found.indexed);
    EXPECT_EQ(found.job, 5);
    EXPECT_EQ(found.created_at.size(), std::string("2000-01-01T00:00:00.000Z").size());
    EXPECT_EQ(added.created_at, found.created_at);
}

TEST_F(Videos, AJobFindsTheOneThatItMadeAndMakesNoOther) {
    EXPECT_FALSE(expect(store_.made_by(5)).has_value());
    Video made = video("a");
    add(made);
    made.job = 5;
    const Video added = add(made);
    EXPECT_EQ(expect(store_.made_by(5))->id, added.id);
    EXPECT_FALSE(expect(store_.get(1)).job.has_value());
    EXPECT_FALSE(store_.add(made, {}, agree));
    EXPECT_EQ(expect(store_.count()), 2);
}

// Of a clip of three frames, T = 2: the root, (0, 1), (2), and the two halves of (0, 1).
std::vector<FrameSignature> three_frames() {
    std::vector<FrameSignature> frames;
    for (const auto& [level, node] : std::vector<std::pair<int, std::int64_t>>{
             {0, 0}, {1, 0}, {1, 1}, {2, 0}, {2, 1}})
        frames.push_back(
            {0, 0, level, node, 7, {static_cast<std::uint8_t>(10 * level + node)}});
    return frames;
}

TEST_F(Videos, ThatGrowKeepTheSignaturesBelowWhatWasComplete) {
    Video three = video("a");
    three.frames = 3;
    three.job = 4;
    GrownVideo grown;
    grown.before = add(three, three_frames());
    const Video other = add(video("b"), {frame(0, 9)});
    grown.now = grown.before;
    grown.now.revision = "0123456789abcdef";
    grown.now.frames = 5;
    grown.now.storage = {1, 2, 3, 4, 5, 6, 7};
    grown.now.job = 8;
    grown.time_levels_before = 2;
    grown.time_levels = 3;
    std::string heard;
    const Video stored =
        expect(store_.grow(grown, std::vector{frame(3, 8)}, [&](const Video& row) {
            heard = row.revision;
            return Result<void>();
        }));
    EXPECT_EQ(heard, "0123456789abcdef");
    EXPECT_EQ(stored.id, grown.before.id);
    EXPECT_EQ(stored.name, "a");
    EXPECT_EQ(stored.created_at, grown.before.created_at);
    const Video found = expect(store_.get(stored.id));
    EXPECT_EQ(found.revision, "0123456789abcdef");
    EXPECT_EQ(found.frames, 5);
    EXPECT_EQ(found.storage, grown.now.storage);
    EXPECT_EQ(expect(store_.made_by(8))->id, stored.id);
    EXPECT_FALSE(expect(store_.made_by(4)).has_value());
    // The halves of (0, 1), one time level deeper, behind all that there was, and the new one.
    const auto rows = expect(store_.frames_after(0, 100));
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0].video, other.id);
    std::vector<std::pair<int, std::int64_t>> places;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].video, stored.id);
        EXPECT_GT(rows[i].id, rows[0].id);
        places.emplace_back(rows[i].time_level, rows[i].node);
    }
    EXPECT_EQ(places,
              (std::vector<std::pair<int, std::int64_t>>{{3, 0}, {3, 1}, {4, 3}}));
    EXPECT_EQ(rows[1].signature, std::vector<std::uint8_t>{20});
    EXPECT_EQ(rows[1].shot, 7);
    const auto ids = expect(store_.frame_ids());
    ASSERT_EQ(ids.size(), 4U);
    for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(ids[i], rows[i].id);
    EXPECT_TRUE(expect(store_.has_frame(ids[0])));
    EXPECT_FALSE(expect(store_.has_frame(1)));
}

TEST_F(Videos, ThatHaveChangedOrAreGoneDoNotGrow) {
    GrownVideo grown;
    grown.before = add(video("a"), {frame(0, 1)});
    grown.now = grown.before;
    grown.now.revision = "0123456789abcdef";
    GrownVideo other = grown;
    other.before.revision = "ffffffffffffffff";
    auto refused = store_.grow(other, {}, agree);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
    EXPECT_THAT(refused.error().message, HasSubstr("of revision ffffffffffffffff"));
    refused = store_.grow(grown, {}, [](const Video&) -> Result<void> {
        return Error{ErrorCode::kIo, "the disk is full"};
    });
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("the disk is full"));
    EXPECT_EQ(expect(store_.get(1)).revision, grown.before.revision);
    EXPECT_EQ(expect(store_.frames_after(0, 9)).size(), 1U);
    expect(store_.remove(1));
    refused = store_.grow(grown, {}, agree);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
}

TEST_F(Videos, AreListedInPages) {
    for (const char* name : {"a", "b", "c"}) add(video(name));
    const auto page = expect(store_.list(2, 0));
    ASSERT_EQ(page.size(), 2u);
    EXPECT_EQ(page[0].name, "a");
    EXPECT_EQ(page[1].name, "b");
    const auto rest = expect(store_.list(2, page[1].id));
    ASSERT_EQ(rest.size(), 1u);
    EXPECT_EQ(rest[0].name, "c");
}

TEST_F(Videos, AStepThatRefusesLeavesNothingOfTheRowItHeardOf) {
    std::int64_t heard = 0;
    const auto added = store_.add(
        video("a"), std::vector{frame(0, 1)}, [&](const Video& stored) -> Result<void> {
            heard = stored.id;
            return Error{ErrorCode::kIo, "the disk is full"};
        });
    ASSERT_FALSE(added);
    EXPECT_THAT(added.error().message, HasSubstr("the disk is full"));
    EXPECT_EQ(heard, 1);
    EXPECT_EQ(expect(store_.count()), 0);
    EXPECT_EQ(expect(store_.frames_version()), (FramesVersion{0, 0}));
}

TEST_F(Videos, AreGoneWithTheirFramesAndTheirNumbersAreNotUsedAgain) {
    add(video("a"), {frame(0, 1), frame(1, 2)});
    add(video("b"), {frame(0, 3)});
    EXPECT_EQ(expect(store_.remove(2)).name, "b");
    EXPECT_EQ(expect(store_.frames_version()), (FramesVersion{2, 2}));
    EXPECT_EQ(add(video("c"), {frame(0, 4)}).id, 3);
    const auto frames = expect(store_.frames_after(0, 9));
    ASSERT_EQ(frames.size(), 3u);
    EXPECT_EQ(frames.back().id, 4);
    for (const auto& gone : {store_.get(2), store_.remove(2)}) {
        ASSERT_FALSE(gone);
        EXPECT_EQ(gone.error().code, ErrorCode::kNotFound);
        EXPECT_THAT(gone.error().message, HasSubstr("video 2"));
    }
}

TEST_F(Videos, FramesAreReadInPagesWithWhatWasStored) {
    add(video("a"), {frame(7, 1), frame(9, 2)});
    const auto first = expect(store_.frames_after(0, 1));
    ASSERT_EQ(first.size(), 1u);
    EXPECT_EQ(first[0].video, 1);
    EXPECT_EQ(first[0].time_level, 4);
    EXPECT_EQ(first[0].node, 7);
    EXPECT_EQ(first[0].shot, 1);
    EXPECT_EQ(first[0].signature, (std::vector<std::uint8_t>{1, 0, 1}));
    const auto second = expect(store_.frames_after(first[0].id, 9));
    ASSERT_EQ(second.size(), 1u);
    EXPECT_EQ(second[0].node, 9);
    EXPECT_THAT(expect(store_.frames_after(second[0].id, 9)), IsEmpty());
}

TEST_F(Videos, ThatTheTableRefusesAreNotStored) {
    using Change = std::function<void(Video&)>;
    const std::pair<const char*, Change> changes[] = {
        {"short revision", [](Video& v) { v.revision = "12"; }},
        {"revision of other letters", [](Video& v) { v.revision = "00000000DEADBEEF"; }},
        {"long name", [](Video& v) { v.name.assign(257, 'x'); }},
        {"no width", [](Video& v) { v.width = 0; }},
        {"no height", [](Video& v) { v.height = -1; }},
        {"no frames", [](Video& v) { v.frames = 0; }},
        {"no rate", [](Video& v) { v.rate_numerator = 0; }},
        {"rate by nothing", [](Video& v) { v.rate_denominator = 0; }},
        {"negative delta", [](Video& v) { v.delta = -0.5; }},
        {"negative count", [](Video& v) { v.storage.uplinks = -1; }}};
    for (const auto& [name, change] : changes) {
        Video bad = video("a");
        change(bad);
        const auto added = store_.add(bad, {}, agree);
        ASSERT_FALSE(added) << name;
        EXPECT_EQ(added.error().code, ErrorCode::kInvalidArgument) << name;
    }
    const std::vector<FrameSignature> twice{frame(0, 1), frame(0, 2)};
    EXPECT_FALSE(store_.add(video("a"), twice, agree));
    FrameSignature empty = frame(0, 1);
    empty.signature.clear();
    EXPECT_FALSE(store_.add(video("a"), std::vector{empty}, agree));
    EXPECT_EQ(expect(store_.count()), 0);
}

TEST_F(Videos, NobodyWritesWhileAllAreLookedThrough) {
    add(video("a"));
    Database other = open_database(folder_.file("x.db"));
    run_sql(other.handle(), "PRAGMA busy_timeout = 0");
    VideoStore beside(other);
    std::vector<std::string> seen;
    expect(store_.while_nobody_writes([&](const std::vector<Video>& all) {
        for (const Video& one : all) seen.push_back(one.name);
        const auto added = beside.add(video("b"), {}, agree);
        EXPECT_FALSE(added);
        if (!added) {
            EXPECT_EQ(added.error().code, ErrorCode::kUnavailable);
        }
        return Result<void>();
    }));
    EXPECT_EQ(seen, std::vector<std::string>{"a"});
    const auto stopped = store_.while_nobody_writes([](const std::vector<Video>&) {
        return Result<void>(Error{ErrorCode::kIo, "the folder cannot be read"});
    });
    ASSERT_FALSE(stopped);
    EXPECT_THAT(stopped.error().message, HasSubstr("the folder cannot be read"));
    expect(beside.add(video("b"), {}, agree));
}

}  // namespace
}  // namespace haarmony::schema
