#include "tests/bench/http/synthetic_rows.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "engine/image/signature_codec.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::bench {
namespace {

TEST(SyntheticRows, SignaturesAreFullAndValidAndNamedByTheirNumber) {
    for (std::int64_t number = 1; number <= 50; ++number) {
        const image::Signature signature = synthetic_signature(1, number);
        for (const auto& channel : signature.channels)
            EXPECT_EQ(channel.count, image::kMaxCoefficients);
        // Decoding refuses what a picture could not have.
        const auto read = image::decode_signature(image::encode_signature(signature));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read.value(), signature);
        EXPECT_EQ(synthetic_signature(1, number), signature);
        EXPECT_NE(synthetic_signature(1, number + 1), signature);
        EXPECT_NE(synthetic_signature(2, number), signature);
    }
}

TEST(SyntheticRows, CoarseCoefficientsAreMoreCommonThanFineOnes) {
    std::array<int, 7> in_band{};
    for (std::int64_t number = 1; number <= 100; ++number)
        for (const auto& channel : synthetic_signature(1, number).channels)
            for (const std::int16_t index : channel.largest(image::kMaxCoefficients)) {
                const int position = std::abs(index);
                const int higher =
                    std::max(position / image::kSide, position % image::kSide);
                int band = 0;
                while ((higher >> (band + 1)) > 0) ++band;
                ++in_band[static_cast<std::size_t>(band)];
            }
    // Band b has 3 * 4^b places, so coefficients a place fall from band to band.
    for (std::size_t band = 1; band < in_band.size(); ++band)
        EXPECT_LT(in_band[band], 4 * in_band[band - 1]) << band;
}

TEST(SyntheticRows, AreWrittenWithIdsFromOneOn) {
    const schema::ScratchFolder folder;
    const auto of_seed_1 = [](std::int64_t number) {
        return synthetic_signature(1, number);
    };
    ASSERT_TRUE(write_rows(folder.file("rows.db"), 25, of_seed_1));
    auto database =
        schema::Database::open(folder.file("rows.db"), schema::Database::Mode::kReadOnly);
    ASSERT_TRUE(database);
    schema::ImageStore store(database.value());
    std::int64_t expected = 1;
    const auto visited =
        store.for_each_searchable([&](const schema::SearchableImage& image) {
            EXPECT_EQ(to_int(image.id), expected);
            EXPECT_EQ(
                std::vector<std::uint8_t>(image.signature.begin(), image.signature.end()),
                image::encode_signature(synthetic_signature(1, expected)));
            ++expected;
        });
    ASSERT_TRUE(visited);
    EXPECT_EQ(expected, 26);
}

TEST(SyntheticRows, ADatabaseThatCannotBeWrittenIsAnErrorWithItsPath) {
    const auto written = write_rows(
        "/nowhere/rows.db", 1, [](std::int64_t) { return image::Signature{}; });
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().message.find("/nowhere/rows.db"), std::string::npos);
}

}  // namespace
}  // namespace haarmony::bench
