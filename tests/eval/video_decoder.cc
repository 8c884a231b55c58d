#include "tests/eval/video_decoder.h"

#include <array>
#include <cassert>
#include <cstring>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "ingest/libav.h"

namespace haarmony::eval {

using ingest::Libav;

namespace {

// swscale writes beyond the end of a row.
constexpr int kRowSlack = 64;

}  // namespace

class FilmDecoder::Impl {
  public:
    Impl(const EncodedFilm& film, std::int32_t width, std::int32_t height)
        : film_(film),
          picture_(width, height),
          stride_((4 * width + kRowSlack - 1) / kRowSlack * kRowSlack),
          rows_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height) +
                kRowSlack) {}

    Result<void> open();
    Result<void> frames(std::int64_t first,
                        std::int64_t count,
                        const std::function<void(const video::Picture&)>& visit);

  private:
    static Error failed(int code) {
        return {ErrorCode::kUndecodable, "film: " + ingest::libav_words(code)};
    }
    Result<void> send(const FilmPacket* packet);
    // Visits what the decoder has ready of the frames [next, end).
    Result<void> receive(std::int64_t& next,
                         std::int64_t end,
                         const std::function<void(const video::Picture&)>& visit);
    Result<void> scale();

    const EncodedFilm& film_;
    video::Picture picture_;
    int stride_;
    std::vector<std::uint8_t> rows_;
    Libav<AVCodecContext> decoder_;
    Libav<SwsContext> scaler_;
    Libav<AVFrame> frame_{av_frame_alloc()};
    Libav<AVPacket> packet_{av_packet_alloc()};
};

Result<void> FilmDecoder::Impl::open() {
    if (!frame_ || !packet_) throw std::bad_alloc();
    const AVCodecID id =
        film_.encoding == VideoEncoding::kFfv1 ? AV_CODEC_ID_FFV1 : AV_CODEC_ID_H264;
    const AVCodec* codec = avcodec_find_decoder(id);
    if (codec == nullptr) {
        return Error{ErrorCode::kUnavailable,
                     std::string("the installed libavcodec has no decoder ") +
                         avcodec_get_name(id)};
    }
    decoder_.reset(avcodec_alloc_context3(codec));
    if (!decoder_) throw std::bad_alloc();
    decoder_->thread_count = 1;
    decoder_->width = film_.width;
    decoder_->height = film_.height;
    if (!film_.header.empty()) {
        auto* const header = static_cast<std::uint8_t*>(
            av_mallocz(film_.header.size() + AV_INPUT_BUFFER_PADDING_SIZE));
        if (header == nullptr) throw std::bad_alloc();
        std::memcpy(header, film_.header.data(), film_.header.size());
        decoder_->extradata = header;
        decoder_->extradata_size = static_cast<int>(film_.header.size());
    }
    const int opened = avcodec_open2(decoder_.get(), codec, nullptr);
    return opened < 0 ? failed(opened) : Result<void>();
}

Result<void> FilmDecoder::Impl::send(const FilmPacket* packet) {
    int code = 0;
    if (packet == nullptr) {
        code = avcodec_send_packet(decoder_.get(), nullptr);
    } else {
        code = av_new_packet(packet_.get(), static_cast<int>(packet->bytes.size()));
        if (code < 0) return failed(code);
        std::memcpy(packet_->data, packet->bytes.data(), packet->bytes.size());
        packet_->pts = packet->frame;
        packet_->flags = packet->key ? AV_PKT_FLAG_KEY : 0;
        code = avcodec_send_packet(decoder_.get(), packet_.get());
        av_packet_unref(packet_.get());
    }
    return code < 0 ? failed(code) : Result<void>();
}

Result<void> FilmDecoder::Impl::scale() {
    if (!scaler_) {
        const bool same =
            frame_->width == picture_.width && frame_->height == picture_.height;
        scaler_.reset(sws_getContext(frame_->width,
                                     frame_->height,
                                     static_cast<AVPixelFormat>(frame_->format),
                                     picture_.width,
                                     picture_.height,
                                     AV_PIX_FMT_RGBA,
                                     same ? SWS_BILINEAR : SWS_AREA,
                                     nullptr,
                                     nullptr,
                                     nullptr));
        if (!scaler_) return failed(AVERROR(EINVAL));
    }
    const std::array<std::uint8_t*, 4> planes = {rows_.data(), nullptr, nullptr, nullptr};
    const std::array<int, 4> strides = {stride_, 0, 0, 0};
    const int rows = sws_scale(scaler_.get(),
                               frame_->data,
                               frame_->linesize,
                               0,
                               frame_->height,
                               planes.data(),
                               strides.data());
    if (rows != picture_.height) return failed(AVERROR(EINVAL));
    for (std::int32_t y = 0; y < rows; ++y) {
        std::memcpy(&picture_.at(0, y),
                    rows_.data() + std::ptrdiff_t{stride_} * y,
                    sizeof(video::Rgba) * static_cast<std::size_t>(picture_.width));
    }
    return {};
}

Result<void> FilmDecoder::Impl::receive(
    std::int64_t& next,
    std::int64_t end,
    const std::function<void(const video::Picture&)>& visit) {
    for (;;) {
        const int code = avcodec_receive_frame(decoder_.get(), frame_.get());
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return {};
        if (code < 0) return failed(code);
        if (frame_->pts != next || next == end) continue;
        if (const auto scaled = scale(); !scaled) return scaled;
        visit(picture_);
        ++next;
    }
}

Result<void> FilmDecoder::Impl::frames(
    std::int64_t first,
    std::int64_t count,
    const std::function<void(const video::Picture&)>& visit) {
    std::size_t begin = 0, end = 0;
    for (std::size_t i = 0; i < film_.packets.size(); ++i) {
        const FilmPacket& packet = film_.packets[i];
        if (packet.key && packet.frame <= first) begin = i;
        if (packet.frame >= first && packet.frame < first + count) end = i + 1;
    }
    avcodec_flush_buffers(decoder_.get());
    std::int64_t next = first;
    // All that a packet refers to comes before it; an empty packet at the end makes the
    // decoder give what it holds back to put frames in order.
    for (std::size_t i = begin; i <= end; ++i) {
        const auto sent = send(i < end ? &film_.packets[i] : nullptr);
        if (!sent) return sent;
        const auto received = receive(next, first + count, visit);
        if (!received) return received;
    }
    if (next == first + count) return {};
    return Error{ErrorCode::kUndecodable,
                 "film: frame " + std::to_string(next) + " does not come"};
}

FilmDecoder::FilmDecoder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FilmDecoder::~FilmDecoder() = default;

Result<std::unique_ptr<FilmDecoder>> FilmDecoder::open(const EncodedFilm& film,
                                                       std::int32_t width,
                                                       std::int32_t height) {
    assert(width >= 1 && height >= 1);
    av_log_set_level(AV_LOG_QUIET);
    auto impl = std::make_unique<Impl>(film, width, height);
    if (const auto opened = impl->open(); !opened) return opened.error();
    return std::unique_ptr<FilmDecoder>(new FilmDecoder(std::move(impl)));
}

Result<void> FilmDecoder::frames(
    std::int64_t first,
    std::int64_t count,
    const std::function<void(const video::Picture&)>& visit) {
    return impl_->frames(first, count, visit);
}

}  // namespace haarmony::eval
