#include "ingest/oiio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "ingest/dimensions.h"
#include "ingest/one_line.h"
#include "ingest/transfer.h"

namespace haarmony::ingest {
namespace {

// Rows converted at a time: float rows of a whole large picture would not fit beside it.
constexpr int kRows = 64;

// No file of this name is ever opened: the bytes come through the proxy.
constexpr const char* kNeutralName = "picture";

void configure_library() {
    static const bool done = [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", -1);  // -1 = none, 0 = one for each core
        return true;
    }();
    static_cast<void>(done);
}

const char* reader_name(Format format) {
    switch (format) {
        case Format::kGif:
            return "gif";
        case Format::kTiff:
            return "tiff";
        case Format::kHeif:
        case Format::kAvif:
            return "heif";
        case Format::kBmp:
            return "bmp";
        case Format::kJpeg2000:
            return "jpeg2000";
        case Format::kOpenExr:
            return "openexr";
        case Format::kJpeg:
        case Format::kPng:
        case Format::kWebp:
            break;
    }
    return "";
}

Error undecodable(Format format, const std::string& reason) {
    const std::string text = one_line(reason);
    return {ErrorCode::kUndecodable,
            "damaged " + std::string(describe_format(format).name) + ": " +
                (text.empty() ? "its reader gave no reason" : text)};
}

// The error of the reader and of the library, both of which must be fetched to be cleared.
std::string pending_error(const OIIO::ImageInput* input) {
    std::string text = input != nullptr ? input->geterror() : std::string();
    const std::string global = OIIO::geterror();
    return text.empty() ? global : text;
}

// How the channels of the file become ours.
struct Channels {
    int read = 0;    // channels [0, read) are read
    int color = 0;   // 1 (grey) or 3
    int alpha = -1;  // index of alpha in a pixel as read, -1 = opaque
    [[nodiscard]] int out() const { return alpha < 0 ? color : 4; }
};

Channels choose_channels(const OIIO::ImageSpec& spec) {
    const int count = spec.nchannels;
    const bool grey = count < 3 || spec.channelnames[0] == "Y";
    Channels channels;
    channels.color = grey ? 1 : 3;
    // The GIF reader says 4 of 4 channels, one beyond the end, and means the last one.
    const int said = std::min(spec.alpha_channel, count - 1);
    if (said == channels.color) channels.alpha = said;
    channels.read = channels.alpha < 0 ? channels.color : channels.alpha + 1;
    return channels;
}

bool is_linear(const OIIO::ImageSpec& spec) {
    const std::string space = spec.get_string_attribute("oiio:ColorSpace");
    if (OIIO::Strutil::iequals(space, "linear")) return true;
    return spec.format.is_floating_point() && !OIIO::Strutil::iequals(space, "sRGB");
}

bool is_premultiplied(Format format, const OIIO::ImageSpec& spec) {
    if (format == Format::kOpenExr) return true;
    // Asked for straight alpha, its TIFF reader says so where it could oblige; the other
    // readers give what the file has, which is straight by definition of these formats.
    return format == Format::kTiff &&
           spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0;
}

// Rows [y, y + count) of the picture as `type`, counted from its own top.
bool read_rows(OIIO::ImageInput& input,
               const Channels& channels,
               int y,
               int count,
               OIIO::TypeDesc type,
               void* rows) {
    const OIIO::ImageSpec& spec = input.spec();
    const int top = spec.y + y;
    if (spec.tile_width == 0) {
        return input.read_scanlines(
            0, 0, top, top + count, spec.z, 0, channels.read, type, rows);
    }
    return input.read_tiles(0,
                            0,
                            spec.x,
                            spec.x + spec.width,
                            top,
                            top + count,
                            spec.z,
                            spec.z + 1,
                            0,
                            channels.read,
                            type,
                            rows);
}

std::uint8_t divide(unsigned color, unsigned alpha) {
    if (alpha == 0) return 0;
    return static_cast<std::uint8_t>(std::min(255u, (color * 255 + alpha / 2) / alpha));
}

void store_pixel(const Channels& channels,
                 const std::uint8_t* pixel,
                 bool premultiplied,
                 std::uint8_t* out) {
    const unsigned alpha = channels.alpha < 0 ? 255 : pixel[channels.alpha];
    for (int i = 0; i < std::min(3, channels.out()); ++i) {
        const std::uint8_t color = pixel[channels.color == 1 ? 0 : i];
        out[i] = premultiplied ? divide(color, alpha) : color;
    }
    if (channels.alpha >= 0) out[3] = static_cast<std::uint8_t>(alpha);
}

void store_pixel(const Channels& channels,
                 const float* pixel,
                 bool premultiplied,
                 std::uint8_t* out) {
    float alpha = channels.alpha < 0 ? 1.0f : pixel[channels.alpha];
    if (!(alpha > 0)) alpha = 0;  // not-a-number too
    alpha = std::min(alpha, 1.0f);
    for (int i = 0; i < std::min(3, channels.out()); ++i) {
        float color = pixel[channels.color == 1 ? 0 : i];
        if (premultiplied && channels.alpha >= 0)
            color = alpha > 0 ? color / alpha : 0.0f;
        out[i] = linear_to_srgb(color);
    }
    if (channels.alpha >= 0) out[3] = static_cast<std::uint8_t>(alpha * 255 + 0.5f);
}

template <typename Sample>
bool convert_picture(OIIO::ImageInput& input,
                     const Channels& channels,
                     OIIO::TypeDesc type,
                     bool premultiplied,
                     Raster& raster) {
    // Tiles are read in whole rows of tiles.
    const int tile = std::max(1, input.spec().tile_height);
    const int step = (kRows + tile - 1) / tile * tile;
    const std::size_t row_samples =
        static_cast<std::size_t>(raster.width) * channels.read;
    std::vector<Sample> rows(row_samples * std::min(step, raster.height));
    for (int y = 0; y < raster.height; y += step) {
        const int count = std::min(step, raster.height - y);
        if (!read_rows(input, channels, y, count, type, rows.data())) return false;
        for (int i = 0; i < count; ++i) {
            const Sample* pixel = rows.data() + i * row_samples;
            std::uint8_t* out = raster.row(y + i);
            for (int x = 0; x < raster.width; ++x) {
                store_pixel(channels, pixel, premultiplied, out);
                pixel += channels.read;
                out += raster.channels;
            }
        }
    }
    return true;
}

// Windows bitmaps of 32 bits a pixel mostly leave the fourth byte at zero and mean opaque.
void drop_empty_alpha(Raster& raster) {
    const std::size_t count = raster.pixels.size() / 4;
    for (std::size_t i = 0; i < count; ++i) {
        if (raster.pixels[4 * i + 3] != 0) return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        std::copy_n(raster.pixels.begin() + 4 * i, 3, raster.pixels.begin() + 3 * i);
    }
    raster.pixels.resize(count * 3);
    raster.channels = 3;
}

Result<Raster> read_picture(OIIO::ImageInput& input,
                            Format format,
                            std::int64_t max_pixels) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) {
        return undecodable(format, "it has no pixels");
    }
    if (spec.depth > 1 || spec.deep) {
        return undecodable(format, "volumes and deep pictures are not read");
    }
    const auto fits = check_pixels({spec.width, spec.height}, max_pixels);
    if (!fits) return fits.error();

    const Channels channels = choose_channels(spec);
    const bool premultiplied = is_premultiplied(format, spec);
    Raster raster(spec.width, spec.height, channels.out());
    const bool read =
        is_linear(spec)
            ? convert_picture<float>(
                  input, channels, OIIO::TypeDesc::FLOAT, premultiplied, raster)
            : convert_picture<std::uint8_t>(
                  input, channels, OIIO::TypeDesc::UINT8, premultiplied, raster);
    // Some readers say true and leave the rest of the picture grey.
    const std::string error = pending_error(&input);
    if (!read || !error.empty()) return undecodable(format, error);
    if (format == Format::kBmp && raster.channels == 4) drop_empty_alpha(raster);
    return raster;
}

Result<Raster> open_and_read(const OiioSource& source, std::int64_t max_pixels) {
    const bool wants_file =
        source.format == Format::kHeif || source.format == Format::kAvif;
    const std::unique_ptr<OIIO::ImageInput> input =
        OIIO::ImageInput::create(reader_name(source.format));
    if (!input) return undecodable(source.format, pending_error(nullptr));

    // The proxy only reads; its constructor predates const.
    OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(source.bytes.data()),
                                         source.bytes.size());
    OIIO::Filesystem::IOProxy* proxy = &memory;
    OIIO::ImageSpec wish;
    wish.attribute("oiio:UnassociatedAlpha", 1);
    std::string name = kNeutralName;
    if (wants_file) {
        name = "/proc/self/fd/" + std::to_string(source.fd);
    } else {
        wish.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    }
    OIIO::ImageSpec spec;
    if (!input->open(name, spec, wish)) {
        return undecodable(source.format, pending_error(input.get()));
    }
    Result<Raster> raster = read_picture(*input, source.format, max_pixels);
    input->close();
    static_cast<void>(pending_error(input.get()));
    return raster;
}

}  // namespace

Result<Raster> decode_oiio(const OiioSource& source, std::int64_t max_pixels) {
    configure_library();
    try {
        return open_and_read(source, max_pixels);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::kTooLarge,
                     "decoding this " + std::string(describe_format(source.format).name) +
                         " needs more memory than it may have"};
    } catch (const std::exception& exception) {
        return undecodable(source.format, exception.what());
    } catch (...) {
        return undecodable(source.format, "its reader failed");
    }
}

}  // namespace haarmony::ingest
