#include "engine/image/packed_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "engine/image/segment.h"
#include "tests/engine/image/plain_segment.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

std::vector<Record> make_records(int count) {
    std::mt19937 random(71);
    std::vector<Record> records;
    for (int i = 0; i < count; ++i) {
        Record record;
        record.id = ImageId{3 * i + 1};
        // Lists of any length, and popular coefficients, so that some are dense.
        const int most = i % 5 == 0 ? 1 + i % 3 : kMaxCoefficients;
        record.signature = random_signature(random, {most, 300});
        record.log_aspect = count / 2 - i;
        records.push_back(record);
    }
    return records;
}

void add_all(const std::vector<Record>& records, PackedPictures& pictures) {
    for (const Record& record : records)
        pictures.add(record.id, record.signature, record.log_aspect);
}

void expect_largest(const PictureCoefficients& coefficients,
                    const Record& record,
                    int index_m) {
    for (std::size_t c = 0; c < kChannels; ++c) {
        const ChannelSignature& channel = record.signature.channels[c];
        const auto count = std::min<std::size_t>(channel.count, std::size_t(index_m));
        EXPECT_TRUE(
            std::ranges::equal(coefficients[c], std::span(channel.indices).first(count)))
            << to_int(record.id) << " channel " << c;
    }
}

TEST(PackedPictures, GiveTheLargestOfEachPicture) {
    const std::vector<Record> records = make_records(60);
    for (const int index_m : {1, 40, 60, kMaxCoefficients}) {
        PackedPictures pictures(index_m);
        add_all(records, pictures);
        ASSERT_EQ(pictures.size(), records.size());
        EXPECT_EQ(pictures.index_m(), index_m);
        std::uint32_t next = 0;
        pictures.give_all(
            [&](std::uint32_t place, const PictureCoefficients& coefficients) {
                ASSERT_EQ(place, next++);
                expect_largest(coefficients, records[place], index_m);
            });
        EXPECT_EQ(next, records.size());
        for (std::size_t place = 0; place < records.size(); ++place) {
            const PictureTerms& terms = pictures.columns().terms[place];
            EXPECT_EQ(pictures.columns().ids[place], records[place].id);
            EXPECT_EQ(terms.log_aspect, records[place].log_aspect);
            for (std::size_t c = 0; c < kChannels; ++c)
                EXPECT_EQ(terms.average[c], records[place].signature.channels[c].average);
        }
    }
}

TEST(PackedPictures, GiveInAnyOrder) {
    const std::vector<Record> records = make_records(40);
    PackedPictures pictures(60);
    add_all(records, pictures);
    const std::vector<std::uint32_t> places{39, 0, 17, 3, 38, 1, 2};
    std::vector<std::uint32_t> given;
    pictures.give(places,
                  [&](std::uint32_t place, const PictureCoefficients& coefficients) {
                      given.push_back(place);
                      expect_largest(coefficients, records[place], 60);
                  });
    EXPECT_EQ(given, places);
}

TEST(PackedPictures, BecomeByteForByteThePlainSegment) {
    const std::vector<Record> records = make_records(700);
    PackedPictures pictures(60);
    pictures.reserve(10);
    add_all(records, pictures);
    const auto segment = Segment::from_pictures(pictures);
    const BuiltSegment expected = plain_segment(records, 60);
    ASSERT_EQ(segment->view().counts, expected.counts);
    EXPECT_TRUE(std::ranges::equal(bytes_of(segment->view()), expected.bytes.span()));
}

TEST(PackedPictures, AreGoneOnceTheyAreCleared) {
    const std::vector<Record> records = make_records(20);
    PackedPictures pictures(40);
    pictures.add(records[10].id, records[10].signature, 1);
    pictures.clear();
    EXPECT_EQ(pictures.size(), 0U);
    // A smaller id than before, and shorter lists than stood there.
    pictures.add(records[0].id, records[0].signature, 2);
    ASSERT_EQ(pictures.size(), 1U);
    EXPECT_EQ(pictures.columns().terms[0].log_aspect, 2);
    pictures.give_all([&](std::uint32_t, const PictureCoefficients& coefficients) {
        expect_largest(coefficients, records[0], 40);
    });
}

}  // namespace
}  // namespace haarmony::image
