#include "server/app/snapshot_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

namespace haarmony::server {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

SnapshotTable some_table() {
    SnapshotTable table;
    table.token = {1, 2, 3};
    table.sequence = 77;
    table.index_m = 60;
    table.variants = {"yiq-standard", "lab", ""};
    for (std::uint32_t i = 0; i < 3; ++i) {
        SnapshotPart part;
        part.variant = 2 - i;
        part.counts = {60, 100 + i, {1, 2, 3 + i}, 4, 5, 6};
        part.segment_bytes = 4000 + 100 * i;
        part.segment_checksum = 11 + i;
        part.has_removed = i == 1;
        part.removed_checksum = i == 1 ? 99 : 0;
        table.parts.push_back(part);
    }
    table.damaged = {ImageId{5}, ImageId{6}};
    return table;
}

// The whole file, its parts being zeros.
Bytes file_of(const SnapshotTable& table) {
    Bytes bytes = encode_table(table);
    bytes.resize(table.file_bytes());
    return bytes;
}

// Puts a number into the header and a checksum over it, as a program would that writes other
// files than this one.
template <typename T>
void put_in_header(Bytes& file, std::size_t offset, T value) {
    std::memcpy(file.data() + offset, &value, sizeof value);
    const std::uint64_t sum = snapshot_checksum(std::span(file).first(88));
    std::memcpy(file.data() + 88, &sum, sizeof sum);
}
// The same of the table behind it.
template <typename T>
void put_in_table(Bytes& file, std::size_t offset, T value) {
    std::memcpy(file.data() + offset, &value, sizeof value);
    const std::uint64_t sum =
        snapshot_checksum(std::span(file).subspan(96, kSnapshotAlignment - 96));
    put_in_header(file, 80, sum);
}

void expect_refused(const Bytes& file, ErrorCode code, const std::string& named) {
    const Result<SnapshotTable> table = decode_table(file);
    ASSERT_FALSE(table) << named;
    EXPECT_EQ(table.error().code, code) << table.error().message;
    EXPECT_THAT(table.error().message, HasSubstr(named));
}
void expect_damaged(const Bytes& file, const std::string& named) {
    expect_refused(file, ErrorCode::kUndecodable, named);
}

TEST(SnapshotFormat, TablesComeBack) {
    const SnapshotTable table = some_table();
    const Result<SnapshotTable> again = decode_table(file_of(table));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again.value(), table);
    SnapshotTable empty;
    empty.index_m = 20;
    const Result<SnapshotTable> nothing = decode_table(file_of(empty));
    ASSERT_TRUE(nothing) << nothing.error().message;
    EXPECT_EQ(nothing.value(), empty);
    EXPECT_EQ(empty.file_bytes(), kSnapshotAlignment);
}

TEST(SnapshotFormat, PartsBeginAtPagesOneAfterAnother) {
    const SnapshotTable table = some_table();
    EXPECT_EQ(table.parts_begin(), kSnapshotAlignment);
    EXPECT_EQ(table.parts[1].removed_bytes(), 16U);
    EXPECT_EQ(table.parts[0].extent(), kSnapshotAlignment);
    EXPECT_EQ(table.parts[1].extent(), 3 * kSnapshotAlignment);
    EXPECT_EQ(table.file_bytes(), 7 * kSnapshotAlignment);
}

TEST(SnapshotFormat, AnyBitOfHeaderAndTableCounts) {
    const Bytes file = file_of(some_table());
    for (std::size_t bit = 0; bit < kSnapshotAlignment * 8; ++bit) {
        Bytes changed = file;
        changed[bit / 8] ^= std::byte(1 << (bit % 8));
        ASSERT_FALSE(decode_table(changed)) << "bit " << bit;
    }
}

TEST(SnapshotFormat, AnyLengthButItsOwnIsRefused) {
    const Bytes file = file_of(some_table());
    for (std::size_t size = 0; size < file.size(); size += size < 8192 ? 1 : 97) {
        ASSERT_FALSE(decode_table(std::span(file).first(size))) << size;
    }
    Bytes longer = file;
    longer.push_back({});
    expect_damaged(longer, "bytes of " + std::to_string(file.size()));
}

TEST(SnapshotFormat, WhatIsNoSnapshotIsSaidToBeNone) {
    expect_damaged({}, "it has only 0 bytes");
    expect_damaged(Bytes(95), "it has only 95 bytes");
    expect_refused(Bytes(4096), ErrorCode::kUnsupportedFormat, "no snapshot");
}

// Before anything else, since another version may have another header.
TEST(SnapshotFormat, OtherVersionsAreNamed) {
    Bytes file = file_of(some_table());
    file[8] = std::byte{2};
    expect_refused(file, ErrorCode::kNewerVersion, "version 2, not 1");
    file = file_of(some_table());
    put_in_header(file, 12, image::kSegmentLayoutVersion + 1);
    expect_refused(file,
                   ErrorCode::kNewerVersion,
                   "layout " + std::to_string(image::kSegmentLayoutVersion + 1));
}

// What a wrong writer, or somebody who can compute checksums, may put there.
TEST(SnapshotFormat, ImpossibleNumbersAreRefusedWhateverTheChecksumSays) {
    const auto header = [](std::size_t offset, auto value, const std::string& named) {
        Bytes file = file_of(some_table());
        put_in_header(file, offset, value);
        expect_damaged(file, named);
    };
    constexpr auto kHuge = std::numeric_limits<std::uint64_t>::max();
    for (const std::uint32_t variants : {0U, 2U, 4U, 0xffffffffU})
        header(44, variants, "");
    for (const std::uint64_t parts : {std::uint64_t{0}, std::uint64_t{4}, kHuge})
        header(48, parts, "");
    for (const std::uint64_t damaged : {std::uint64_t{0}, std::uint64_t{3}, kHuge})
        header(56, damaged, "its table has");
    for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{9}, kHuge})
        header(64, bytes, "table");
    for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{96}, kHuge})
        header(72, bytes, "bytes of " + std::to_string(bytes));

    const auto part = [](std::size_t offset, auto value, const std::string& named) {
        Bytes file = file_of(some_table());
        // Behind the header and the three names.
        put_in_table(file, 96 + 3 * 4 + 12 + 3 + offset, value);
        expect_damaged(file, named);
    };
    part(0, std::uint32_t{3}, "a part is of variant 3");
    part(4, std::uint32_t{2}, "a part has flags 2");
    part(28, std::uint32_t{1}, "a part has flags 0");
    part(48, std::uint64_t{4097}, "end");
    part(48, kHuge, "reaches beyond its end");
    Bytes name = file_of(some_table());
    put_in_table(name, 96, std::uint32_t{0xffffffff});
    expect_damaged(name, "its table has");
}

TEST(SnapshotFormat, ChecksumsOfPiecesAreThatOfTheWhole) {
    const Bytes bytes = encode_table(some_table());
    for (const std::size_t piece : {1, 7, 1000, 4096, 5000}) {
        SnapshotChecksum sum;
        for (std::size_t at = 0; at < bytes.size(); at += piece)
            sum.add(std::span(bytes).subspan(at, std::min(piece, bytes.size() - at)));
        EXPECT_EQ(sum.value(), snapshot_checksum(bytes)) << piece;
    }
}

}  // namespace
}  // namespace haarmony::server
