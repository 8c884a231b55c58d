// HEIF keeps the turn of a picture in its container (irot); libheif applies it, and nobody
// may apply an orientation a second time.
#include <gtest/gtest.h>

#include <algorithm>

#include "ingest/orientation.h"
#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

std::size_t find_box(const Bytes& file, std::string_view type) {
    const auto at = std::search(file.begin(), file.end(), type.begin(), type.end());
    EXPECT_NE(at, file.end()) << type;
    return static_cast<std::size_t>(at - file.begin()) - 4;
}

std::uint32_t u32(const Bytes& file, std::size_t at) {
    return static_cast<std::uint32_t>(file[at]) << 24 | file[at + 1] << 16 |
           file[at + 2] << 8 | file[at + 3];
}

void put_u32(Bytes& file, std::size_t at, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) {
        file[at + static_cast<std::size_t>(i)] =
            static_cast<std::uint8_t>(value >> (24 - 8 * i));
    }
}

// The file with a turn by `quarters` against the clock, as a further property of its only
// item: a box at the end of ipco, and its index at the end of ipma. All that follows moves.
Bytes with_turn(Bytes file, int quarters) {
    constexpr std::uint32_t kBox = 9;
    constexpr std::uint32_t kIndex = 1;
    const std::uint32_t media = static_cast<std::uint32_t>(find_box(file, "mdat")) + 8;
    const std::size_t location = find_box(file, "iloc");
    std::size_t moved = 0;
    for (std::size_t at = location; at < location + u32(file, location) - 3; ++at) {
        if (u32(file, at) != media) continue;
        put_u32(file, at, media + kBox + kIndex);
        ++moved;
    }
    EXPECT_EQ(moved, 1u) << "places in iloc that name the first byte of the media";

    const std::size_t container = find_box(file, "ipco");
    const std::size_t association = find_box(file, "ipma");
    std::uint8_t properties = 0;
    for (std::size_t at = container + 8; at < container + u32(file, container);
         at += u32(file, at)) {
        ++properties;
    }
    for (const auto& [type, growth] : {std::pair("meta", kBox + kIndex),
                                       std::pair("iprp", kBox + kIndex),
                                       std::pair("ipco", kBox),
                                       std::pair("ipma", kIndex)}) {
        const std::size_t box = find_box(file, type);
        put_u32(file, box, u32(file, box) + growth);
    }
    // Size, type, version and flags, count of items, id of the item: then the associations.
    std::uint8_t& count = file[association + 18];
    ++count;
    file.insert(file.begin() + static_cast<std::ptrdiff_t>(association) + 18 + count,
                static_cast<std::uint8_t>(0x80 | (properties + 1)));
    Bytes turn;
    append(turn, kBox, 4, true);
    const Bytes name = text_bytes("irot");
    turn.insert(turn.end(), name.begin(), name.end());
    turn.push_back(static_cast<std::uint8_t>(quarters));
    const std::size_t end = container + u32(file, container) - kBox;
    file.insert(
        file.begin() + static_cast<std::ptrdiff_t>(end), turn.begin(), turn.end());
    return file;
}

TEST(HeifTurn, IsAppliedOnce) {
    // A multiple of the coding block in both directions: no clean aperture to turn as well.
    const Raster picture = sample_picture(128, 64, 3);
    const Bytes file = write_with_oiio(
        picture, {.extension = "heic", .type = "uint8", .compression = "heic:95"});
    // Against the clock by 0, 90, 180, 270 degrees, in terms of EXIF.
    const int as_orientation[] = {1, 8, 3, 6};
    for (int quarters = 0; quarters < 4; ++quarters) {
        const Bytes turned = with_turn(file, quarters);
        const auto decoded = shared_decoder().decode(turned);
        ASSERT_TRUE(decoded) << quarters << ": " << decoded.error().message;
        const Raster expected = upright(picture, as_orientation[quarters]);
        EXPECT_EQ(decoded->width, expected.width) << quarters;
        EXPECT_EQ(decoded->height, expected.height) << quarters;
        EXPECT_LE(mean_difference(raster_of(*decoded), expected), 5) << quarters;
    }
}

TEST(HeifTurn, AnExifOrientationBesideItIsIgnored) {
    const Raster picture = sample_picture(128, 64, 3);
    const Bytes file = write_with_oiio(picture,
                                       {.extension = "heic",
                                        .type = "uint8",
                                        .compression = "heic:95",
                                        .straight_alpha = true,
                                        .orientation = 6});
    EXPECT_EQ(exif_orientation(Format::kHeif, file), 1);
    const auto decoded = shared_decoder().decode(file);
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_LE(mean_difference(raster_of(*decoded), picture), 5);
}

}  // namespace
}  // namespace haarmony::ingest
