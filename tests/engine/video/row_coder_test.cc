// Rows of residuals as streams, there and back.
#include "engine/video/row_coder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace haarmony::video {
namespace {

struct Case {
    Brick brick;
    bool alpha;
};

// Residuals off a clear brick, each row of a class of its own; not canonical, since here no
// pixel need look like anything.
std::vector<Case> cases(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<Case> made(count);
    for (Case& one : made) {
        one.alpha = random() % 3 == 0;
        for (int y = 0; y < kBrickSide; ++y) {
            const int most = 1 << random() % 8;
            for (int x = 0; x < kBrickSide; ++x) {
                const auto off = [&] {
                    return static_cast<std::uint8_t>(
                        static_cast<int>(random() % (2 * most)) - most);
                };
                one.brick[y * kBrickSide + x] = {
                    off(), off(), off(), static_cast<std::uint8_t>(off() | 1)};
            }
        }
    }
    return made;
}

constexpr Brick kNothing{};

std::vector<std::byte> coded(const std::vector<Case>& all) {
    RowWriter writer;
    for (const Case& one : all) {
        PackedRows rows;
        (void)pack_residuals(one.brick, kNothing, rows);
        writer.put(rows, one.alpha);
    }
    std::vector<std::byte> bytes;
    writer.finish(bytes);
    return bytes;
}

TEST(RowCoder, ResidualsOfEveryClassComeBack) {
    for (const std::size_t count : {0U, 1U, 2U, 700U}) {
        const std::vector<Case> all = cases(count, 31);
        const std::vector<std::byte> bytes = coded(all);
        StreamReader streams(bytes);
        Result<RowReader> reader = RowReader::open(streams, count);
        ASSERT_TRUE(reader.has_value()) << reader.error().message;
        EXPECT_TRUE(streams.at_end());
        for (const Case& one : all) {
            PackedRows rows;
            const Left left = pack_residuals(one.brick, kNothing, rows);
            Residuals residuals{};
            (*reader).next(one.alpha, residuals);
            for (std::size_t i = 0; i < kBrickPixels; ++i) {
                const Rgba pixel = one.brick[i];
                const int follow = left.follows_green ? pixel.g : 0;
                EXPECT_EQ(residuals[i], pixel.g);
                EXPECT_EQ(residuals[kBrickPixels + i],
                          static_cast<std::uint8_t>(pixel.r - follow));
                EXPECT_EQ(residuals[2 * kBrickPixels + i],
                          static_cast<std::uint8_t>(pixel.b - follow));
                EXPECT_EQ(residuals[3 * kBrickPixels + i], one.alpha ? pixel.a : 0);
            }
        }
        EXPECT_TRUE((*reader).at_end());
    }
}

TEST(RowCoder, BricksThatAreLeftOverOrMissingAreNoticed) {
    const std::vector<Case> all = cases(20, 32);
    const std::vector<std::byte> bytes = coded(all);
    for (const std::size_t read : {19U, 21U}) {
        StreamReader streams(bytes);
        Result<RowReader> reader = RowReader::open(streams, 21);
        ASSERT_TRUE(reader.has_value());
        Residuals residuals{};
        for (std::size_t i = 0; i < read; ++i)
            (*reader).next(all[i % all.size()].alpha, residuals);
        EXPECT_FALSE((*reader).at_end()) << read;
    }
}

// The streams one after the other: classes, rows of classes 1 to 5, classes of alpha.
constexpr std::size_t kStreams = 7;
std::array<Stream, kStreams> taken_apart(const std::vector<std::byte>& bytes) {
    std::array<Stream, kStreams> streams;
    StreamReader reader(bytes);
    for (Stream& stream : streams) {
        Result<Stream> read = reader.next(1 << 20);
        EXPECT_TRUE(read.has_value());
        stream = *std::move(read);
    }
    EXPECT_TRUE(reader.at_end());
    return streams;
}

bool intact(const std::array<Stream, kStreams>& changed, const std::vector<Case>& all) {
    std::vector<std::byte> bytes;
    for (const Stream& stream : changed) put_stream(stream, Redundancy::kFrequent, bytes);
    StreamReader streams(bytes);
    Result<RowReader> reader = RowReader::open(streams, all.size());
    if (!reader) return false;
    Residuals residuals{};
    for (const Case& one : all) (*reader).next(one.alpha, residuals);
    return (*reader).at_end();
}

TEST(RowCoder, AByteTooManyOrTooFewInAnyStreamIsNoticed) {
    const std::vector<Case> all = cases(60, 33);
    const std::array<Stream, kStreams> streams = taken_apart(coded(all));
    ASSERT_TRUE(intact(streams, all));
    for (std::size_t i = 0; i < kStreams; ++i) {
        ASSERT_FALSE(streams[i].empty()) << i;
        std::array<Stream, kStreams> changed = streams;
        changed[i].push_back(0);
        EXPECT_FALSE(intact(changed, all)) << i;
        changed[i].resize(streams[i].size() - 1);
        EXPECT_FALSE(intact(changed, all)) << i;
        changed[i].clear();
        EXPECT_FALSE(intact(changed, all)) << i;
    }
}

TEST(RowCoder, ClassesThatAreNoneAreNoticed) {
    Brick flat;
    flat.fill({1, 1, 1, 1});
    const std::vector<Case> all = {{flat, true}};
    const std::array<Stream, kStreams> streams = taken_apart(coded(all));
    ASSERT_TRUE(intact(streams, all));
    for (const std::size_t stream : {std::size_t{0}, kStreams - 1}) {
        const int known = stream == 0 ? 216 : kRowClasses;
        for (int value = known; value < 256; ++value) {
            // The rest fits: a row less, of the one plane whose row was not all zeros.
            std::array<Stream, kStreams> changed = streams;
            changed[stream][3] = static_cast<std::uint8_t>(value);
            changed[2].resize(changed[2].size() - kRowBytes[2]);
            EXPECT_FALSE(intact(changed, all)) << stream << ", " << value;
        }
    }
}

TEST(RowCoder, EdgesThatComeAgainAreFound) {
    // An edge of one of four shapes in every brick.
    std::mt19937 random(35);
    std::array<Brick, 4> shapes;
    for (Brick& shape : shapes) {
        for (Rgba& pixel : shape) {
            const auto byte = static_cast<std::uint8_t>(random());
            pixel = {byte, static_cast<std::uint8_t>(byte + 90), byte, 255};
        }
    }
    std::vector<Case> all(400);
    for (Case& one : all) one = {shapes[random() % shapes.size()], false};
    EXPECT_LT(coded(all).size(), 10 * coded({all.front()}).size());
}

TEST(RowCoder, StreamsOfMoreThanTheBricksCanHaveAreRefused) {
    const std::vector<Case> all = cases(60, 34);
    const std::vector<std::byte> bytes = coded(all);
    StreamReader streams(bytes);
    const Result<RowReader> reader = RowReader::open(streams, 59);
    ASSERT_FALSE(reader.has_value());
    EXPECT_EQ(reader.error().message, "stream of 480 bytes, at most 472 expected");
}

TEST(RowCoder, StreamsThatTogetherHaveMoreRowsThanTheBricksAreRefused) {
    std::vector<std::byte> bytes;
    put_stream({}, Redundancy::kFrequent, bytes);
    put_stream(Stream(20), Redundancy::kFrequent, bytes);      // class 1: 20 rows
    put_stream(Stream(2 * 10), Redundancy::kFrequent, bytes);  // class 2: 10 rows
    put_stream(Stream(4 * 3), Redundancy::kFrequent, bytes);   // class 3: 3 rows
    StreamReader streams(bytes);
    const Result<RowReader> reader = RowReader::open(streams, 1);
    ASSERT_FALSE(reader.has_value());
    EXPECT_EQ(reader.error().message, "stream of 12 bytes, at most 8 expected");
}

}  // namespace
}  // namespace haarmony::video
