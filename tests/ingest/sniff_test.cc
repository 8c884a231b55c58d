#include "ingest/sniff.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <tuple>

#include "tests/ingest/samples.h"

namespace haarmony::ingest {
namespace {

std::string media_type_of(const Bytes& bytes) {
    const auto type = sniff(bytes);
    return type ? std::string(type->media_type) : "";
}

TEST(Sniff, KnowsEveryFormatThatItsWriterMakes) {
    ASSERT_EQ(sample_files().size(), formats().size());
    for (const SampleFile& file : sample_files()) {
        const auto type = sniff(file.bytes);
        ASSERT_TRUE(type) << describe_format(file.format).name;
        EXPECT_EQ(type->format, file.format);
        EXPECT_EQ(type->name, describe_format(file.format).name);
        EXPECT_EQ(type->media_type, describe_format(file.format).media_type);
    }
}

TEST(Sniff, TheFirstBytesAreEnough) {
    for (const SampleFile& file : sample_files()) {
        const std::size_t count = std::min(file.bytes.size(), kSniffBytes);
        const auto type = sniff(std::span(file.bytes).first(count));
        ASSERT_TRUE(type);
        EXPECT_EQ(type->format, file.format);
    }
}

TEST(Sniff, NamesWhatItKnowsAndDoesNotRead) {
    using std::string_view_literals::operator""sv;
    const std::vector<std::tuple<std::string_view, std::string>> cases = {
        {"%PDF-1.7\n", "application/pdf"},
        {"%!PS-Adobe-3.0", "application/postscript"},
        {"8BPS\0\1"sv, "image/vnd.adobe.photoshop"},
        {"gimp xcf v011", "image/x-xcf"},
        {"#?RADIANCE\n", "image/vnd.radiance"},
        {"\xff\x0a\x00\x10"sv, "image/jxl"},
        {"\0\0\0\x0cJXL \r\n\x87\n"sv, "image/jxl"},
        {"II*\0\x10\0\0\0CR\x02\0"sv, "image/x-canon-cr2"},
        {"\0\0\0\x18"
         "ftypcrx \0\0\0\1crx isom"sv,
         "image/x-canon-cr3"},
        {"\0\0\x01\0\1\0"sv, "image/vnd.microsoft.icon"},
        {"PK\x03\x04", "application/zip"},
        {"\x1f\x8b\x08", "application/gzip"},
        {"\0\0\0\x18"
         "ftypisom\0\0\0\1isomavc1"sv,
         "video/mp4"},
        {"\0\0\0\x14"
         "ftypqt  \0\0\0\0qt  "sv,
         "video/quicktime"},
        {"\x1a\x45\xdf\xa3\x01", "video/x-matroska"},
        {"RIFF\0\0\0\0AVI LIST"sv, "video/x-msvideo"},
        {"RIFF\0\0\0\0WAVEfmt "sv, "audio/wav"},
        {"OggS\0\2"sv, "application/ogg"},
        {"ID3\4", "audio/mpeg"},
        {"<!DOCTYPE html><html>", "text/html"},
        {"\n  <HTML lang=en>", "text/html"},
        {"<!-- page -->\n<html>", "text/html"},
        {"<!doctype html><html><body><svg/></body></html>", "text/html"},
        {"<svg xmlns='http://www.w3.org/2000/svg'/>", "image/svg+xml"},
        {"\xef\xbb\xbf<?xml version='1.0'?>\n<svg/>", "image/svg+xml"},
        {"<?xml version='1.0'?><feed/>", "application/xml"},
        {"BMW drivers of the world, unite at dawn!", "text/plain"},
        {"GIF is a format", "text/plain"},
    };
    for (const auto& [bytes, media_type] : cases) {
        const auto type = sniff(text_bytes(bytes));
        ASSERT_TRUE(type) << media_type;
        EXPECT_EQ(type->media_type, media_type);
        EXPECT_FALSE(type->format) << media_type;
    }
}

TEST(Sniff, NeutralBrandIsDecidedByTheCompatibleOnes) {
    using std::string_view_literals::operator""sv;
    EXPECT_EQ(media_type_of(text_bytes("\0\0\0\x18"
                                       "ftypmif1\0\0\0\0mif1heic"sv)),
              "image/heic");
    EXPECT_EQ(media_type_of(text_bytes("\0\0\0\x18"
                                       "ftypmif1\0\0\0\0miafavif"sv)),
              "image/avif");
    // What follows the box is none of its brands.
    EXPECT_EQ(media_type_of(text_bytes("\0\0\0\x14"
                                       "ftypisom\0\0\0\0isomavif"sv)),
              "video/mp4");
}

TEST(Sniff, RandomAndEmptyBytesHaveNoType) {
    EXPECT_FALSE(sniff({}));
    EXPECT_FALSE(sniff(Bytes{0}));
    std::mt19937 random(7);
    for (int i = 0; i < 200; ++i) {
        Bytes bytes(600);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
        bytes[0] = 0x01;  // no magic begins so
        EXPECT_FALSE(sniff(bytes)) << i;
    }
}

TEST(Sniff, ExtensionsCountInAnyCaseAndOnlyAtTheEnd) {
    for (const std::string_view name :
         {"a.jpg", "A.JPEG", "x.y.PnG", "a.tif", "a.HEIC", "a.avif", ".webp"}) {
        EXPECT_TRUE(has_picture_extension(name)) << name;
    }
    for (const std::string_view name : {"a",
                                        "a.",
                                        "a.txt",
                                        "a.jpg.txt",
                                        "jpg",
                                        "a.jp",
                                        "a.tif tiff",
                                        "",
                                        "a.jpg jpeg"}) {
        EXPECT_FALSE(has_picture_extension(name)) << name;
    }
}

}  // namespace
}  // namespace haarmony::ingest
