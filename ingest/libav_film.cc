#include "ingest/libav_film.h"

extern "C" {
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
}

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include "ingest/film_pixels.h"

namespace haarmony::ingest {
namespace {

constexpr int kBufferBytes = 64 << 10;
constexpr int kReadBeyond = 64;  // bytes that swscale reads beyond the end of a row
constexpr int kSecondsBetweenKeys = 2;
constexpr std::int64_t kMaxFramesBetweenKeys = 600;

int even(int side) { return side + side % 2; }

}  // namespace

LibavFilm::~LibavFilm() { avformat_free_context(container_); }

Error LibavFilm::failed(int code) const {
    if (code == AVERROR(ENOMEM)) {
        return {ErrorCode::kTooLarge, "encoding needs more memory than it may have"};
    }
    const video::FrameFormat& format = request_.format;
    return {ErrorCode::kInvalidArgument,
            std::string(webm() ? "VP9" : "H.264") + " of " +
                std::to_string(format.width) + " x " + std::to_string(format.height) +
                " pixels at " + std::to_string(format.rate.numerator) + "/" +
                std::to_string(format.rate.denominator) +
                " frames a second: " + libav_words(code)};
}

int LibavFilm::write(void* self, std::uint8_t* bytes, int count) {
    const auto* film = static_cast<const LibavFilm*>(self);
    const std::span<const std::uint8_t> part(bytes, static_cast<std::size_t>(count));
    return film->output_(part) ? count : AVERROR(EPIPE);
}

Result<void> LibavFilm::open_container() {
    const int code = avformat_alloc_output_context2(
        &container_, nullptr, webm() ? "webm" : "mp4", nullptr);
    if (code < 0) return failed(code);
    auto* buffer = static_cast<std::uint8_t*>(av_malloc(kBufferBytes));
    if (buffer == nullptr) throw std::bad_alloc();
    io_.reset(avio_alloc_context(
        buffer, kBufferBytes, 1, this, nullptr, &LibavFilm::write, nullptr));
    if (!io_) {
        av_free(buffer);
        throw std::bad_alloc();
    }
    container_->pb = io_.get();
    container_->flags |= AVFMT_FLAG_CUSTOM_IO | AVFMT_FLAG_BITEXACT;
    stream_ = avformat_new_stream(container_, nullptr);
    return stream_ != nullptr ? Result<void>() : failed(AVERROR(ENOMEM));
}

Result<void> LibavFilm::open_encoder() {
    const char* name = webm() ? "libvpx-vp9" : "libx264";
    const AVCodec* codec = avcodec_find_encoder_by_name(name);
    if (codec == nullptr) {
        return Error{ErrorCode::kUnavailable,
                     "the installed libavcodec has no encoder " + std::string(name)};
    }
    const video::FrameFormat& format = request_.format;
    encoder_.reset(avcodec_alloc_context3(codec));
    if (!encoder_) return failed(AVERROR(ENOMEM));
    encoder_->width = webm() ? format.width : even(format.width);
    encoder_->height = webm() ? format.height : even(format.height);
    encoder_->time_base = {format.rate.denominator, format.rate.numerator};
    encoder_->framerate = {format.rate.numerator, format.rate.denominator};
    encoder_->pix_fmt = webm() ? AV_PIX_FMT_YUVA420P : AV_PIX_FMT_YUV420P;
    encoder_->color_range = AVCOL_RANGE_MPEG;
    encoder_->colorspace = AVCOL_SPC_BT709;
    encoder_->color_primaries = AVCOL_PRI_BT709;
    encoder_->color_trc = AVCOL_TRC_BT709;
    encoder_->gop_size = static_cast<int>(
        std::clamp<std::int64_t>(std::int64_t{kSecondsBetweenKeys} *
                                     format.rate.numerator / format.rate.denominator,
                                 1,
                                 kMaxFramesBetweenKeys));
    encoder_->thread_count = 1;
    encoder_->flags |= AV_CODEC_FLAG_BITEXACT;
    if ((container_->oformat->flags & AVFMT_GLOBALHEADER) != 0) {
        encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    LibavOptions options;
    if (webm()) {
        options.set("crf", 20);
        options.set("b", std::int64_t{0});
        options.set("deadline", "good");
        options.set("cpu-used", 5);
        // Its hidden frames have no alpha of their own.
        options.set("auto-alt-ref", std::int64_t{0});
    } else {
        options.set("crf", 18);
        options.set("preset", "veryfast");
    }
    const int opened = avcodec_open2(encoder_.get(), codec, options.get());
    if (opened < 0) return failed(opened);
    const int copied = avcodec_parameters_from_context(stream_->codecpar, encoder_.get());
    if (copied < 0) return failed(copied);
    stream_->time_base = encoder_->time_base;
    stream_->avg_frame_rate = encoder_->framerate;
    if (webm()) av_dict_set(&stream_->metadata, "alpha_mode", "1", 0);
    return {};
}

Result<void> LibavFilm::open_scaler() {
    frame_.reset(av_frame_alloc());
    packet_.reset(av_packet_alloc());
    if (!frame_ || !packet_) return failed(AVERROR(ENOMEM));
    frame_->width = encoder_->width;
    frame_->height = encoder_->height;
    frame_->format = encoder_->pix_fmt;
    frame_->color_range = encoder_->color_range;
    frame_->colorspace = encoder_->colorspace;
    if (const int code = av_frame_get_buffer(frame_.get(), 0); code < 0) {
        return failed(code);
    }
    scaler_.reset(sws_getContext(encoder_->width,
                                 encoder_->height,
                                 AV_PIX_FMT_RGBA,
                                 encoder_->width,
                                 encoder_->height,
                                 encoder_->pix_fmt,
                                 kExactScaling,
                                 nullptr,
                                 nullptr,
                                 nullptr));
    if (!scaler_) return failed(AVERROR(EINVAL));
    constexpr int kOne = 1 << 16;
    sws_setColorspaceDetails(scaler_.get(),
                             sws_getCoefficients(SWS_CS_DEFAULT),
                             1,
                             sws_getCoefficients(SWS_CS_ITU709),
                             0,
                             0,
                             kOne,
                             kOne);
    return {};
}

Result<void> LibavFilm::open(const VideoRequest& request, Output output) {
    assert(container_ == nullptr && request.task != VideoTask::kRead);
    av_log_set_level(AV_LOG_QUIET);
    request_ = request;
    output_ = std::move(output);
    if (auto opened = open_container(); !opened) return opened;
    if (auto opened = open_encoder(); !opened) return opened;
    if (auto opened = open_scaler(); !opened) return opened;
    LibavOptions options;
    // Nothing is ever gone back to.
    if (!webm()) options.set("movflags", "frag_keyframe+empty_moov+default_base_moof");
    const int code = avformat_write_header(container_, options.get());
    return code < 0 ? failed(code) : Result<void>();
}

Result<void> LibavFilm::encode(const AVFrame* frame) {
    int code = avcodec_send_frame(encoder_.get(), frame);
    while (code >= 0) {
        code = avcodec_receive_packet(encoder_.get(), packet_.get());
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return {};
        if (code < 0) break;
        packet_->stream_index = stream_->index;
        packet_->duration = 1;
        av_packet_rescale_ts(packet_.get(), encoder_->time_base, stream_->time_base);
        code = av_interleaved_write_frame(container_, packet_.get());
    }
    return failed(code);
}

int LibavFilm::pad(const video::Picture& picture) {
    const int stride =
        (4 * encoder_->width + kReadBeyond - 1) / kReadBeyond * kReadBeyond;
    rows_.resize(static_cast<std::size_t>(stride) *
                     static_cast<std::size_t>(encoder_->height) +
                 kReadBeyond);
    const std::size_t row_bytes =
        std::size_t{4} * static_cast<std::size_t>(picture.width);
    for (int y = 0; y < encoder_->height; ++y) {
        const int from = std::min(y, picture.height - 1);
        std::uint8_t* row =
            rows_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(stride);
        std::memcpy(row, &picture.at(0, from), row_bytes);
        if (encoder_->width != picture.width) {
            std::memcpy(row + row_bytes, &picture.at(picture.width - 1, from), 4);
        }
    }
    return stride;
}

Result<void> LibavFilm::add(video::Picture& picture) {
    if (webm()) {
        bleed_into_clear(picture);
    } else {
        lay_over(picture, request_.background);
    }
    const int stride = pad(picture);
    if (const int code = av_frame_make_writable(frame_.get()); code < 0) {
        return failed(code);
    }
    const std::array<const std::uint8_t*, 4> planes = {
        rows_.data(), nullptr, nullptr, nullptr};
    const std::array<int, 4> strides = {stride, 0, 0, 0};
    const int rows = sws_scale(scaler_.get(),
                               planes.data(),
                               strides.data(),
                               0,
                               encoder_->height,
                               frame_->data,
                               frame_->linesize);
    if (rows != encoder_->height) return failed(AVERROR(EINVAL));
    frame_->pts = frames_++;
    return encode(frame_.get());
}

Result<void> LibavFilm::finish() {
    if (auto flushed = encode(nullptr); !flushed) return flushed;
    const int code = av_write_trailer(container_);
    if (code < 0) return failed(code);
    avio_flush(io_.get());
    return io_->error < 0 ? failed(io_->error) : Result<void>();
}

}  // namespace haarmony::ingest
