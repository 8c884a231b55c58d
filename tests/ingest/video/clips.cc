#include "tests/ingest/video/clips.h"

#include <gtest/gtest.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <utility>

#include "ingest/libav.h"
#include "ingest/libav_source.h"
#include "ingest/socket_wire.h"
#include "ingest/video_format.h"
#include "ingest/webp_animation.h"

namespace haarmony::ingest::testing {
namespace {

constexpr std::int64_t kManyPixels = 1 << 24;

std::uint8_t wave(double phase) {
    return static_cast<std::uint8_t>(std::lround(127.5 + 100 * std::sin(phase)));
}

std::uint8_t alpha_of(Alpha alpha, int x, int y, double side, std::mt19937& random) {
    if (alpha == Alpha::kOpaque) return 255;
    if (alpha == Alpha::kRandom) {
        const auto value = random() % 512;
        return static_cast<std::uint8_t>(value < 256 ? value : value < 384 ? 0 : 255);
    }
    const double distance = std::hypot(x - side / 2, y - side / 2);
    return static_cast<std::uint8_t>(
        std::lround(255 * std::clamp(side / 2 - distance, 0.0, 8.0) / 8));
}

// A source over bytes that go with it.
class HeldSource : public PictureSource {
  public:
    HeldSource(FileDescriptor file, Bytes bytes)
        : file_(std::move(file)), bytes_(std::move(bytes)) {}
    Result<void> open(VideoFormat format, VideoFrames frames) {
        auto source =
            format == VideoFormat::kWebp
                ? open_webp_animation(bytes_, kManyPixels)
                : open_libav_source(
                      file_.get(),
                      {.format = format, .frames = frames, .max_pixels = kManyPixels});
        if (!source) return source.error();
        source_ = std::move(source).value();
        return {};
    }
    const video::FrameFormat& format() const override { return source_->format(); }
    Result<bool> next(TimedPicture& shown) override { return source_->next(shown); }

  private:
    FileDescriptor file_;
    Bytes bytes_;
    std::unique_ptr<PictureSource> source_;
};

Result<std::unique_ptr<PictureSource>> open_here(const Bytes& file, VideoFrames frames) {
    Result<FileDescriptor> memory = sealed_memory(file);
    if (!memory) return memory.error();
    const auto format = sniff_video(file);
    if (!format) return Error{ErrorCode::kUnsupportedFormat, "no video"};
    auto source = std::make_unique<HeldSource>(std::move(memory).value(), file);
    if (auto opened = source->open(*format, frames); !opened) return opened.error();
    return std::unique_ptr<PictureSource>(std::move(source));
}

int append_packet(void* bytes, std::uint8_t* part, int count) {
    auto* file = static_cast<Bytes*>(bytes);
    file->insert(file->end(), part, part + count);
    return count;
}

}  // namespace

Clip moving_clip(const video::FrameFormat& format, int frames, Alpha alpha) {
    std::mt19937 random(7);
    Clip clip = {format, {}};
    const double side = std::min(format.width, format.height);
    for (int i = 0; i < frames; ++i) {
        video::Picture picture(format.width, format.height);
        for (int y = 0; y < format.height; ++y) {
            for (int x = 0; x < format.width; ++x) {
                picture.at(x, y) =
                    video::canonical({wave((x + 2 * i) / 15.0),
                                      wave((y - i) / 11.0),
                                      wave((x + y + i) / 23.0),
                                      alpha_of(alpha, x + i, y, side, random)});
            }
        }
        clip.pictures.push_back(std::move(picture));
    }
    return clip;
}

Clip flat_clip(const video::FrameFormat& format, int frames, video::Rgba color) {
    video::Picture picture(format.width, format.height);
    std::fill(picture.pixels.begin(), picture.pixels.end(), color);
    return {format,
            std::vector<video::Picture>(static_cast<std::size_t>(frames), picture)};
}

Bytes write_film(const Clip& clip, const VideoSinkOptions& options) {
    Bytes film;
    auto sink = open_video_sink(options, [&film](std::span<const std::uint8_t> part) {
        film.insert(film.end(), part.begin(), part.end());
        return Result<void>();
    });
    EXPECT_TRUE(sink) << sink.error().message;
    if (!sink) return film;
    for (const video::Picture& picture : clip.pictures) {
        const auto added = (*sink)->add(picture.view());
        EXPECT_TRUE(added) << added.error().message;
        if (!added) return film;
    }
    const auto finished = (*sink)->finish();
    EXPECT_TRUE(finished) << finished.error().message;
    return film;
}

Bytes write_film(const Clip& clip, Container container) {
    VideoSinkOptions options;
    options.container = container;
    options.format = clip.format;
    options.frames = static_cast<std::int64_t>(clip.pictures.size());
    return write_film(clip, options);
}

Result<Shown> read_all(Result<std::unique_ptr<PictureSource>> source) {
    if (!source) return source.error();
    Shown shown = {(*source)->format(), {}, {}};
    TimedPicture next;
    for (;;) {
        const Result<bool> more = (*source)->next(next);
        if (!more) return more.error();
        if (!*more) return shown;
        shown.pictures.push_back(next.picture);
        shown.times_us.push_back(next.time_us);
    }
}

Result<Shown> decode_here(const Bytes& file, VideoFrames frames) {
    return read_all(open_here(file, frames));
}

Result<Shown> decode_in_child(const Bytes& file, const VideoSourceOptions& options) {
    return read_all(open_video(file, options));
}

double psnr(const std::vector<video::Picture>& a, const std::vector<video::Picture>& b) {
    EXPECT_EQ(a.size(), b.size());
    double squares = 0;
    double samples = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        EXPECT_EQ(a[i].width, b[i].width);
        EXPECT_EQ(a[i].height, b[i].height);
        if (a[i].pixels.size() != b[i].pixels.size()) return 0;
        for (std::size_t p = 0; p < a[i].pixels.size(); ++p) {
            const video::Rgba& s = a[i].pixels[p];
            const video::Rgba& t = b[i].pixels[p];
            for (const int off : {s.r - t.r, s.g - t.g, s.b - t.b}) squares += off * off;
            samples += 3;
        }
    }
    if (squares == 0) return 99;
    return 10 * std::log10(255.0 * 255.0 * samples / squares);
}

int largest_difference(const video::Picture& a, const video::Picture& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    int largest = 0;
    for (std::size_t p = 0; p < std::min(a.pixels.size(), b.pixels.size()); ++p) {
        const video::Rgba& s = a.pixels[p];
        const video::Rgba& t = b.pixels[p];
        for (const int off : {s.r - t.r, s.g - t.g, s.b - t.b, s.a - t.a}) {
            largest = std::max(largest, std::abs(off));
        }
    }
    return largest;
}

video::Picture over(const video::Picture& picture, video::Rgba background) {
    video::Picture result = picture;
    for (video::Rgba& pixel : result.pixels) {
        const double alpha = pixel.a / 255.0;
        const auto mixed = [alpha](int above, int below) {
            return static_cast<std::uint8_t>(
                std::lround(alpha * above + (1 - alpha) * below));
        };
        pixel = {mixed(pixel.r, background.r),
                 mixed(pixel.g, background.g),
                 mixed(pixel.b, background.b),
                 255};
    }
    return result;
}

Bytes matroska_of(const Packets& packets) {
    Bytes file;
    AVFormatContext* container = nullptr;
    EXPECT_GE(avformat_alloc_output_context2(&container, nullptr, "matroska", nullptr),
              0);
    const Libav<AVIOContext> io(
        avio_alloc_context(static_cast<std::uint8_t*>(av_malloc(4096)),
                           4096,
                           1,
                           &file,
                           nullptr,
                           &append_packet,
                           nullptr));
    container->pb = io.get();
    container->flags |= AVFMT_FLAG_CUSTOM_IO | AVFMT_FLAG_BITEXACT;
    AVStream* stream = avformat_new_stream(container, nullptr);
    AVCodecParameters& parameters = *stream->codecpar;
    parameters.codec_id = static_cast<AVCodecID>(packets.codec);
    if (packets.audio) {
        parameters.codec_type = AVMEDIA_TYPE_AUDIO;
        parameters.sample_rate = 8000;
        av_channel_layout_default(&parameters.ch_layout, 1);
    } else {
        parameters.codec_type = AVMEDIA_TYPE_VIDEO;
        parameters.width = packets.width;
        parameters.height = packets.height;
        stream->avg_frame_rate = {10, 1};
    }
    stream->time_base = {1, 10};
    EXPECT_GE(avformat_write_header(container, nullptr), 0);
    std::int64_t time = 0;
    for (const Bytes& content : packets.packets) {
        const Libav<AVPacket> packet(av_packet_alloc());
        EXPECT_GE(av_new_packet(packet.get(), static_cast<int>(content.size())), 0);
        std::memcpy(packet->data, content.data(), content.size());
        packet->flags = AV_PKT_FLAG_KEY;
        packet->pts = packet->dts = time;
        packet->duration = 1;
        ++time;
        av_packet_rescale_ts(packet.get(), {1, 10}, stream->time_base);
        EXPECT_GE(av_write_frame(container, packet.get()), 0);
    }
    EXPECT_GE(av_write_trailer(container), 0);
    avio_flush(io.get());
    avformat_free_context(container);
    return file;
}

Bytes animated_webp(const Clip& clip, const std::vector<int>& durations_ms) {
    WebPAnimEncoderOptions options;
    EXPECT_NE(WebPAnimEncoderOptionsInit(&options), 0);
    WebPAnimEncoder* encoder =
        WebPAnimEncoderNew(clip.format.width, clip.format.height, &options);
    WebPConfig config;
    EXPECT_NE(WebPConfigInit(&config), 0);
    config.lossless = 1;
    config.exact = 1;
    int time_ms = 0;
    for (std::size_t i = 0; i < clip.pictures.size(); ++i) {
        WebPPicture picture;
        EXPECT_NE(WebPPictureInit(&picture), 0);
        picture.width = clip.format.width;
        picture.height = clip.format.height;
        picture.use_argb = 1;
        const auto* pixels =
            reinterpret_cast<const std::uint8_t*>(clip.pictures[i].pixels.data());
        EXPECT_NE(WebPPictureImportRGBA(&picture, pixels, 4 * clip.format.width), 0);
        EXPECT_NE(WebPAnimEncoderAdd(encoder, &picture, time_ms, &config), 0);
        WebPPictureFree(&picture);
        time_ms += durations_ms[i];
    }
    EXPECT_NE(WebPAnimEncoderAdd(encoder, nullptr, time_ms, nullptr), 0);
    WebPData assembled;
    WebPDataInit(&assembled);
    EXPECT_NE(WebPAnimEncoderAssemble(encoder, &assembled), 0);
    const Bytes file(assembled.bytes, assembled.bytes + assembled.size);
    WebPDataClear(&assembled);
    WebPAnimEncoderDelete(encoder);
    return file;
}

Bytes y4m_of(int width, int height, const std::vector<Yuv>& frames) {
    const std::string head = "YUV4MPEG2 W" + std::to_string(width) + " H" +
                             std::to_string(height) + " F24000:1001 Ip A1:1 C444\n";
    Bytes file(head.begin(), head.end());
    const std::string_view frame_head = "FRAME\n";
    const auto area = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    for (const Yuv& color : frames) {
        file.insert(file.end(), frame_head.begin(), frame_head.end());
        for (const std::uint8_t plane : {color.y, color.u, color.v}) {
            file.insert(file.end(), area, plane);
        }
    }
    return file;
}

}  // namespace haarmony::ingest::testing
