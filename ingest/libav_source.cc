#include "ingest/libav_source.h"

extern "C" {
#include <libavutil/avstring.h>
#include <libavutil/display.h>
#include <libavutil/opt.h>
}

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "ingest/display_matrix.h"
#include "ingest/libav_file.h"
#include "ingest/libav_pixels.h"

namespace haarmony::ingest {
namespace {

// libav's names of the decoders that may see foreign bytes.
constexpr const char* kDecoders =
    "apng,dnxhd,ffv1,ffvhuff,flv,gif,h263,h264,hevc,huffyuv,libdav1d,libvpx,libvpx-vp9,"
    "mjpeg,mpeg1video,mpeg2video,mpeg4,png,prores,qtrle,rawvideo,theora,utvideo,vp8,vp9";
constexpr video::FrameRate kGuessedRate = {25, 1};
constexpr video::FrameRate kUntimedRate = {10, 1};  // as browsers show untimed animations
constexpr std::int64_t kBlockPixels = 1 << 16;
constexpr AVRational kMicroseconds = {1, 1'000'000};

const char* demuxer_of(VideoFormat format, bool animated_png) {
    switch (format) {
        case VideoFormat::kMp4:
            return "mov";
        case VideoFormat::kMatroska:
            return "matroska";
        case VideoFormat::kAvi:
            return "avi";
        case VideoFormat::kMpegProgram:
            return "mpeg";
        case VideoFormat::kMpegTransport:
            return "mpegts";
        case VideoFormat::kMpegVideo:
            return "mpegvideo";
        case VideoFormat::kOgg:
            return "ogg";
        case VideoFormat::kFlash:
            return "flv";
        case VideoFormat::kYuv4Mpeg:
            return "yuv4mpegpipe";
        case VideoFormat::kGif:
            return "gif";
        case VideoFormat::kPng:
            return animated_png ? "apng" : "png_pipe";
        case VideoFormat::kWebp:
            break;
    }
    return "";
}

int refuse_second_file(AVFormatContext*,
                       AVIOContext**,
                       const char*,
                       int,
                       AVDictionary**) {
    return AVERROR(EPERM);
}

// A file, its container, and its one video stream.
class Demuxer {
  public:
    explicit Demuxer(int descriptor) : file_(descriptor) {}
    ~Demuxer() { avformat_close_input(&container_); }
    Demuxer(const Demuxer&) = delete;
    Demuxer& operator=(const Demuxer&) = delete;

    // 0, or libav's code.
    int open(const char* demuxer) {
        container_ = avformat_alloc_context();
        if (container_ == nullptr) return AVERROR(ENOMEM);
        container_->pb = file_.io();
        container_->io_open = &refuse_second_file;
        LibavOptions options;
        options.set("format_whitelist", av_find_input_format(demuxer)->name);
        options.set("protocol_whitelist", "none");
        options.set("codec_whitelist", kDecoders);
        const int opened = avformat_open_input(
            &container_, "", av_find_input_format(demuxer), options.get());
        if (opened < 0) return opened;
        const int found = avformat_find_stream_info(container_, nullptr);
        if (found < 0) return found;
        for (unsigned i = 0; i < container_->nb_streams && stream_ == nullptr; ++i) {
            AVStream* stream = container_->streams[i];
            const bool cover = (stream->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0;
            if (stream->codecpar->codec_type == AVMEDIA_TYPE_VIDEO && !cover) {
                stream_ = stream;
            } else {
                stream->discard = AVDISCARD_ALL;
            }
        }
        return 0;
    }
    // The next packet of the video stream; AVERROR_EOF at the end.
    int read(AVPacket* packet) {
        for (;;) {
            av_packet_unref(packet);
            const int code = av_read_frame(container_, packet);
            if (code < 0 || packet->stream_index == stream_->index) return code;
        }
    }
    [[nodiscard]] AVStream* stream() const { return stream_; }  // nullptr = none
    [[nodiscard]] const LibavFile& file() const { return file_; }

  private:
    LibavFile file_;
    AVFormatContext* container_ = nullptr;
    AVStream* stream_ = nullptr;
};

class LibavSource : public PictureSource {
  public:
    LibavSource(int file, const LibavSourceOptions& options)
        : descriptor_(file),
          options_(options),
          demuxer_(file),
          packet_(av_packet_alloc()),
          frame_(av_frame_alloc()) {}

    [[nodiscard]] Result<void> open();
    [[nodiscard]] const video::FrameFormat& format() const override { return format_; }
    [[nodiscard]] Result<bool> next(TimedPicture& shown) override;

  private:
    [[nodiscard]] std::string name() const {
        return std::string(name_of(options_.format));
    }
    [[nodiscard]] Error damaged(const std::string& why) const {
        return {ErrorCode::kUndecodable, "damaged " + name() + ": " + why};
    }
    [[nodiscard]] Error failed(int code) const;
    [[nodiscard]] Result<void> check_size(int width, int height) const;
    [[nodiscard]] Result<void> open_decoder();
    [[nodiscard]] Result<video::FrameRate> rate();
    [[nodiscard]] Result<video::FrameRate> measured_rate();
    // The next frame into frame_, false at the end.
    [[nodiscard]] Result<bool> decode();
    [[nodiscard]] Result<bool> feed();
    [[nodiscard]] Result<void> check_frame() const;
    [[nodiscard]] Result<void> show(TimedPicture& shown);

    int descriptor_;
    LibavSourceOptions options_;
    Demuxer demuxer_;
    const char* demuxer_name_ = "";
    std::optional<PngAnimation> png_;
    Libav<AVCodecContext> decoder_;
    Libav<AVPacket> packet_;
    Libav<AVFrame> frame_;
    LibavPixels pixels_;
    Turn turn_;
    video::Picture sideways_;
    video::FrameFormat format_;
    int coded_width_ = 0;
    int coded_height_ = 0;
    std::int64_t frames_ = 0;  // decoded
    bool waiting_ = false;     // the first, decoded by open()
    bool flushing_ = false;
};

Error LibavSource::failed(int code) const {
    if (code == AVERROR(ENOMEM)) {
        return {ErrorCode::kTooLarge,
                "decoding this " + name() + " needs more memory than it may have"};
    }
    if (code == AVERROR_EOF) return damaged("it ends too early");
    const std::string where =
        frames_ == 0 ? std::string() : " after frame " + std::to_string(frames_ - 1);
    return damaged(libav_words(code) + where);
}

Result<void> LibavSource::check_size(int width, int height) const {
    if (std::int64_t{width} * height <= options_.max_pixels &&
        std::max(width, height) <= video::kMaxSide) {
        return {};
    }
    return Error{ErrorCode::kTooLarge,
                 "the " + name() + " is " + std::to_string(width) + " x " +
                     std::to_string(height) + " pixels; the limit is " +
                     std::to_string(options_.max_pixels)};
}

Result<void> LibavSource::open_decoder() {
    const AVCodecParameters& parameters = *demuxer_.stream()->codecpar;
    const AVCodec* codec = avcodec_find_decoder(parameters.codec_id);
    const AVDictionaryEntry* alpha =
        av_dict_get(demuxer_.stream()->metadata, "alpha_mode", nullptr, 0);
    if (alpha != nullptr && std::strcmp(alpha->value, "1") == 0) {
        if (parameters.codec_id == AV_CODEC_ID_VP8) {
            codec = avcodec_find_decoder_by_name("libvpx");
        } else if (parameters.codec_id == AV_CODEC_ID_VP9) {
            codec = avcodec_find_decoder_by_name("libvpx-vp9");
        }
    }
    if (codec == nullptr || av_match_list(codec->name, kDecoders, ',') == 0) {
        return Error{ErrorCode::kUnsupportedFormat,
                     "the " + name() + " is coded as " +
                         avcodec_get_name(parameters.codec_id) +
                         ", which is not read here"};
    }
    if (auto fits = check_size(parameters.width, parameters.height); !fits) return fits;
    decoder_.reset(avcodec_alloc_context3(codec));
    if (!decoder_) return failed(AVERROR(ENOMEM));
    if (const int copied = avcodec_parameters_to_context(decoder_.get(), &parameters);
        copied < 0) {
        return failed(copied);
    }
    decoder_->pkt_timebase = demuxer_.stream()->time_base;
    decoder_->thread_count = 1;
    // Of the coded size, which has whole blocks; the picture's own is checked exactly.
    decoder_->max_pixels = 2 * options_.max_pixels + kBlockPixels;
    decoder_->flags |= AV_CODEC_FLAG_BITEXACT;
    // Stills and animations are whole or damaged. Films often have a bit too many somewhere.
    if (options_.format == VideoFormat::kGif || options_.format == VideoFormat::kPng) {
        decoder_->err_recognition = AV_EF_CRCCHECK | AV_EF_EXPLODE;
    }
    if (options_.frames == VideoFrames::kKey) decoder_->skip_frame = AVDISCARD_NONKEY;
    if (const int opened = avcodec_open2(decoder_.get(), codec, nullptr); opened < 0) {
        return failed(opened);
    }
    return {};
}

// Frames of animations last as long as they like: the average needs all of them.
Result<video::FrameRate> LibavSource::measured_rate() {
    Demuxer scan(descriptor_);
    if (const int opened = scan.open(demuxer_name_); opened < 0) return failed(opened);
    std::int64_t packets = 0;
    std::int64_t duration = 0;
    int code = 0;
    while ((code = scan.read(packet_.get())) >= 0) {
        ++packets;
        duration += packet_->duration;
    }
    if (code != AVERROR_EOF) return failed(code);
    if (png_ && packets < png_->frames) {
        return damaged("it ends after " + std::to_string(packets) + " of " +
                       std::to_string(png_->frames) + " frames");
    }
    if (png_ && png_->rate) return *png_->rate;
    const AVRational base = scan.stream()->time_base;
    video::FrameRate rate = kUntimedRate;
    if (duration > 0 && packets > 0) {
        av_reduce(&rate.numerator,
                  &rate.denominator,
                  packets * base.den,
                  duration * base.num,
                  INT32_MAX);
    }
    return rate;
}

Result<video::FrameRate> LibavSource::rate() {
    if (options_.format == VideoFormat::kGif || png_) return measured_rate();
    const AVStream& stream = *demuxer_.stream();
    for (const AVRational rate : {stream.avg_frame_rate, stream.r_frame_rate}) {
        if (rate.num > 0 && rate.den > 0) return video::FrameRate{rate.num, rate.den};
    }
    return kGuessedRate;
}

Result<void> LibavSource::open() {
    if (!packet_ || !frame_) return failed(AVERROR(ENOMEM));
    if (options_.format == VideoFormat::kPng) {
        png_ = png_animation(demuxer_.file());
    }
    demuxer_name_ = demuxer_of(options_.format, png_.has_value());
    if (const int code = demuxer_.open(demuxer_name_); code < 0) return failed(code);
    if (demuxer_.stream() == nullptr) {
        return Error{ErrorCode::kUnsupportedFormat,
                     "the " + name() + " holds no video stream"};
    }
    if (auto opened = open_decoder(); !opened) return opened;
    const Result<video::FrameRate> rate = this->rate();
    if (!rate) return rate.error();
    format_.rate = *rate;

    std::size_t bytes = 0;
    const std::uint8_t* matrix =
        av_stream_get_side_data(demuxer_.stream(), AV_PKT_DATA_DISPLAYMATRIX, &bytes);
    std::array<std::int32_t, 9> numbers{};
    if (matrix != nullptr && bytes == sizeof(numbers)) {
        std::memcpy(numbers.data(), matrix, sizeof(numbers));
        turn_ = turn_of(numbers);
    }

    // What the container says of the size may be wrong; the first picture is not.
    const Result<bool> first = decode();
    if (!first) return first.error();
    if (!*first) return damaged("no picture can be decoded from it");
    if (auto fits = check_size(frame_->width, frame_->height); !fits) return fits;
    coded_width_ = frame_->width;
    coded_height_ = frame_->height;
    format_.width = turn_.swaps_sides() ? coded_height_ : coded_width_;
    format_.height = turn_.swaps_sides() ? coded_width_ : coded_height_;
    waiting_ = true;
    return {};
}

// One packet, or the end, to the decoder; false where it needs none any more.
Result<bool> LibavSource::feed() {
    if (flushing_) return false;
    int code = 0;
    do {
        code = demuxer_.read(packet_.get());
    } while (code >= 0 && options_.frames == VideoFrames::kKey &&
             (packet_->flags & AV_PKT_FLAG_KEY) == 0);
    if (code < 0 && code != AVERROR_EOF) return failed(code);
    flushing_ = code == AVERROR_EOF;
    if (!flushing_ && (packet_->flags & AV_PKT_FLAG_CORRUPT) != 0) {
        return damaged("a packet after frame " + std::to_string(frames_ - 1) +
                       " is cut off or corrupt");
    }
    code = avcodec_send_packet(decoder_.get(), flushing_ ? nullptr : packet_.get());
    if (code < 0) return failed(code);
    return true;
}

Result<bool> LibavSource::decode() {
    for (;;) {
        const int code = avcodec_receive_frame(decoder_.get(), frame_.get());
        if (code >= 0) {
            if (auto checked = check_frame(); !checked) return checked.error();
            ++frames_;
            return true;
        }
        if (code == AVERROR_EOF) return false;
        if (code != AVERROR(EAGAIN)) return failed(code);
        const Result<bool> fed = feed();
        if (!fed || !*fed) return fed;
    }
}

Result<void> LibavSource::check_frame() const {
    if (frame_->decode_error_flags != 0 || (frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0) {
        return damaged("frame " + std::to_string(frames_) + " is corrupt");
    }
    if (frames_ > 0 &&
        (frame_->width != coded_width_ || frame_->height != coded_height_)) {
        return damaged(
            "frame " + std::to_string(frames_) + " is " + std::to_string(frame_->width) +
            " x " + std::to_string(frame_->height) + " pixels, the others are " +
            std::to_string(coded_width_) + " x " + std::to_string(coded_height_));
    }
    return {};
}

Result<void> LibavSource::show(TimedPicture& shown) {
    if (turn_.is_identity()) {
        if (auto done = pixels_.convert(*frame_, shown.picture); !done) return done;
    } else {
        if (auto done = pixels_.convert(*frame_, sideways_); !done) return done;
        turn(sideways_, turn_, shown.picture);
    }
    const AVStream& stream = *demuxer_.stream();
    std::int64_t stamp = frame_->best_effort_timestamp;
    if (stamp == AV_NOPTS_VALUE) {
        const AVRational frame_time = {format_.rate.denominator, format_.rate.numerator};
        shown.time_us = av_rescale_q(frames_ - 1, frame_time, kMicroseconds);
    } else {
        if (stream.start_time != AV_NOPTS_VALUE) stamp -= stream.start_time;
        shown.time_us = av_rescale_q(stamp, stream.time_base, kMicroseconds);
    }
    return {};
}

Result<bool> LibavSource::next(TimedPicture& shown) {
    if (!std::exchange(waiting_, false)) {
        Result<bool> decoded = decode();
        if (!decoded || !*decoded) return decoded;
    }
    if (auto done = show(shown); !done) return done.error();
    return true;
}

}  // namespace

Result<std::unique_ptr<PictureSource>> open_libav_source(
    int file,
    const LibavSourceOptions& options) {
    av_log_set_level(AV_LOG_QUIET);
    auto source = std::make_unique<LibavSource>(file, options);
    if (auto opened = source->open(); !opened) return opened.error();
    return std::unique_ptr<PictureSource>(std::move(source));
}

}  // namespace haarmony::ingest
