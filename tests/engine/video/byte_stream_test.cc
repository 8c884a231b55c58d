// Numbers of a file.
#include "engine/video/byte_stream.h"

#include <gtest/gtest.h>

#include <array>

namespace haarmony::video {
namespace {

TEST(ByteStream, VarintsComeBack) {
    for (int bits = 0; bits <= 64; ++bits) {
        for (const std::uint64_t off : {std::uint64_t{0}, ~std::uint64_t{0}}) {
            const std::uint64_t value = (bits == 64 ? 0 : std::uint64_t{1} << bits) + off;
            std::vector<std::byte> bytes;
            put_varint(bytes, value);
            ByteReader in(bytes);
            EXPECT_EQ(in.varint(), value);
            EXPECT_TRUE(in.rest().empty());
            EXPECT_FALSE(in.overrun());
        }
    }
}

TEST(ByteStream, BytesAreTakenFromTheFront) {
    const std::array<std::byte, 3> bytes{std::byte{5}, std::byte{6}, std::byte{7}};
    ByteReader in(bytes);
    EXPECT_EQ(in.take(2).data(), bytes.data());
    EXPECT_EQ(in.varint(), 7U);
    EXPECT_TRUE(in.take(0).empty());
    EXPECT_FALSE(in.overrun());
}

TEST(ByteStream, ReadingPastTheEndIsNoticed) {
    const std::array<std::byte, 3> bytes{
        std::byte{0x81}, std::byte{0x80}, std::byte{0x80}};
    ByteReader open_ended(bytes);
    EXPECT_EQ(open_ended.varint(), 0U);
    EXPECT_TRUE(open_ended.overrun());
    ByteReader in(bytes);
    EXPECT_EQ(in.fixed<std::uint32_t>(), 0U);
    EXPECT_TRUE(in.overrun());
    EXPECT_TRUE(in.rest().empty());
}

TEST(ByteStream, AVarintOfMoreThan64BitsIsNone) {
    std::vector<std::byte> bytes(9, std::byte{0xFF});
    bytes.push_back(std::byte{0x02});
    ByteReader in(bytes);
    EXPECT_EQ(in.varint(), 0U);
    EXPECT_TRUE(in.overrun());
}

}  // namespace
}  // namespace haarmony::video
