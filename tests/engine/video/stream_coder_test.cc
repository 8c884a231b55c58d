// Streams of bytes, there and back, and what is refused of those that are none.
#include "engine/video/stream_coder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace haarmony::video {
namespace {

// Bytes below 2^bits, the lower ones more often.
Stream skewed(std::size_t count, int bits, std::uint32_t seed) {
    std::mt19937 random(seed);
    Stream stream(count);
    for (std::uint8_t& byte : stream) {
        const std::uint32_t mask = (1U << random() % (bits + 1)) - 1;
        byte = static_cast<std::uint8_t>(random() & mask);
    }
    return stream;
}

std::vector<std::byte> coded(const Stream& stream,
                             Redundancy redundancy = Redundancy::kFrequent) {
    std::vector<std::byte> bytes;
    put_stream(stream, redundancy, bytes);
    return bytes;
}

void expect_refused(std::span<const std::byte> bytes,
                    std::uint64_t most,
                    const std::string& what) {
    StreamReader reader(bytes);
    const Result<Stream> read = reader.next(most);
    ASSERT_FALSE(read.has_value()) << what;
    EXPECT_EQ(read.error().code, ErrorCode::kUndecodable);
    EXPECT_NE(read.error().message.find(what), std::string::npos) << read.error().message;
}

TEST(StreamCoder, WhatIsWrittenIsRead) {
    std::vector<Stream> streams;
    for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 300U, 70'000U, 300'000U}) {
        for (const int bits : {0, 1, 4, 8})
            streams.push_back(skewed(count, bits, static_cast<std::uint32_t>(count)));
    }
    for (const Redundancy redundancy :
         {Redundancy::kFrequent, Redundancy::kRepeated, Redundancy::kSearched}) {
        std::vector<std::byte> bytes;
        for (const Stream& stream : streams) put_stream(stream, redundancy, bytes);
        StreamReader reader(bytes);
        for (const Stream& stream : streams) {
            EXPECT_FALSE(reader.at_end());
            const Result<Stream> read = reader.next(stream.size());
            ASSERT_TRUE(read.has_value()) << read.error().message;
            ASSERT_EQ(*read, stream);
        }
        EXPECT_TRUE(reader.at_end());
    }
}

TEST(StreamCoder, AByteThatIsAlwaysTheSameCostsNothing) {
    EXPECT_LT(coded(Stream(100'000, 200)).size(), 60U);
}

TEST(StreamCoder, FrequentBytesCostLess) {
    // Half the bytes are 0, a quarter 1, the rest one of 64: 3.25 bits each.
    std::mt19937 random(4);
    Stream stream(80'000);
    for (std::uint8_t& byte : stream) {
        const std::uint32_t bits = static_cast<std::uint32_t>(random());
        byte = static_cast<std::uint8_t>((bits & 1) != 0   ? 0
                                         : (bits & 2) != 0 ? 1
                                                           : 100 + (bits >> 2) % 64);
    }
    EXPECT_NEAR(static_cast<double>(coded(stream).size()), 80'000 * 3.0 / 8, 800);
}

TEST(StreamCoder, NoiseCostsItsBytesAndAFew) {
    std::mt19937 random(5);
    Stream stream(50'000);
    for (std::uint8_t& byte : stream) byte = static_cast<std::uint8_t>(random());
    EXPECT_LE(coded(stream).size(), stream.size() + 3);
}

TEST(StreamCoder, RunsThatComeAgainAreFoundWhereTheyAreLookedFor) {
    const Stream once = skewed(500, 8, 6);
    Stream stream;
    for (int i = 0; i < 40; ++i) stream.insert(stream.end(), once.begin(), once.end());
    for (const Redundancy redundancy : {Redundancy::kRepeated, Redundancy::kSearched})
        EXPECT_LT(coded(stream, redundancy).size(), 2 * once.size());
    EXPECT_GT(coded(stream, Redundancy::kFrequent).size(), 10 * once.size());
}

TEST(StreamCoder, StreamsLongerThanExpectedAreNotRead) {
    const Stream stream = skewed(1000, 3, 7);
    expect_refused(coded(stream), 999, "stream of 1000 bytes, at most 999 expected");
    std::vector<std::byte> huge;
    put_varint(huge, ~std::uint64_t{0});
    expect_refused(huge, 1000, "at most 1000 expected");
}

TEST(StreamCoder, AnEndThatComesTooEarlyIsNoticed) {
    for (const std::size_t count : {10U, 1000U}) {
        const Stream stream = skewed(count, 3, 8);
        const std::vector<std::byte> bytes = coded(stream);
        for (std::size_t length = 0; length < bytes.size(); ++length)
            expect_refused(std::span(bytes).first(length), count, "cut off");
    }
}

// The frame of a stream, as a hostile writer may put it.
std::vector<std::byte> framed(std::uint64_t size, std::span<const std::byte> frame) {
    std::vector<std::byte> bytes;
    put_varint(bytes, 2 * size + 1);
    put_varint(bytes, frame.size());
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    return bytes;
}

TEST(StreamCoder, OnlyOneFrameOfTheSizeThatWasToldIsRead) {
    const std::vector<std::byte> bytes = coded(skewed(1000, 3, 9));
    ByteReader in(bytes);
    ASSERT_EQ(in.varint(), 2001U);
    const std::uint64_t frame_bytes = in.varint();
    ASSERT_EQ(frame_bytes, in.rest().size());
    const std::vector<std::byte> frame(in.rest().begin(), in.rest().end());
    StreamReader whole(bytes);
    ASSERT_TRUE(whole.next(1000).has_value());
    const std::vector<std::byte> again = framed(1000, frame);
    EXPECT_EQ(again, bytes);

    expect_refused(framed(999, frame), 1000, "frame of a stream of 999 bytes");
    std::vector<std::byte> two = frame;
    two.insert(two.end(), frame.begin(), frame.end());
    expect_refused(framed(1000, two), 1000, "frame of a stream of 1000 bytes");
    // What zstd skips: a frame of nothing.
    const std::vector<std::byte> skipped = {std::byte{0x50},
                                            std::byte{0x2A},
                                            std::byte{0x4D},
                                            std::byte{0x18},
                                            std::byte{0},
                                            std::byte{0},
                                            std::byte{0},
                                            std::byte{0}};
    expect_refused(framed(1000, skipped), 1000, "frame of a stream");
    expect_refused(framed(1000, {}), 1000, "frame of a stream");
}

TEST(StreamCoder, DamagedFramesAreRefusedOrGiveAsManyBytes) {
    const Stream stream = skewed(3000, 5, 10);
    const std::vector<std::byte> bytes = coded(stream);
    int refused = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::vector<std::byte> damaged = bytes;
        damaged[i] ^= std::byte{1} << i % 8;
        StreamReader reader(damaged);
        const Result<Stream> read = reader.next(stream.size());
        if (read) {
            EXPECT_LE((*read).size(), stream.size());
        } else {
            EXPECT_FALSE(read.error().message.empty());
            ++refused;
        }
    }
    EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace haarmony::video
