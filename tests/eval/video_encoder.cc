#include "tests/eval/video_encoder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <new>
#include <string>

#include "ingest/libav.h"

namespace haarmony::eval {
namespace {

using ingest::Libav;

const char* codec_name(VideoEncoding encoding) {
    switch (encoding) {
        case VideoEncoding::kFfv1:
            return "ffv1";
        case VideoEncoding::kLossless:
            return "libx264rgb";
        case VideoEncoding::kIntra:
        case VideoEncoding::kInter:
            break;
    }
    return "libx264";
}

bool opaque(std::span<const video::Picture> frames) {
    for (const video::Picture& frame : frames) {
        for (const video::Rgba& pixel : frame.pixels) {
            if (pixel.a != 255) return false;
        }
    }
    return true;
}

AVPixelFormat pixel_format(std::span<const video::Picture> frames,
                           VideoEncoding encoding) {
    if (encoding == VideoEncoding::kFfv1) {
        return opaque(frames) ? AV_PIX_FMT_BGR0 : AV_PIX_FMT_BGRA;
    }
    if (encoding == VideoEncoding::kLossless) return AV_PIX_FMT_BGR0;
    const video::Picture& first = frames.front();
    const bool odd = first.width % 2 != 0 || first.height % 2 != 0;
    return odd ? AV_PIX_FMT_YUV444P : AV_PIX_FMT_YUV420P;
}

class Encoder {
  public:
    explicit Encoder(EncodedFilm& film) : film_(film) {}

    Result<void> open(std::span<const video::Picture> frames);
    Result<void> add(const video::Picture& picture);
    Result<void> finish() { return send(nullptr); }

  private:
    [[nodiscard]] Error failed(int code) const {
        return {ErrorCode::kInvalidArgument,
                std::string(codec_name(film_.encoding)) + " of " +
                    std::to_string(film_.width) + " x " + std::to_string(film_.height) +
                    ": " + ingest::libav_words(code)};
    }
    Result<void> send(const AVFrame* frame);

    EncodedFilm& film_;
    Libav<AVCodecContext> encoder_;
    Libav<SwsContext> scaler_;
    Libav<AVFrame> frame_{av_frame_alloc()};
    Libav<AVPacket> packet_{av_packet_alloc()};
    std::int64_t frames_ = 0;
};

Result<void> Encoder::open(std::span<const video::Picture> frames) {
    if (!frame_ || !packet_) throw std::bad_alloc();
    const AVCodec* codec = avcodec_find_encoder_by_name(codec_name(film_.encoding));
    if (codec == nullptr) {
        return Error{ErrorCode::kUnavailable,
                     std::string("the installed libavcodec has no encoder ") +
                         codec_name(film_.encoding)};
    }
    encoder_.reset(avcodec_alloc_context3(codec));
    if (!encoder_) throw std::bad_alloc();
    encoder_->width = film_.width;
    encoder_->height = film_.height;
    encoder_->time_base = {1, 25};
    encoder_->framerate = {25, 1};
    encoder_->pix_fmt = pixel_format(frames, film_.encoding);
    encoder_->thread_count = 1;
    encoder_->flags |= AV_CODEC_FLAG_BITEXACT;
    ingest::LibavOptions options;
    switch (film_.encoding) {
        case VideoEncoding::kFfv1:
            encoder_->level = 3;
            break;
        case VideoEncoding::kLossless:
            options.set("qp", std::int64_t{0});
            break;
        case VideoEncoding::kIntra:
            encoder_->gop_size = 1;
            options.set("crf", 23);
            break;
        case VideoEncoding::kInter:
            options.set("crf", 23);
            break;
    }
    const int opened = avcodec_open2(encoder_.get(), codec, options.get());
    if (opened < 0) return failed(opened);
    film_.header.assign(encoder_->extradata,
                        encoder_->extradata + encoder_->extradata_size);

    frame_->width = film_.width;
    frame_->height = film_.height;
    frame_->format = encoder_->pix_fmt;
    if (const int code = av_frame_get_buffer(frame_.get(), 0); code < 0) {
        return failed(code);
    }
    scaler_.reset(sws_getContext(film_.width,
                                 film_.height,
                                 AV_PIX_FMT_RGBA,
                                 film_.width,
                                 film_.height,
                                 encoder_->pix_fmt,
                                 ingest::kExactScaling,
                                 nullptr,
                                 nullptr,
                                 nullptr));
    return scaler_ ? Result<void>() : failed(AVERROR(EINVAL));
}

Result<void> Encoder::send(const AVFrame* frame) {
    int code = avcodec_send_frame(encoder_.get(), frame);
    while (code >= 0) {
        code = avcodec_receive_packet(encoder_.get(), packet_.get());
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return {};
        if (code < 0) break;
        film_.packets.push_back({{packet_->data, packet_->data + packet_->size},
                                 packet_->pts,
                                 (packet_->flags & AV_PKT_FLAG_KEY) != 0});
        av_packet_unref(packet_.get());
    }
    return failed(code);
}

Result<void> Encoder::add(const video::Picture& picture) {
    assert(picture.width == film_.width && picture.height == film_.height);
    if (const int code = av_frame_make_writable(frame_.get()); code < 0) {
        return failed(code);
    }
    const std::array<const std::uint8_t*, 4> planes = {
        reinterpret_cast<const std::uint8_t*>(picture.pixels.data()),
        nullptr,
        nullptr,
        nullptr};
    const std::array<int, 4> strides = {4 * film_.width, 0, 0, 0};
    const int rows = sws_scale(scaler_.get(),
                               planes.data(),
                               strides.data(),
                               0,
                               film_.height,
                               frame_->data,
                               frame_->linesize);
    if (rows != film_.height) return failed(AVERROR(EINVAL));
    frame_->pts = frames_++;
    return send(frame_.get());
}

}  // namespace

std::uint64_t EncodedFilm::bytes() const {
    std::uint64_t sum = header.size();
    for (const FilmPacket& packet : packets) sum += packet.bytes.size();
    return sum;
}

Result<EncodedFilm> encode_film(std::span<const video::Picture> frames,
                                VideoEncoding encoding) {
    assert(!frames.empty());
    av_log_set_level(AV_LOG_QUIET);
    EncodedFilm film{encoding, frames.front().width, frames.front().height, {}, {}};
    Encoder encoder(film);
    if (const auto opened = encoder.open(frames); !opened) return opened.error();
    for (const video::Picture& frame : frames) {
        if (const auto added = encoder.add(frame); !added) return added.error();
    }
    if (const auto finished = encoder.finish(); !finished) return finished.error();
    return film;
}

}  // namespace haarmony::eval
