#include "ingest/picture_encoder.h"

#include <png.h>
#include <webp/encode.h>
#include <zlib.h>

#include <cassert>
#include <csetjmp>
#include <memory>
#include <string>
#include <utility>

namespace haarmony::ingest {
namespace {

std::string size_of(const ImageView& picture) {
    return std::to_string(picture.width) + " x " + std::to_string(picture.height) +
           " pixels";
}

// libpng's view of one encoding; its errors jump back instead of ending the process.
struct PngSession {
    ~PngSession() { png_destroy_write_struct(&png, &info); }

    png_structp png = nullptr;
    png_infop info = nullptr;
    std::string message;
    std::vector<std::uint8_t> bytes;
};

[[noreturn]] void png_failed(png_structp png, png_const_charp message) {
    static_cast<PngSession*>(png_get_error_ptr(png))->message = message;
    png_longjmp(png, 1);
}

void png_warned(png_structp /*png*/, png_const_charp /*message*/) {}

void take_bytes(png_structp png, png_bytep bytes, png_size_t size) {
    auto& session = *static_cast<PngSession*>(png_get_io_ptr(png));
    session.bytes.insert(session.bytes.end(), bytes, bytes + size);
}

void flush_nothing(png_structp /*png*/) {}

bool writes(PngSession& session, const ImageView& picture) {
    if (setjmp(png_jmpbuf(session.png)) != 0) return false;
    const bool alpha = picture.channels == 4 && has_transparency(picture);
    png_set_write_fn(session.png, &session, take_bytes, flush_nothing);
    png_set_compression_level(session.png, 1);
    // From the row above: of squares of films a quarter less time and a fifth fewer bytes
    // than from the left. All filters at level 6 take five to eight times as long, for a
    // tenth fewer.
    png_set_filter(session.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_IHDR(session.png,
                 session.info,
                 static_cast<png_uint_32>(picture.width),
                 static_cast<png_uint_32>(picture.height),
                 8,
                 alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(session.png, session.info);
    if (picture.channels == 4 && !alpha) png_set_filler(session.png, 0, PNG_FILLER_AFTER);
    for (int y = 0; y < picture.height; ++y) png_write_row(session.png, picture.row(y));
    png_write_end(session.png, nullptr);
    return true;
}

struct WebpPicture {
    ~WebpPicture() {
        WebPPictureFree(&picture);
        WebPMemoryWriterClear(&writer);
    }
    WebPPicture picture{};
    WebPMemoryWriter writer{};
};

bool writes(WebpPicture& session, const ImageView& picture) {
    constexpr int kQuickest = 0;
    WebPConfig config;
    WebPMemoryWriterInit(&session.writer);
    if (!WebPPictureInit(&session.picture) || !WebPConfigInit(&config) ||
        !WebPConfigLosslessPreset(&config, kQuickest))
        return false;
    session.picture.use_argb = 1;
    session.picture.width = picture.width;
    session.picture.height = picture.height;
    session.picture.writer = WebPMemoryWrite;
    session.picture.custom_ptr = &session.writer;
    const auto stride = static_cast<int>(picture.row_stride);
    const bool taken =
        picture.channels == 4
            ? WebPPictureImportRGBA(&session.picture, picture.row(0), stride) != 0
            : WebPPictureImportRGB(&session.picture, picture.row(0), stride) != 0;
    return taken && WebPEncode(&config, &session.picture) != 0;
}

}  // namespace

bool has_transparency(const ImageView& picture) {
    if (picture.channels != 4) return false;
    for (int y = 0; y < picture.height; ++y) {
        const std::uint8_t* row = picture.row(y);
        for (int x = 0; x < picture.width; ++x)
            if (row[4 * x + 3] != 255) return true;
    }
    return false;
}

Result<std::vector<std::uint8_t>> encode_png(const ImageView& picture) {
    assert(picture.channels == 3 || picture.channels == 4);
    assert(picture.width >= 1 && picture.height >= 1);
    PngSession session;
    session.png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &session, png_failed, png_warned);
    if (session.png != nullptr) session.info = png_create_info_struct(session.png);
    if (session.info == nullptr) throw std::bad_alloc();
    if (!writes(session, picture))
        return Error{ErrorCode::kInvalidArgument,
                     size_of(picture) + " cannot become a PNG: " + session.message};
    return std::move(session.bytes);
}

Result<std::vector<std::uint8_t>> encode_webp(const ImageView& picture) {
    assert(picture.channels == 3 || picture.channels == 4);
    assert(picture.width >= 1 && picture.height >= 1);
    WebpPicture session;
    if (!writes(session, picture))
        return Error{ErrorCode::kInvalidArgument,
                     size_of(picture) + " cannot become a WebP: error " +
                         std::to_string(static_cast<int>(session.picture.error_code))};
    return std::vector<std::uint8_t>(session.writer.mem,
                                     session.writer.mem + session.writer.size);
}

}  // namespace haarmony::ingest
