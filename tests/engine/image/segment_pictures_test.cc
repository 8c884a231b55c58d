#include "engine/image/segment_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "engine/image/segment.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

using Coefficients = std::array<std::vector<std::int16_t>, kChannels>;

Coefficients copy_of(const PictureCoefficients& picture) {
    Coefficients copy;
    for (std::size_t c = 0; c < kChannels; ++c)
        copy[c].assign(picture[c].begin(), picture[c].end());
    return copy;
}

// Segments of random pictures, some of which are left out.
class Parts {
  public:
    Parts(const std::vector<int>& sizes, int index_m, std::mt19937& random) {
        std::vector<std::vector<Record>> records;
        for (const int size : sizes) {
            std::vector<Record>& some = records.emplace_back();
            for (int i = 0; i < size; ++i) {
                const SignatureShape shape{.max_count = i % 7 == 0 ? 3 : kMaxCoefficients,
                                           .max_index = i % 3 == 0 ? 16383 : 300};
                some.push_back({ImageId{i + 1}, random_signature(random, shape)});
            }
            std::vector<const Record*> pointers;
            for (const Record& record : some) pointers.push_back(&record);
            segments.push_back(Segment::from_records(pointers, index_m));
        }
        std::vector<std::uint32_t> places;
        for (std::size_t p = 0; p < sizes.size(); ++p) {
            for (int slot = 0; slot < sizes[p]; ++slot) {
                if ((slot + int(p)) % 5 != 0)
                    places.push_back(std::uint32_t(places.size()));
            }
        }
        std::ranges::shuffle(places, random);
        expected.resize(places.size());
        std::size_t next = 0;
        for (std::size_t p = 0; p < sizes.size(); ++p) {
            const Segment& segment = *segments[p];
            SegmentPictures::Part part{segment.view(), {}};
            for (int slot = 0; slot < sizes[p]; ++slot) {
                if ((slot + int(p)) % 5 == 0) {
                    part.place_of.push_back(SegmentPictures::kLeftOut);
                    continue;
                }
                const std::uint32_t place = places[next++];
                part.place_of.push_back(std::int32_t(place));
                const Record& record =
                    records[p][std::size_t(to_int(segment.id(slot)) - 1)];
                for (std::size_t c = 0; c < kChannels; ++c) {
                    const auto largest = record.signature.channels[c].largest(index_m);
                    expected[place][c].assign(largest.begin(), largest.end());
                }
            }
            parts.push_back(std::move(part));
        }
    }

    [[nodiscard]] SegmentPictures pictures() const { return {parts, expected.size()}; }

    std::vector<Coefficients> expected;  // [place]
    std::vector<std::shared_ptr<const Segment>> segments;
    std::vector<SegmentPictures::Part> parts;
};

TEST(SegmentPictures, GiveEveryPictureOnceAsItWasPutIn) {
    std::mt19937 random(441);
    for (const int index_m : {1, 20, 33, 60, 100}) {
        const Parts parts({1, 300, 255, 1100}, index_m, random);
        std::map<std::uint32_t, Coefficients> given;
        parts.pictures().give_all(
            [&](std::uint32_t place, const PictureCoefficients& picture) {
                EXPECT_TRUE(given.emplace(place, copy_of(picture)).second) << place;
            });
        ASSERT_EQ(given.size(), parts.expected.size());
        for (const auto& [place, picture] : given)
            EXPECT_EQ(picture, parts.expected[place]) << "m " << index_m;
    }
}

void expect_in_order(const Parts& parts, const std::vector<std::uint32_t>& places) {
    std::size_t next = 0;
    std::size_t wrong = 0;
    parts.pictures().give(places,
                          [&](std::uint32_t place, const PictureCoefficients& picture) {
                              ASSERT_LT(next, places.size());
                              EXPECT_EQ(place, places[next++]);
                              wrong += copy_of(picture) != parts.expected[place] ? 1 : 0;
                          });
    EXPECT_EQ(next, places.size());
    EXPECT_EQ(wrong, 0U);
}

TEST(SegmentPictures, GiveThoseAskedForInTheirOrder) {
    std::mt19937 random(442);
    for (const int index_m : {1, 20, 33, 60, 100}) {
        const Parts parts({1, 300, 255, 1100}, index_m, random);
        std::vector<std::uint32_t> places(parts.expected.size());
        std::iota(places.begin(), places.end(), 0U);
        std::ranges::shuffle(places, random);
        expect_in_order(parts, places);
        places.resize(places.size() / 3);
        expect_in_order(parts, places);
        expect_in_order(parts, {});
    }
}

TEST(SegmentPictures, GiveMoreThanAreGatheredAtOnce) {
    std::mt19937 random(443);
    const int enough = int(SegmentPictures::kGathered) * 5 / 8 + 1;
    const Parts parts({enough, enough}, 2, random);
    std::vector<std::uint32_t> places(parts.expected.size());
    ASSERT_GT(places.size(), SegmentPictures::kGathered);
    std::iota(places.begin(), places.end(), 0U);
    std::ranges::shuffle(places, random);
    expect_in_order(parts, places);
}

}  // namespace
}  // namespace haarmony::image
