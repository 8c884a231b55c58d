// Header and index: there and back, and every field that must be refused.
#include "engine/video/mrv_format.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "engine/video/byte_stream.h"
#include "tests/engine/video/random_links.h"

namespace haarmony::video::testing {
namespace {

// A clip of 4 frames of 16 x 16: rows time nodes, 3, 4.
MrvFront small_front() {
    MrvIndex index({{0, 0}, {1, 0}, {2, 1}}, 3);
    for (int row = 0; row < 3; ++row) {
        for (std::size_t i = 0; i < 3; ++i) {
            MrvChunk& chunk = index.chunk(row, i);
            if (row == 2 && i == 1) continue;  // an empty layer
            chunk.bytes = static_cast<std::uint32_t>(50 + 300 * row + i);
            chunk.checksum = 1000 * static_cast<std::uint64_t>(row) + i;
            if (row > 0) chunk.size = {1, static_cast<std::uint32_t>(2 + i)};
        }
    }
    return {.shape = *ClipShape::make({16, 16, {25, 1}}, 4),
            .delta = 3,
            .index = index,
            .file_bytes = 0,
            .revision = 0,
            .index_bytes = 0,
            .index_checksum = 0,
            .older = {}};
}

TEST(MrvFormat, FrontsComeBack) {
    MrvFront front = small_front();
    const std::vector<std::byte> bytes = encode_front(front);
    const Result<MrvFront> read = decode_front(bytes);
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_EQ((*read).shape, front.shape);
    EXPECT_EQ((*read).delta, 3U);
    EXPECT_EQ((*read).index, front.index);
    EXPECT_EQ((*read).file_bytes, front.file_bytes);
    EXPECT_EQ((*read).revision, front.revision);
    EXPECT_EQ((*read).index.find({1, 0}), 1U);
    EXPECT_FALSE((*read).index.find({2, 0}).has_value());
    EXPECT_EQ((*read).index.chunk(0, 0).offset, bytes.size());
}

TEST(MrvFormat, TheHeaderIsAsItIsDocumented) {
    MrvFront front = small_front();
    const std::vector<std::byte> bytes = encode_front(front);
    const auto number = [&bytes]<typename T>(std::size_t at, T) {
        T value;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    EXPECT_EQ(std::memcmp(bytes.data(), "HAARMRV\n", 8), 0);
    EXPECT_EQ(number(8, std::uint32_t{}), 2U);
    EXPECT_EQ(number(12, std::int32_t{}), 16);
    EXPECT_EQ(number(16, std::int32_t{}), 16);
    EXPECT_EQ(number(20, std::int32_t{}), 25);
    EXPECT_EQ(number(24, std::int32_t{}), 1);
    EXPECT_EQ(number(28, std::uint32_t{}), 3U);
    // The first slot, and nothing in the second.
    EXPECT_EQ(number(32, std::uint64_t{}), 1U);
    EXPECT_EQ(number(40, std::uint64_t{}), 96U);
    EXPECT_EQ(number(48, std::uint64_t{}),
              mrv_checksum(std::span(bytes).subspan(96, 40)));
    EXPECT_EQ(number(56, std::uint64_t{}), mrv_checksum(std::span(bytes).first(56)));
    EXPECT_EQ(front.revision, number(56, std::uint64_t{}));
    for (std::size_t at = 64; at < 96; ++at) EXPECT_EQ(bytes[at], std::byte{0});
    // The table's only record.
    EXPECT_EQ(number(96, std::int64_t{}), 4);
    EXPECT_EQ(number(104, std::uint64_t{}), 3U);
    EXPECT_EQ(number(112, std::uint64_t{}), bytes.size() - 136);
    EXPECT_EQ(number(120, std::uint64_t{}), front.file_bytes);
    EXPECT_EQ(number(128, std::uint64_t{}), mrv_checksum(std::span(bytes).subspan(136)));
}

void expect_refused(std::vector<std::byte> file, const std::string& what) {
    seal_front(file);
    const Result<MrvFront> read = decode_front(file);
    ASSERT_FALSE(read.has_value()) << what;
    EXPECT_EQ(read.error().code, ErrorCode::kUndecodable);
    EXPECT_NE(read.error().message.find(what), std::string::npos) << read.error().message;
}

template <typename T>
std::vector<std::byte> with(std::size_t at, T value) {
    MrvFront front = small_front();
    std::vector<std::byte> bytes = encode_front(front);
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return bytes;
}

TEST(MrvFormat, HeadersOutsideTheirLimitsAreRefused) {
    expect_refused(with(12, std::int32_t{0}), "width");
    expect_refused(with(16, std::int32_t{kMaxSide + 1}), "height");
    expect_refused(with(24, std::int32_t{0}), "rate");
    expect_refused(with(32, std::uint64_t{0}), "checksum of the header");
    expect_refused(with(32, std::uint64_t{3}), "generations are 3");
    expect_refused(with(40, std::uint64_t{95}), "table of generations cut off");
    expect_refused(with(40, ~std::uint64_t{0}), "table of generations cut off");
    expect_refused(with(96, std::int64_t{0}), "frames");
    expect_refused(with(104, std::uint64_t{1} << 40), "number of siblings");
    expect_refused(with(104, std::uint64_t{2}), "number of siblings");
    expect_refused(with(104, std::uint64_t{4}), "number of siblings");
    expect_refused(with(112, ~std::uint64_t{0}), "index cut off");
    expect_refused(with(120, ~std::uint64_t{0}), "chunks end at byte");
    MrvFront front = small_front();
    expect_refused(with(120, std::uint64_t{encode_front(front).size() + 60}),
                   "place of time level 1");
    expect_refused(with(120, std::uint64_t{140}), "end is 140");
}

// An index of numbers, behind a header that fits.
void expect_index_refused(const std::vector<std::uint64_t>& numbers,
                          std::size_t length,
                          std::uint64_t siblings,
                          const std::string& what) {
    MrvFront front = small_front();
    std::vector<std::byte> file = encode_front(front);
    const std::size_t index_at = kMrvHeaderBytes + kMrvRecordBytes;
    file.resize(index_at);
    for (const std::uint64_t number : numbers) put_varint(file, number);
    file.resize(index_at + length);
    const std::uint64_t bytes = length;
    std::memcpy(file.data() + 104, &siblings, sizeof siblings);
    std::memcpy(file.data() + 112, &bytes, sizeof bytes);
    expect_refused(file, what);
}

TEST(MrvFormat, IndexesThatContradictThemselvesAreRefused) {
    expect_index_refused({0, 0, 0}, 40, 0, "number of siblings");
    expect_index_refused({0, 1, 0}, 40, 1, "without their time-parent");
    expect_index_refused({2, 0, 0}, 40, 2, "outside of time level 0");
    expect_index_refused({1, 0, 1, 1}, 40, 2, "outside of time level 1");
    expect_index_refused({1, 0, 1, 0, 1, 2}, 40, 3, "outside of time level 2");
    expect_index_refused({1, 0, 0, 1, 0}, 40, 2, "without their time-parent");
    expect_index_refused({1, 0, 0, 0, 10}, 8, 1, "length");
    // One chunk of time nodes, then a layer of more nodes than refs can name.
    const auto with_layer = [](std::uint64_t nodes, std::uint64_t bytes) {
        return std::vector<std::uint64_t>{
            1, 0, 0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, nodes, 0, bytes};
    };
    expect_index_refused(with_layer(kMaxRefIndex + 2, 1), 60, 1, "size of time level 0");
    expect_index_refused(with_layer(kMaxRefIndex, 100), 60, 1, "expansion");
    expect_index_refused(with_layer(1, std::uint64_t{1} << 32), 60, 1, "place");
    expect_index_refused(with_layer(0, 0), 60, 1, "length");
}

TEST(MrvFormat, EveryCutFrontIsRefused) {
    MrvFront front = small_front();
    const std::vector<std::byte> bytes = encode_front(front);
    for (std::size_t length = 0; length < bytes.size(); ++length)
        EXPECT_FALSE(decode_front(std::span(bytes).first(length)).has_value()) << length;
}

}  // namespace
}  // namespace haarmony::video::testing
