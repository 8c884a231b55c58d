#include "ingest/jpeg.h"

#include <cassert>
#include <csetjmp>
#include <cstdio>
// jpeglib.h needs size_t and FILE from <cstdio>.
#include <jpeglib.h>

#include <jerror.h>

#include <algorithm>
#include <array>
#include <string>

namespace haarmony::ingest {
namespace {

// Cameras and webcams pad the last scan by a few bytes; more is lost synchronisation.
constexpr int kMaxPadding = 64;

// libjpeg's view of one decoding, with our places to note what it says. It reports errors
// by a function that must not return; `bail_out` is where we go instead.
struct Session {
    Session() {
        codec.err = jpeg_std_error(&errors);
        codec.client_data = this;
    }
    ~Session() { jpeg_destroy_decompress(&codec); }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    jpeg_decompress_struct codec{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf bail_out{};
    std::array<char, JMSG_LENGTH_MAX> message{};
    bool damaged = false;
};

Session& session_of(j_common_ptr codec) {
    return *static_cast<Session*>(codec->client_data);
}

[[noreturn]] void on_error(j_common_ptr codec) {
    Session& session = session_of(codec);
    if (!session.damaged) codec->err->format_message(codec, session.message.data());
    session.damaged = true;
    std::longjmp(session.bail_out, 1);
}

bool is_harmless(const jpeg_error_mgr& errors) {
    switch (errors.msg_code) {
        case JWRN_JFIF_MAJOR:
        case JWRN_ADOBE_XFORM:
        case JWRN_NOT_SEQUENTIAL:
        case JWRN_BOGUS_ICC:
            return true;  // none of them touches a pixel
        case JWRN_EXTRANEOUS_DATA:
            return errors.msg_parm.i[1] == JPEG_EOI &&
                   errors.msg_parm.i[0] <= kMaxPadding;
        default:
            return false;
    }
}

void on_message(j_common_ptr codec, int level) {
    Session& session = session_of(codec);
    if (level >= 0 || session.damaged || is_harmless(*codec->err)) return;
    codec->err->format_message(codec, session.message.data());
    session.damaged = true;
    // The first sign of damage is the answer; decoding the rest would be wasted.
    std::longjmp(session.bail_out, 1);
}

void on_progress(j_common_ptr codec) {
    Session& session = session_of(codec);
    if (session.codec.input_scan_number <= kMaxJpegScans) return;
    std::snprintf(session.message.data(),
                  session.message.size(),
                  "more than %d scans",
                  kMaxJpegScans);
    session.damaged = true;
    std::longjmp(session.bail_out, 1);
}

unsigned choose_denominator(unsigned width, unsigned height, unsigned min_side) {
    unsigned denominator = 1;
    for (const unsigned next : {2u, 4u, 8u}) {
        const unsigned shorter = (std::min(width, height) + next - 1) / next;
        if (shorter >= min_side) denominator = next;
    }
    return denominator;
}

// Inks to light. Photoshop writes CMYK JPEGs inverted (0 = full ink), and the Adobe marker
// is the only sign of it.
void inks_to_rgb(const std::uint8_t* inks, std::uint8_t* rgb, int count, bool inverted) {
    const unsigned flip = inverted ? 0 : 255;
    for (int x = 0; x < count; ++x, inks += 4, rgb += 3) {
        const unsigned black = inks[3] ^ flip;
        for (int channel = 0; channel < 3; ++channel) {
            const unsigned light = (inks[channel] ^ flip) * black;
            rgb[channel] = static_cast<std::uint8_t>((light + 127) / 255);
        }
    }
}

// False where libjpeg bailed out of `step`. No object with a destructor may be made inside
// a step, for the jump would pass it by: buffers belong to the caller.
template <typename Step>
bool completes(Session& session, const Step& step) {
    if (setjmp(session.bail_out) != 0) return false;
    step();
    return true;
}

struct Target {
    Raster raster;
    std::vector<std::uint8_t> inks;
};

void read_header(Session& session, std::span<const std::uint8_t> bytes, int min_side) {
    jpeg_decompress_struct& codec = session.codec;
    jpeg_create_decompress(&codec);
    codec.progress = &session.progress;
    jpeg_mem_src(&codec, bytes.data(), static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&codec, TRUE);
    switch (codec.jpeg_color_space) {
        case JCS_GRAYSCALE:
            codec.out_color_space = JCS_GRAYSCALE;
            break;
        case JCS_CMYK:
        case JCS_YCCK:
            codec.out_color_space = JCS_CMYK;
            break;
        default:
            codec.out_color_space = JCS_RGB;
            break;
    }
    codec.scale_num = 1;
    codec.scale_denom = choose_denominator(
        codec.image_width, codec.image_height, static_cast<unsigned>(min_side));
    jpeg_start_decompress(&codec);
}

void read_rows(Session& session, Target& target) {
    jpeg_decompress_struct& codec = session.codec;
    const bool inks = codec.out_color_space == JCS_CMYK;
    while (codec.output_scanline < codec.output_height) {
        const int y = static_cast<int>(codec.output_scanline);
        std::uint8_t* row = inks ? target.inks.data() : target.raster.row(y);
        jpeg_read_scanlines(&codec, &row, 1);
        if (inks) {
            inks_to_rgb(row,
                        target.raster.row(y),
                        target.raster.width,
                        codec.saw_Adobe_marker == TRUE);
        }
    }
    jpeg_finish_decompress(&codec);
}

}  // namespace

Result<Raster> decode_jpeg(std::span<const std::uint8_t> bytes, int min_side) {
    assert(min_side >= 1);
    Session session;
    session.errors.error_exit = on_error;
    session.errors.emit_message = on_message;
    session.progress.progress_monitor = on_progress;
    Target target;
    const auto damage = [&] {
        return Error{ErrorCode::kUndecodable,
                     "damaged JPEG: " + std::string(session.message.data())};
    };

    if (!completes(session, [&] { read_header(session, bytes, min_side); }))
        return damage();
    const int width = static_cast<int>(session.codec.output_width);
    const int height = static_cast<int>(session.codec.output_height);
    const bool inks = session.codec.out_color_space == JCS_CMYK;
    target.raster = Raster(width, height, inks ? 3 : session.codec.output_components);
    if (inks) target.inks.resize(static_cast<std::size_t>(width) * 4);
    if (!completes(session, [&] { read_rows(session, target); })) return damage();
    return std::move(target.raster);
}

}  // namespace haarmony::ingest
