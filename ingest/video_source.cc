#include "ingest/video_source.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/video/create_frame.h"
#include "ingest/one_line.h"
#include "ingest/sniff.h"
#include "ingest/socket_child.h"
#include "ingest/socket_wire.h"
#include "ingest/unsupported.h"

namespace haarmony::ingest {
namespace {

constexpr const char* kProgramName = "haarmony-video";

class ChildSource : public PictureSource {
  public:
    ChildSource(VideoFormat kind, const VideoSourceOptions& options)
        : kind_(kind), options_(options) {}

    [[nodiscard]] Result<void> open(const FileDescriptor& file);
    [[nodiscard]] const video::FrameFormat& format() const override { return format_; }
    [[nodiscard]] Result<bool> next(TimedPicture& shown) override;

  private:
    using Clock = SocketChild::Clock;

    // The next reply and what follows it up to its pixels; kFailed has become an error.
    [[nodiscard]] Result<VideoReply> receive(Clock::time_point deadline);
    [[nodiscard]] Error failure(Received received);
    [[nodiscard]] Error bury(const std::string& sign);

    VideoFormat kind_;
    VideoSourceOptions options_;
    SocketChild child_;
    video::FrameFormat format_;
    std::int64_t pictures_ = 0;
};

Error ChildSource::bury(const std::string& sign) {
    return {ErrorCode::kUndecodable,
            "damaged " + std::string(name_of(kind_)) + ": its decoder " +
                child_.bury(sign, options_.cpu_time.count())};
}

Error ChildSource::failure(Received received) {
    if (received == Received::kEnd) return bury("");
    return bury("did not answer within " + std::to_string(options_.patience.count()) +
                " ms");
}

Result<VideoReply> ChildSource::receive(Clock::time_point deadline) {
    VideoReply reply;
    Received received = child_.receive(&reply, sizeof(reply), deadline);
    if (received != Received::kAll) return failure(received);
    if (!check_read_reply(reply, format_, options_.max_pixels)) {
        return bury("crashed (its answer makes no sense)");
    }
    if (reply.kind != VideoReplyKind::kFailed) return reply;
    std::string text(reply.length, '\0');
    received = child_.receive(text.data(), text.size(), deadline);
    if (received != Received::kAll) return failure(received);
    child_.kill_and_wait();
    return Error{reply.error, one_line(text)};
}

Result<void> ChildSource::open(const FileDescriptor& file) {
    const std::string program =
        options_.program.empty() ? find_program(kProgramName) : options_.program;
    auto started = child_.start(program, "reads clips", options_.child_bytes);
    if (!started) return started;
    VideoRequest request;
    request.task = VideoTask::kRead;
    request.source = kind_;
    request.frames = options_.frames;
    request.max_pixels = options_.max_pixels;
    request.cpu_seconds = options_.cpu_time.count();
    const Clock::time_point deadline = Clock::now() + options_.patience;
    // One that is gone already is found so by the answer that does not come.
    static_cast<void>(
        send_with_file(child_.socket(), &request, sizeof(request), file.get()));
    const Result<VideoReply> reply = receive(deadline);
    if (!reply) return reply.error();
    if (reply->kind != VideoReplyKind::kOpened) {
        return bury("crashed (its answer makes no sense)");
    }
    format_ = reply->format;
    return {};
}

Result<bool> ChildSource::next(TimedPicture& shown) {
    if (!child_.running()) return false;
    const Clock::time_point deadline = Clock::now() + options_.patience;
    const Result<VideoReply> reply = receive(deadline);
    if (!reply) return reply.error();
    if (reply->kind == VideoReplyKind::kDone) {
        child_.kill_and_wait();
        return false;
    }
    if (pictures_ == options_.max_frames) {
        child_.kill_and_wait();
        return Error{ErrorCode::kTooLarge,
                     "the " + std::string(name_of(kind_)) + " has more than " +
                         std::to_string(options_.max_frames) + " frames"};
    }
    const auto pixels = static_cast<std::size_t>(format_.width) *
                        static_cast<std::size_t>(format_.height);
    // Whoever has moved the last picture away has left its size here.
    if (shown.picture.width != format_.width || shown.picture.pixels.size() != pixels) {
        shown.picture = video::Picture(format_.width, format_.height);
    }
    const Received received =
        child_.receive(shown.picture.pixels.data(), reply->length, deadline);
    if (received != Received::kAll) return failure(received);
    shown.time_us = reply->time_us;
    ++pictures_;
    return true;
}

Result<std::vector<std::uint8_t>> beginning_of(const FileDescriptor& file) {
    std::vector<std::uint8_t> bytes(kSniffBytes);
    std::size_t filled = 0;
    while (filled < bytes.size()) {
        const ssize_t got = ::pread(file.get(),
                                    bytes.data() + filled,
                                    bytes.size() - filled,
                                    static_cast<off_t>(filled));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            return Error{ErrorCode::kIo,
                         "reading the video: " + std::generic_category().message(errno)};
        }
        if (got == 0) break;
        filled += static_cast<std::size_t>(got);
    }
    bytes.resize(filled);
    return bytes;
}

}  // namespace

bool is_video(std::span<const std::uint8_t> first_bytes) {
    return sniff_video(first_bytes).has_value();
}

Result<std::unique_ptr<PictureSource>> open_video(FileDescriptor file,
                                                  const VideoSourceOptions& options) {
    const auto beginning = beginning_of(file);
    if (!beginning) return beginning.error();
    const std::optional<VideoFormat> kind = sniff_video(*beginning);
    if (!kind) return unsupported_format(*beginning, "video");
    auto source = std::make_unique<ChildSource>(*kind, options);
    if (auto opened = source->open(file); !opened) return opened.error();
    return std::unique_ptr<PictureSource>(std::move(source));
}

Result<std::unique_ptr<PictureSource>> open_video(std::span<const std::uint8_t> bytes,
                                                  const VideoSourceOptions& options) {
    Result<FileDescriptor> file = sealed_memory(bytes);
    if (!file) return file.error();
    return open_video(std::move(file).value(), options);
}

PictureFrameSource::PictureFrameSource(std::unique_ptr<PictureSource> pictures)
    : pictures_(std::move(pictures)) {
    assert(pictures_ != nullptr);
}

const video::FrameFormat& PictureFrameSource::format() const {
    return pictures_->format();
}

Result<bool> PictureFrameSource::next(video::SourceFrame& frame) {
    Result<bool> more = pictures_->next(shown_);
    if (!more || !*more) return more;
    video::create_frame(shown_.picture.view(), frame.tree);
    frame.repeats = 1;
    return true;
}

}  // namespace haarmony::ingest
