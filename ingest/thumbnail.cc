#include "ingest/thumbnail.h"

#include <algorithm>
#include <cassert>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
// jpeglib.h needs size_t and FILE from <cstdio>.
#include <jpeglib.h>

#include <array>
#include <string>

#include "ingest/shrink.h"

namespace haarmony::ingest {
namespace {

constexpr int kThumbnailQuality = 80;

// libjpeg's view of one encoding; on_error() jumps back instead of ending the process.
struct Session {
    Session() {
        codec.err = jpeg_std_error(&errors);
        codec.client_data = this;
    }
    ~Session() {
        jpeg_destroy_compress(&codec);
        std::free(bytes);
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    jpeg_compress_struct codec{};
    jpeg_error_mgr errors{};
    std::jmp_buf bail_out{};
    std::array<char, JMSG_LENGTH_MAX> message{};
    unsigned char* bytes = nullptr;  // allocated by libjpeg with malloc
    unsigned long size = 0;
};

[[noreturn]] void on_error(j_common_ptr codec) {
    Session& session = *static_cast<Session*>(codec->client_data);
    codec->err->format_message(codec, session.message.data());
    std::longjmp(session.bail_out, 1);
}

void encode(Session& session, const ImageView& picture, int quality) {
    jpeg_compress_struct& codec = session.codec;
    jpeg_create_compress(&codec);
    jpeg_mem_dest(&codec, &session.bytes, &session.size);
    codec.image_width = static_cast<JDIMENSION>(picture.width);
    codec.image_height = static_cast<JDIMENSION>(picture.height);
    codec.input_components = picture.channels;
    codec.in_color_space = picture.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&codec);
    jpeg_set_quality(&codec, quality, TRUE);
    jpeg_start_compress(&codec, TRUE);
    for (int y = 0; y < picture.height; ++y) {
        // libjpeg's interface predates const; rows are only read.
        JSAMPROW row = const_cast<JSAMPROW>(picture.row(y));
        jpeg_write_scanlines(&codec, &row, 1);
    }
    jpeg_finish_compress(&codec);
}

bool completes(Session& session, const ImageView& picture, int quality) {
    if (setjmp(session.bail_out) != 0) return false;
    encode(session, picture, quality);
    return true;
}

ImageView view_of(const Raster& raster) {
    return {raster.pixels.data(),
            raster.width,
            raster.height,
            raster.channels,
            static_cast<std::ptrdiff_t>(raster.row_bytes())};
}

// `side` * shorter / longer, to the nearest, at least 1.
int scaled_side(int shorter, int longer) {
    const std::int64_t scaled =
        (2LL * kThumbnailSide * shorter + longer) / (2LL * longer);
    return static_cast<int>(std::max<std::int64_t>(1, scaled));
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_jpeg(const ImageView& picture, int quality) {
    assert(picture.channels == 1 || picture.channels == 3 || picture.channels == 4);
    assert(quality >= 1 && quality <= 100);
    if (picture.channels == 4) {
        const Raster opaque = shrink(picture, picture.width, picture.height);
        return encode_jpeg(view_of(opaque), quality);
    }
    Session session;
    session.errors.error_exit = on_error;
    if (!completes(session, picture, quality)) {
        return Error{ErrorCode::kInvalidArgument,
                     std::to_string(picture.width) + " x " +
                         std::to_string(picture.height) +
                         " pixels cannot become a JPEG: " + session.message.data()};
    }
    return std::vector<std::uint8_t>(session.bytes, session.bytes + session.size);
}

Result<std::vector<std::uint8_t>> make_thumbnail(const ImageView& picture) {
    int width = picture.width;
    int height = picture.height;
    if (std::max(width, height) > kThumbnailSide) {
        const bool wide = width >= height;
        width = wide ? kThumbnailSide : scaled_side(picture.width, picture.height);
        height = wide ? scaled_side(picture.height, picture.width) : kThumbnailSide;
    }
    const Raster small = shrink(picture, width, height);
    return encode_jpeg(view_of(small), kThumbnailQuality);
}

}  // namespace haarmony::ingest
