// Files read: everything comes back, little of it is in memory, and nothing hostile passes.
#include "engine/video/mrv_clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <latch>
#include <thread>

#include "engine/video/decoded_cache.h"
#include "engine/video/mrv_format.h"
#include "tests/engine/video/plain_clip.h"
#include "tests/engine/video/random_links.h"

namespace haarmony::video::testing {
namespace {

constexpr std::size_t kPlenty = 1U << 30;

std::unique_ptr<MrvClip> opened(const std::vector<std::byte>& file, std::size_t cache) {
    Result<std::unique_ptr<MrvClip>> clip = MrvClip::open(file, cache);
    EXPECT_TRUE(clip.has_value()) << clip.error().message;
    return *std::move(clip);
}

void expect_same(const LinkedClip& wanted, const MrvClip& clip) {
    EXPECT_EQ(clip.shape(), wanted.shape);
    EXPECT_EQ(clip.delta(), wanted.delta);
    for (const Siblings& siblings : wanted.siblings) {
        ASSERT_TRUE(clip.stored(siblings.address));
        const Result<Frame::Nodes> nodes = clip.nodes(siblings.address);
        ASSERT_TRUE(nodes.has_value()) << nodes.error().message;
        EXPECT_EQ(**nodes, siblings.nodes);
        for (std::size_t i = 0; i < siblings.layers.size(); ++i) {
            const Result<Frame::LayerPtr> layer =
                clip.layer(siblings.address, kBrickLevel + static_cast<int>(i));
            ASSERT_TRUE(layer.has_value()) << layer.error().message;
            EXPECT_EQ(**layer, siblings.layers[i]);
        }
    }
}

LinkedClip unlinked_clip(const RawClip& raw) {
    const std::unique_ptr<MemoryClip> plain = plain_clip(raw);
    LinkedClip clip{plain->shape(), 0, {}};
    for (int k = 0; k <= clip.shape.time_levels(); ++k) {
        const std::int64_t groups = k == 0 ? 1 : clip.shape.nodes_at(k - 1);
        for (std::int64_t i = 0; i < groups; ++i) {
            Siblings siblings{{k, i}, **plain->nodes({k, i}), {}};
            for (int level = kBrickLevel;
                 level <= std::max(clip.shape.space_levels(), kBrickLevel);
                 ++level)
                siblings.layers.push_back(**plain->layer({k, i}, level));
            clip.siblings.push_back(std::move(siblings));
        }
    }
    // From the root down, the first half's descendants before the second's.
    std::sort(clip.siblings.begin(),
              clip.siblings.end(),
              [&](const Siblings& a, const Siblings& b) {
                  const auto place = [&](const SiblingAddress& at) {
                      const int down = clip.shape.time_levels() - at.time_level + 1;
                      return std::pair(at.time_level == 0 ? 0 : at.index << down,
                                       at.time_level);
                  };
                  return place(a.address) < place(b.address);
              });
    return clip;
}

TEST(MrvClip, EveryNodeAndBrickOfALinkedClipComesBack) {
    for (std::uint32_t seed = 0; seed < 24; ++seed) {
        const int width = 1 + static_cast<int>(seed * 7 % 70);
        const int frames = 1 + static_cast<int>(seed % 9);
        const LinkedClip clip = linked_clip(width, 33, frames, seed);
        const std::vector<std::byte> file = mrv_bytes(clip);
        SCOPED_TRACE(seed);
        expect_same(clip, *opened(file, kPlenty));
        expect_same(clip, *opened(file, 0));
    }
}

TEST(MrvClip, EveryPictureOfAClipComesBack) {
    const LinkedClip clips[] = {unlinked_clip(random_clip(37, 21, 5, 1)),
                                unlinked_clip(random_clip(40, 64, 4, 2, true)),
                                unlinked_clip(random_clip(1, 1, 1, 3)),
                                unlinked_clip(random_clip(3, 2, 2, 4))};
    for (const LinkedClip& clip : clips)
        expect_same(clip, *opened(mrv_bytes(clip), kPlenty));
}

TEST(MrvClip, SiblingsThatAreNotThereAreNotStored) {
    const LinkedClip clip = linked_clip(20, 20, 9, 5);
    const auto file = mrv_bytes(clip);
    const std::unique_ptr<MrvClip> read = opened(file, kPlenty);
    std::size_t stored = 0;
    for (int k = 0; k <= clip.shape.time_levels(); ++k) {
        const std::int64_t groups = k == 0 ? 1 : clip.shape.nodes_at(k - 1);
        for (std::int64_t i = 0; i < groups; ++i) stored += read->stored({k, i}) ? 1 : 0;
    }
    EXPECT_EQ(stored, clip.siblings.size());
    EXPECT_LT(stored, 13U);  // the seed leaves some out
    EXPECT_FALSE(read->stored({1, 5}));
}

// Sec. 5.2.4: only what is displayed and its time-ancestors need be in memory.
TEST(MrvClip, AFilePlaysInLessMemoryThanItTakes) {
    const LinkedClip clip = unlinked_clip(random_clip(40, 30, 24, 6));
    const auto file = mrv_bytes(clip);
    std::size_t whole = 0;
    std::size_t largest = 0;
    for (const Siblings& siblings : clip.siblings) {
        std::size_t bytes = sizeof(SiblingNodes);
        for (const Layer& layer : siblings.layers)
            bytes += layer.memory_bytes() + sizeof(Layer);
        whole += bytes;
        largest = std::max(largest, bytes);
    }
    const std::size_t limit = 2 * largest;
    ASSERT_GT(whole, 5 * limit);
    const std::unique_ptr<MrvClip> read = opened(file, limit);
    for (std::int64_t t = 0; t < clip.shape.frames(); ++t) {
        const Result<Frame> frame =
            read->frame({clip.shape.time_levels(), t}, clip.shape.space_levels());
        ASSERT_TRUE(frame.has_value());
        EXPECT_LE(read->cached_bytes(), limit);
    }
    EXPECT_GT(read->cached_bytes(), 0U);
}

TEST(MrvClip, WhatAFrameHoldsIsNotDecodedAgain) {
    const LinkedClip clip = unlinked_clip(random_clip(30, 30, 4, 7));
    const auto file = mrv_bytes(clip);
    const std::unique_ptr<MrvClip> read = opened(file, 0);
    const Result<Frame> frame = read->frame({2, 1}, clip.shape.space_levels());
    ASSERT_TRUE(frame.has_value());
    const std::uint64_t layers = read->decoded_chunks();
    const Result<Frame> again = read->frame({2, 0}, clip.shape.space_levels());
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(read->cached_bytes(), 0U);
    // Its own half's chunks are the sibling's: only the time nodes above it had gone.
    EXPECT_LE(read->decoded_chunks(), layers + 3);
}

TEST(MrvClip, ClipsThatShareACacheStayWithinItsLimitTogether) {
    const auto first_file = mrv_bytes(unlinked_clip(random_clip(40, 24, 6, 11)));
    const auto second_file = mrv_bytes(unlinked_clip(random_clip(24, 40, 6, 12)));
    const auto every_frame = [](const MrvClip& clip) {
        for (std::int64_t t = 0; t < clip.shape().frames(); ++t)
            EXPECT_TRUE(
                clip.frame({clip.shape().time_levels(), t}, clip.shape().space_levels())
                    .has_value());
    };
    const auto alone = opened(first_file, kPlenty);
    every_frame(*alone);
    const std::size_t whole = alone->cached_bytes();

    // Room for one of them.
    const auto cache = std::make_shared<DecodedCache>(whole);
    auto first = MrvClip::open(first_file, cache);
    auto second = MrvClip::open(second_file, cache);
    ASSERT_TRUE(first && second);
    every_frame(**first);
    EXPECT_EQ(cache->bytes(), whole);
    every_frame(**first);
    EXPECT_EQ((*first)->decoded_chunks(), alone->decoded_chunks());
    every_frame(**second);
    EXPECT_LE(cache->bytes(), whole);
    EXPECT_GT((*second)->decoded_chunks(), 0U);
    every_frame(**first);
    EXPECT_GT((*first)->decoded_chunks(), alone->decoded_chunks());
    EXPECT_EQ((*first)->cached_bytes(), cache->bytes());
    // The layers of a clip go with it.
    second->reset();
    first->reset();
    EXPECT_EQ(cache->bytes(), 0U);
}

TEST(MrvClip, TwoThatWantTheSameLayersDecodeThemOnce) {
    const LinkedClip clip = unlinked_clip(random_clip(64, 64, 4, 8));
    const auto file = mrv_bytes(clip);
    const std::unique_ptr<MrvClip> alone = opened(file, kPlenty);
    ASSERT_TRUE(alone->frame({2, 3}, 6).has_value());
    const std::unique_ptr<MrvClip> shared = opened(file, kPlenty);
    constexpr int kThreads = 4;
    std::latch started(kThreads);
    std::vector<int> good(kThreads);
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < kThreads; ++i) {
            threads.emplace_back([&, i] {
                started.arrive_and_wait();
                good[static_cast<std::size_t>(i)] =
                    shared->frame({2, 3}, 6).has_value() ? 1 : 0;
            });
        }
    }
    EXPECT_EQ(good, std::vector<int>(kThreads, 1));
    EXPECT_EQ(shared->decoded_chunks(), alone->decoded_chunks());
}

TEST(MrvClip, ACoarseFrameDecodesCoarseChunksOnly) {
    const LinkedClip clip = unlinked_clip(random_clip(64, 64, 4, 9));
    const auto file = mrv_bytes(clip);
    const std::unique_ptr<MrvClip> read = opened(file, kPlenty);
    ASSERT_TRUE(read->frame({2, 0}, 2).has_value());
    EXPECT_EQ(read->decoded_chunks(), 3U);  // time nodes from the root down
    ASSERT_TRUE(read->frame({2, 0}, 4).has_value());
    EXPECT_EQ(read->decoded_chunks(), 3U + 3 * 2);
}

TEST(MrvClip, TheFrontOfAFileShowsCoarsePictures) {
    const LinkedClip clip = unlinked_clip(random_clip(64, 64, 4, 10));
    const std::vector<std::byte> file = mrv_bytes(clip);
    const Result<MrvFront> front = decode_front(file);
    ASSERT_TRUE(front.has_value());
    const MrvChunk& finest = (*front).index.chunk(mrv_row_of(6), 0);
    const std::vector<std::byte> part(file.begin(),
                                      file.begin() + static_cast<long>(finest.offset));
    const std::unique_ptr<MrvClip> read = opened(part, kPlenty);
    for (std::int64_t t = 0; t < 4; ++t) EXPECT_TRUE(read->frame({2, t}, 5).has_value());
    const Result<Frame> finer = read->frame({2, 0}, 6);
    ASSERT_FALSE(finer.has_value());
    EXPECT_EQ(finer.error().code, ErrorCode::kUndecodable);
    EXPECT_NE(finer.error().message.find("space level 6 of time level 0"),
              std::string::npos)
        << finer.error().message;
}

bool intact(const std::vector<std::byte>& file) {
    const Result<std::unique_ptr<MrvClip>> clip = MrvClip::open(file, 0);
    if (!clip) {
        EXPECT_FALSE(clip.error().message.empty());
        return false;
    }
    const Result<void> checked = (*clip)->verify();
    if (!checked) {
        EXPECT_FALSE(checked.error().message.empty());
    }
    return checked.has_value();
}

TEST(MrvClip, EveryFlippedByteIsNoticed) {
    std::vector<std::byte> file = mrv_bytes(linked_clip(9, 9, 2, 11));
    ASSERT_TRUE(intact(file));
    for (std::size_t i = 0; i < file.size(); ++i) {
        // The slot for an append: whatever is there is no generation.
        if (i >= kMrvSlotsAt + kMrvSlotBytes && i < kMrvHeaderBytes) continue;
        file[i] ^= std::byte{1} << i % 8;
        EXPECT_FALSE(intact(file)) << i;
        file[i] ^= std::byte{1} << i % 8;
    }
}

TEST(MrvClip, EveryTruncationIsNoticed) {
    const std::vector<std::byte> file = mrv_bytes(linked_clip(9, 9, 2, 11));
    for (std::size_t length = 0; length < file.size(); ++length)
        EXPECT_FALSE(intact({file.begin(), file.begin() + static_cast<long>(length)}));
}

// Chunks whose bytes are changed and whose checksums fit: what is behind the checksums.
TEST(MrvClip, HostileChunksAreRefusedOrReadWithinTheirLayers) {
    const std::vector<std::byte> file = mrv_bytes(linked_clip(20, 17, 3, 12));
    const Result<MrvFront> front = decode_front(file);
    ASSERT_TRUE(front.has_value());
    const MrvIndex& index = (*front).index;
    int refused = 0;
    int changed = 0;
    for (int row = 0; row < index.rows(); ++row) {
        for (std::size_t i = 0; i < index.siblings(); ++i) {
            const MrvChunk& chunk = index.chunk(row, i);
            for (std::uint32_t at = 0; at < chunk.bytes; at += 7) {
                std::vector<std::byte> hostile = file;
                const auto bytes = std::span(hostile).subspan(chunk.offset, chunk.bytes);
                bytes[at] ^= std::byte{1} << at % 8;
                // The new checksum stands in the index where the old one did.
                std::array<std::byte, 8> old_sum{};
                std::array<std::byte, 8> new_sum{};
                std::memcpy(old_sum.data(), &chunk.checksum, 8);
                const std::uint64_t sum = mrv_checksum(bytes);
                std::memcpy(new_sum.data(), &sum, 8);
                const auto found = std::search(
                    hostile.begin(), hostile.end(), old_sum.begin(), old_sum.end());
                ASSERT_NE(found, hostile.end());
                std::copy(new_sum.begin(), new_sum.end(), found);
                seal_front(hostile);
                ++changed;
                refused += intact(hostile) ? 0 : 1;
            }
        }
    }
    EXPECT_GT(changed, 200);
    // The rest are other residuals of a brick, or other refs that lie within their layers.
    EXPECT_GT(refused, changed / 4);
    EXPECT_LT(refused, changed);
}

TEST(MrvClip, OtherFilesAreToldApart) {
    const auto code = [](const std::vector<std::byte>& file) {
        return MrvClip::open(file, 0).error().code;
    };
    EXPECT_EQ(code({}), ErrorCode::kUnsupportedFormat);
    EXPECT_EQ(code(std::vector<std::byte>(500, std::byte{'x'})),
              ErrorCode::kUnsupportedFormat);
    std::vector<std::byte> file = mrv_bytes(linked_clip(8, 8, 1, 13));
    file[8] = std::byte{kMrvVersion + 1};
    EXPECT_EQ(code(file), ErrorCode::kNewerVersion);
    file[8] = std::byte{1};
    EXPECT_EQ(code(file), ErrorCode::kUnsupportedFormat);
    file[8] = std::byte{kMrvVersion};
    file[20] ^= std::byte{1};
    EXPECT_EQ(code(file), ErrorCode::kUndecodable);
}

TEST(MrvClip, WhatFollowsTheClipDoesNotMatter) {
    std::vector<std::byte> file = mrv_bytes(linked_clip(8, 8, 2, 14));
    const std::uint64_t revision = opened(file, 0)->revision();
    file.resize(file.size() + 100, std::byte{7});
    EXPECT_EQ(opened(file, 0)->revision(), revision);
    EXPECT_TRUE(intact(file));
}

TEST(MrvClip, AnOlderFileIsRefusedAndItsOwnerToldWhatToDo) {
    std::vector<std::byte> file = mrv_bytes(linked_clip(8, 8, 1, 15));
    file[8] = std::byte{1};
    const Result<std::unique_ptr<MrvClip>> older = MrvClip::open(file, 0);
    ASSERT_FALSE(older.has_value());
    EXPECT_EQ(older.error().message,
              ".mrv file of version 1, which is no longer read: upload the clip again");
}

}  // namespace
}  // namespace haarmony::video::testing
