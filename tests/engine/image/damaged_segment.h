// A segment of which each test damages one field.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>

#include "engine/image/segment_layout.h"
#include "tests/engine/image/segment_bytes.h"

namespace haarmony::image {

// Copies that know what they are refused for.
class DamagedCopy : public Copy {
  public:
    using Copy::Copy;

    void expect_damage(const std::string& named) {
        const Result<SegmentView> result = view();
        ASSERT_FALSE(result.has_value()) << named;
        EXPECT_EQ(result.error().code, ErrorCode::kUndecodable);
        EXPECT_THAT(result.error().message, ::testing::HasSubstr("damaged: " + named));
    }
};

// Every test damages a fresh copy of one segment: three tiers, three blocks, the last of
// them not full, dense and coarse lists of each kind.
class DamagedSegment : public ::testing::Test {
  protected:
    static constexpr int kIndexM = 50;
    static constexpr int kSlots = 600;

    static const Segment& whole() {
        static const std::shared_ptr<const Segment> segment = [] {
            std::mt19937 random(401);
            return make_segment(make_records(random, kSlots), kIndexM);
        }();
        return *segment;
    }
    // The first key that `wanted` is true of.
    template <typename Wanted>
    std::size_t key_where(const Wanted& wanted) {
        for (std::size_t key = 1; key < spans.directory.size(); ++key) {
            if (wanted(DirectoryEntry(spans.directory[key]))) return key;
        }
        ADD_FAILURE() << "no such key";
        return 0;
    }
    // The first channel of a slot with that many own coefficients.
    struct OwnList {
        std::size_t slot = 0;
        std::size_t channel = 0;
        std::size_t begin = 0;
    };
    OwnList own_list_of(int least) {
        std::size_t begin = 0;
        for (std::size_t slot = 0; slot < kSlots; ++slot) {
            for (std::size_t c = 0; c < kChannels; ++c) {
                const int count = spans.own_counts[slot][c][kMaxTiers - 1];
                if (count >= least) return {slot, c, begin};
                begin += std::size_t(count);
            }
        }
        ADD_FAILURE() << "no such list";
        return {};
    }

    static std::string number(std::size_t value) { return std::to_string(value); }

    DamagedCopy copy{whole()};
    SegmentUnderConstruction spans = copy.spans();
};

}  // namespace haarmony::image
