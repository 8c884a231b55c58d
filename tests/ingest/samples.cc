#include "tests/ingest/samples.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <webp/encode.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#if defined(__SANITIZE_ADDRESS__)
// The HEVC encoder, which only these tests use, never gives all of its memory back.
extern "C" const char*
__lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { return "leak:libx265"; }
#endif

namespace haarmony::ingest {
namespace {

Bytes read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

Bytes write_samples(const void* samples,
                    OIIO::TypeDesc type,
                    int width,
                    int height,
                    int channels,
                    const OiioFile& file,
                    const std::function<const void*(int frame)>& frame_samples) {
    const ScratchFolder folder;
    const std::string path = folder.path("sample." + file.extension);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(path);
    EXPECT_NE(output, nullptr) << OIIO::geterror();
    if (!output) return {};
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc(file.type));
    if (file.straight_alpha) spec.attribute("oiio:UnassociatedAlpha", 1);
    if (file.orientation > 0) spec.attribute("Orientation", file.orientation);
    if (!file.compression.empty()) spec.attribute("compression", file.compression);
    if (!file.color_space.empty()) spec.attribute("oiio:ColorSpace", file.color_space);
    if (file.tile_side > 0) {
        spec.tile_width = file.tile_side;
        spec.tile_height = file.tile_side;
    }
    bool written = true;
    if (file.frames == 1) {
        written = output->open(path, spec) && output->write_image(type, samples);
    } else {
        const std::vector<OIIO::ImageSpec> specs(static_cast<std::size_t>(file.frames),
                                                 spec);
        written = output->open(path, file.frames, specs.data());
        for (int frame = 0; written && frame < file.frames; ++frame) {
            if (frame > 0) {
                written = output->open(path, spec, OIIO::ImageOutput::AppendSubimage);
            }
            written = written && output->write_image(type, frame_samples(frame));
        }
    }
    written = written && output->close();
    EXPECT_TRUE(written) << file.extension << ": " << output->geterror();
    return read_file(path);
}

void append_text(Bytes& bytes, std::string_view text) {
    bytes.insert(bytes.end(), text.begin(), text.end());
}

void append_bytes(Bytes& bytes, const Bytes& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
}

void append_chunk(Bytes& bytes, std::string_view type, const Bytes& content) {
    append_text(bytes, type);
    append(bytes, content.size(), 4, false);
    append_bytes(bytes, content);
    if (content.size() % 2 != 0) bytes.push_back(0);
}

Bytes riff(const Bytes& chunks) {
    Bytes file = text_bytes("RIFF");
    append(file, chunks.size() + 4, 4, false);
    append_text(file, "WEBP");
    append_bytes(file, chunks);
    return file;
}

// The VP8L chunk of a simple file, header and all.
Bytes webp_stream(const Raster& picture) {
    const Bytes file = write_webp(picture);
    return {file.begin() + 12, file.end()};
}

Bytes extended_header(int flags, int width, int height) {
    Bytes header;
    append(header, static_cast<std::uint64_t>(flags), 4, false);
    append(header, static_cast<std::uint64_t>(width - 1), 3, false);
    append(header, static_cast<std::uint64_t>(height - 1), 3, false);
    return header;
}

}  // namespace

void append(Bytes& bytes, std::uint64_t value, int count, bool big_endian) {
    for (int i = 0; i < count; ++i) {
        const int shift = 8 * (big_endian ? count - 1 - i : i);
        bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    }
}

Bytes text_bytes(std::string_view text) { return {text.begin(), text.end()}; }

Raster sample_picture(int width, int height, int channels) {
    Raster picture(width, height, channels);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            std::uint8_t* pixel = picture.row(y) + static_cast<std::size_t>(x) * channels;
            const bool patch = x < width / 3 && y < height / 4;
            const int red = width > 1 ? 20 + 200 * x / (width - 1) : 90;
            const int green = height > 1 ? 230 - 200 * y / (height - 1) : 60;
            pixel[0] = static_cast<std::uint8_t>(red);
            if (channels == 1) {
                pixel[0] = patch ? 240 : static_cast<std::uint8_t>((red + green) / 2);
                continue;
            }
            pixel[1] = static_cast<std::uint8_t>(green);
            pixel[2] = patch ? 220 : 40;
            if (channels == 4) {
                pixel[3] = static_cast<std::uint8_t>(
                    width > 1 ? 64 + 191 * x / (width - 1) : 99);
            }
        }
    }
    return picture;
}

Raster flat_picture(int width, int height, std::vector<std::uint8_t> color) {
    Raster picture(width, height, static_cast<int>(color.size()));
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        picture.pixels[i] = color[i % color.size()];
    }
    return picture;
}

int largest_difference(const Raster& a, const Raster& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.channels, b.channels);
    if (a.pixels.size() != b.pixels.size()) return 256;
    int largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        largest = std::max(largest, std::abs(a.pixels[i] - b.pixels[i]));
    }
    return largest;
}

double mean_difference(const Raster& a, const Raster& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.channels, b.channels);
    if (a.pixels.size() != b.pixels.size() || a.pixels.empty()) return 256;
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        sum += std::abs(a.pixels[i] - b.pixels[i]);
    }
    return sum / static_cast<double>(a.pixels.size());
}

Bytes write_with_oiio(const Raster& picture, const OiioFile& file) {
    std::vector<Raster> frames(static_cast<std::size_t>(file.frames), picture);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        for (std::uint8_t& sample : frames[i].pixels) {
            sample = static_cast<std::uint8_t>(sample >> i);
        }
    }
    return write_samples(
        picture.pixels.data(),
        OIIO::TypeDesc::UINT8,
        picture.width,
        picture.height,
        picture.channels,
        file,
        [&](int i) { return frames[static_cast<std::size_t>(i)].pixels.data(); });
}

Bytes write_floats_with_oiio(const std::vector<float>& samples,
                             int width,
                             int height,
                             int channels,
                             const OiioFile& file) {
    return write_samples(
        samples.data(), OIIO::TypeDesc::FLOAT, width, height, channels, file, [&](int) {
            return samples.data();
        });
}

Bytes write_webp(const Raster& picture) {
    std::uint8_t* encoded = nullptr;
    const int stride = static_cast<int>(picture.row_bytes());
    const std::size_t size =
        picture.channels == 4
            ? WebPEncodeLosslessRGBA(
                  picture.pixels.data(), picture.width, picture.height, stride, &encoded)
            : WebPEncodeLosslessRGB(
                  picture.pixels.data(), picture.width, picture.height, stride, &encoded);
    EXPECT_GT(size, 0u);
    Bytes bytes(encoded, encoded + size);
    WebPFree(encoded);
    return bytes;
}

Bytes write_webp_with_exif(const Raster& picture, const Bytes& exif) {
    Bytes chunks;
    append_chunk(
        chunks,
        "VP8X",
        extended_header(
            0x08 | (picture.channels == 4 ? 0x10 : 0), picture.width, picture.height));
    append_bytes(chunks, webp_stream(picture));
    append_chunk(chunks, "EXIF", exif);
    return riff(chunks);
}

Bytes write_animated_webp(const std::vector<Raster>& frames,
                          int canvas_width,
                          int canvas_height) {
    Bytes chunks;
    append_chunk(chunks, "VP8X", extended_header(0x12, canvas_width, canvas_height));
    append_chunk(chunks, "ANIM", Bytes(6, 0));
    for (const Raster& frame : frames) {
        Bytes content;
        append(content, 1, 3, false);  // in units of two pixels
        append(content, 1, 3, false);
        append(content, static_cast<std::uint64_t>(frame.width - 1), 3, false);
        append(content, static_cast<std::uint64_t>(frame.height - 1), 3, false);
        append(content, 100, 3, false);
        content.push_back(0);
        append_bytes(content, webp_stream(frame));
        append_chunk(chunks, "ANMF", content);
    }
    return riff(chunks);
}

Bytes exif_tiff(int orientation, bool big_endian) {
    Bytes tiff = text_bytes(big_endian ? "MM" : "II");
    append(tiff, 42, 2, big_endian);
    append(tiff, 8, 4, big_endian);
    append(tiff, 2, 2, big_endian);
    append(tiff, 271, 2, big_endian);  // Make, ASCII
    append(tiff, 2, 2, big_endian);
    append(tiff, 2, 4, big_endian);
    append_text(tiff, std::string_view("A\0\0\0", 4));
    append(tiff, 274, 2, big_endian);  // Orientation, SHORT
    append(tiff, 3, 2, big_endian);
    append(tiff, 1, 4, big_endian);
    append(tiff, static_cast<std::uint64_t>(orientation), 2, big_endian);
    append(tiff, 0, 2, big_endian);
    append(tiff, 0, 4, big_endian);  // no further directory
    return tiff;
}

Bytes exif_segment(int orientation, bool big_endian) {
    Bytes segment = text_bytes(std::string_view("Exif\0\0", 6));
    append_bytes(segment, exif_tiff(orientation, big_endian));
    return segment;
}

Bytes insert_png_chunk(const Bytes& png, std::string_view type, const Bytes& content) {
    constexpr std::ptrdiff_t kAfterHeader = 8 + 12 + 13;
    Bytes named = text_bytes(type);
    append_bytes(named, content);
    Bytes chunk;
    append(chunk, content.size(), 4, true);
    append_bytes(chunk, named);
    append(chunk, crc32(0, named.data(), static_cast<uInt>(named.size())), 4, true);
    Bytes result(png.begin(), png.begin() + kAfterHeader);
    append_bytes(result, chunk);
    result.insert(result.end(), png.begin() + kAfterHeader, png.end());
    return result;
}

Bytes png_header(std::uint32_t width, std::uint32_t height) {
    Bytes header = text_bytes("IHDR");
    append(header, width, 4, true);
    append(header, height, 4, true);
    append_text(header, std::string_view("\x08\x02\0\0\0", 5));
    Bytes png = text_bytes("\x89PNG\r\n\x1a\n");
    append(png, 13, 4, true);
    append_bytes(png, header);
    append(png, crc32(0, header.data(), static_cast<uInt>(header.size())), 4, true);
    return png;
}

const std::vector<SampleFile>& sample_files() {
    static const std::vector<SampleFile> files = [] {
        const Raster rgb = sample_picture(64, 48, 3);
        OiioFile heic{.extension = "heic"};
        heic.compression = "heic:95";
        OiioFile avif{.extension = "avif"};
        avif.compression = "avif:95";
        return std::vector<SampleFile>{
            {Format::kJpeg, write_jpeg(rgb, {})},
            {Format::kPng, write_with_oiio(rgb, {.extension = "png"})},
            {Format::kGif, write_with_oiio(rgb, {.extension = "gif"})},
            {Format::kWebp, write_webp(rgb)},
            {Format::kTiff, write_with_oiio(rgb, {.extension = "tif"})},
            {Format::kHeif, write_with_oiio(rgb, heic)},
            {Format::kAvif, write_with_oiio(rgb, avif)},
            {Format::kBmp, write_with_oiio(rgb, {.extension = "bmp"})},
            {Format::kJpeg2000, write_with_oiio(rgb, {.extension = "jp2"})},
            {Format::kOpenExr,
             write_with_oiio(rgb, {.extension = "exr", .type = "half"})},
        };
    }();
    return files;
}

Decoder& shared_decoder() {
    static Decoder decoder({});
    return decoder;
}

Raster raster_of(const Picture& picture) {
    Raster raster(picture.pixel_width, picture.pixel_height, picture.channels);
    EXPECT_EQ(raster.pixels.size(), picture.pixels.size());
    raster.pixels = picture.pixels;
    return raster;
}

ScratchFolder::ScratchFolder() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "haarmony-test-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) ADD_FAILURE() << "mkdtemp " << pattern;
    folder_ = pattern;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::string ScratchFolder::path(std::string_view name) const {
    return folder_ + "/" + std::string(name);
}

}  // namespace haarmony::ingest
