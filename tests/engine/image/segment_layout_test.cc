#include "engine/image/segment_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "engine/image/profile.h"
#include "engine/image/segment_pictures.h"
#include "engine/image/segment_search.h"
#include "tests/engine/image/segment_bytes.h"

namespace haarmony::image {
namespace {

// Everything that a search, or a merge, reads of the view; the sum of what a merge sends.
std::uint64_t read_all(const SegmentView& view, const Profile& profile, Signature asked) {
    const int blocks = view.counts.blocks();
    std::uint64_t sum = 0;
    for (const int wanted_m : {1, 20, 30, 40, 100}) {
        const int m = std::min(wanted_m, int(view.counts.index_m));
        const Query query = make_query(asked, profile, m);
        const Rounding rounding(query);
        const SegmentSearch search(view, query, rounding, {});
        BestKept best(10);
        Visitor visitor(search, best);
        for (int first = 0; first < blocks; first += kBlocksAtOnce) {
            std::array<bool, kBlocksAtOnce> due{};
            due.fill(true);
            const int count = std::min(kBlocksAtOnce, blocks - first);
            visitor.visit(
                first, std::span<const bool>(due).first(std::size_t(count)), {});
        }
        visitor.finish();
        std::vector<Match> all;
        search.score_all(all);
        sum += all.size();
    }
    std::vector<std::int32_t> place_of(view.counts.slots);
    std::iota(place_of.begin(), place_of.end(), 0);
    std::vector<SegmentPictures::Part> parts;
    parts.push_back({view, std::move(place_of)});
    const SegmentPictures pictures(std::move(parts), view.counts.slots);
    pictures.give_all([&](std::uint32_t place, const PictureCoefficients& picture) {
        EXPECT_LT(place, view.counts.slots);
        for (int c = 0; c < kChannels; ++c) {
            EXPECT_LE(picture[std::size_t(c)].size(), view.counts.index_m);
            for (const int index : picture[std::size_t(c)]) {
                EXPECT_LT(coefficient_key(c, index), std::uint32_t{kKeyCount});
                ++sum;
            }
        }
    });
    return sum;
}

TEST(SegmentLayout, WhateverPassesCanBeSearchedAndMerged) {
    std::mt19937 random(402);
    const Profile profile = *built_in_profile("scanned");
    int accepted = 0;
    int refused = 0;
    for (const int index_m : {1, 20, 33, 60, 100}) {
        const std::vector<Record> records = make_records(random, 40 + 3 * index_m);
        const auto segment = make_segment(records, index_m);
        const Signature& asked = records[1].signature;
        Copy copy(*segment);
        const std::size_t total = copy.bytes().size();
        // The directory is most of the bytes and would get most of the damage.
        const auto directory = std::as_bytes(std::span(copy.spans().directory));
        const auto begin = std::size_t(directory.data() - copy.bytes().data());
        for (int i = 0; i < 400; ++i) {
            std::size_t place = random() % (total - directory.size());
            if (place >= begin) place += directory.size();
            if (i % 4 == 0) place = begin + random() % directory.size();
            std::byte& byte = copy.bytes()[place];
            const std::byte before = byte;
            byte ^= std::byte{static_cast<unsigned char>(1U << (random() % 8))};
            if (const Result<SegmentView> view = copy.view()) {
                ++accepted;
                EXPECT_GT(read_all(*view, profile, asked), 0U);
                auto damaged = Segment::from_view(*view, nullptr);
                const std::array<LiveSegment, 1> parts{{{std::move(damaged), nullptr}}};
                const auto merged = Segment::merge(parts);
                EXPECT_TRUE(view_segment(merged->view().counts, bytes_of(*merged)));
            } else {
                ++refused;
                EXPECT_EQ(view.error().code, ErrorCode::kUndecodable);
            }
            byte = before;
        }
    }
    EXPECT_GT(accepted, 100);
    EXPECT_GT(refused, 100);
}

// Every element of every part is written to, in order: where parts overlapped or left the
// bytes, a later one would have changed an earlier one.
TEST(SegmentLayout, PartsAreApartAlignedAndReadWhereTheyAreWritten) {
    for (const int index_m : {1, 20, 21, 40, 41, 100}) {
        SegmentCounts counts;
        counts.index_m = static_cast<std::uint32_t>(index_m);
        counts.slots = 300;
        const Tiers tiers = tiers_of(index_m);
        for (int t = 0; t < tiers.count; ++t) counts.dense[t] = std::uint32_t(2 + t);
        counts.coarse = 3;
        counts.dense_postings = 77;
        counts.own_postings = 99;
        const SegmentBytes sizes = segment_bytes(counts);
        EXPECT_LT(sizes.without_ranks, sizes.total);
        std::vector<std::byte> memory(sizes.total + 64);
        const auto misplaced = reinterpret_cast<std::uintptr_t>(memory.data()) % 64;
        const auto bytes = std::span(memory).subspan((64 - misplaced) % 64, sizes.total);
        const auto each_part = [](const auto& spans, const auto& visit) {
            visit(std::as_bytes(spans.terms));
            visit(std::as_bytes(spans.ids));
            visit(std::as_bytes(spans.slots_by_id));
            for (const auto& lowest : spans.lowest) visit(std::as_bytes(lowest));
            for (const auto& highest : spans.highest) visit(std::as_bytes(highest));
            visit(std::as_bytes(spans.directory));
            for (int t = 0; t < spans.tiers.count; ++t) {
                visit(std::as_bytes(spans.rows[t]));
                visit(std::as_bytes(spans.presence[t]));
            }
            visit(std::as_bytes(spans.coarse_rows));
            visit(std::as_bytes(spans.own_begin));
            visit(std::as_bytes(spans.own_counts));
            visit(std::as_bytes(spans.own));
            visit(std::as_bytes(spans.dense_keys));
            visit(std::as_bytes(spans.dense_rank_begin));
            visit(std::as_bytes(spans.dense_ranks));
            visit(std::as_bytes(spans.own_ranks));
        };
        const std::byte* end = bytes.data();
        std::vector<std::span<const std::byte>> written;
        each_part(spans_of(counts, bytes), [&](std::span<const std::byte> part) {
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(part.data()) % 64, 0U);
            EXPECT_GE(part.data(), end);
            EXPECT_LT(part.data() - end, 64);
            EXPECT_FALSE(part.empty());
            end = part.data() + part.size();
            written.push_back(part);
        });
        EXPECT_LE(end, bytes.data() + bytes.size());
        std::size_t next = 0;
        each_part(spans_of(counts, std::span<const std::byte>(bytes)),
                  [&](std::span<const std::byte> part) {
                      EXPECT_EQ(part.data(), written[next].data());
                      EXPECT_EQ(part.size(), written[next].size());
                      ++next;
                  });
        EXPECT_EQ(next, written.size());
    }
}

TEST(SegmentLayout, TiersEndAtIndexM) {
    const auto tiers = [](int index_m) {
        const Tiers all = tiers_of(index_m);
        return std::vector<int>(all.m.begin(), all.m.begin() + all.count);
    };
    EXPECT_THAT(tiers(1), testing::ElementsAre(1));
    EXPECT_THAT(tiers(20), testing::ElementsAre(20));
    EXPECT_THAT(tiers(21), testing::ElementsAre(20, 21));
    EXPECT_THAT(tiers(40), testing::ElementsAre(20, 40));
    EXPECT_THAT(tiers(41), testing::ElementsAre(20, 40, 41));
    EXPECT_THAT(tiers(100), testing::ElementsAre(20, 40, 100));
    EXPECT_EQ(tiers_of(100).holding(20), 0);
    EXPECT_EQ(tiers_of(100).holding(21), 1);
    EXPECT_EQ(tiers_of(100).holding(41), 2);
}

TEST(SegmentLayout, EntriesOfTheDirectoryAreWhatTheyWereMadeOf) {
    EXPECT_EQ(DirectoryEntry().dense(), DirectoryEntry::kNone);
    EXPECT_EQ(DirectoryEntry().coarse(), DirectoryEntry::kNone);
    for (const int list : {0, 1, DirectoryEntry::kMost - 1}) {
        EXPECT_EQ(DirectoryEntry::of_dense(list).dense(), list);
        EXPECT_EQ(DirectoryEntry::of_dense(list).coarse(), DirectoryEntry::kNone);
        EXPECT_EQ(DirectoryEntry::of_coarse(list).coarse(), list);
        EXPECT_EQ(DirectoryEntry::of_coarse(list).dense(), DirectoryEntry::kNone);
    }
}

}  // namespace
}  // namespace haarmony::image
