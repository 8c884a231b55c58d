#include "ingest/film_child.h"

#include <sys/socket.h>
#include <sys/time.h>

#include <cassert>
#include <string>
#include <utility>
#include <vector>

#include "ingest/one_line.h"
#include "ingest/socket_child.h"
#include "ingest/socket_wire.h"
#include "ingest/video_wire.h"

namespace haarmony::ingest {
namespace {

constexpr const char* kProgramName = "haarmony-video";

class FilmChild : public VideoSink {
  public:
    FilmChild(const VideoSinkOptions& options, FilmOutput output)
        : options_(options), output_(std::move(output)) {}

    [[nodiscard]] Result<void> open();
    [[nodiscard]] Result<void> add(const ImageView& picture) override;
    [[nodiscard]] Result<void> finish() override;

  private:
    using Clock = SocketChild::Clock;

    // What it has to say up to the next kDone.
    [[nodiscard]] Result<void> collect();
    [[nodiscard]] Result<void> collect_part(Clock::time_point deadline, bool& done);
    [[nodiscard]] Error failure(Received received);
    [[nodiscard]] Error bury(const std::string& sign);

    VideoSinkOptions options_;
    FilmOutput output_;
    SocketChild child_;
    std::vector<std::uint8_t> part_;
};

Error FilmChild::bury(const std::string& sign) {
    return {ErrorCode::kUnavailable, "the encoder of the film " + child_.bury(sign, 0)};
}

Error FilmChild::failure(Received received) {
    if (received == Received::kEnd) return bury("");
    return bury("did not answer within " + std::to_string(options_.patience.count()) +
                " ms");
}

Result<void> FilmChild::collect_part(Clock::time_point deadline, bool& done) {
    VideoReply reply;
    Received received = child_.receive(&reply, sizeof(reply), deadline);
    if (received != Received::kAll) return failure(received);
    if (!check_film_reply(reply)) return bury("crashed (its answer makes no sense)");
    part_.resize(reply.length);
    received = child_.receive(part_.data(), part_.size(), deadline);
    if (received != Received::kAll) return failure(received);
    done = reply.kind == VideoReplyKind::kDone;
    if (reply.kind == VideoReplyKind::kBytes) return output_(part_);
    if (reply.kind == VideoReplyKind::kFailed) {
        return Error{
            reply.error,
            one_line({reinterpret_cast<const char*>(part_.data()), part_.size()})};
    }
    return {};
}

// The clock runs while the child works, not while the output is taken.
Result<void> FilmChild::collect() {
    bool done = false;
    while (!done) {
        auto collected = collect_part(Clock::now() + options_.patience, done);
        if (!collected) {
            child_.kill_and_wait();
            return collected;
        }
    }
    return {};
}

Result<void> FilmChild::open() {
    const std::string program =
        options_.program.empty() ? find_program(kProgramName) : options_.program;
    auto started = child_.start(program, "encodes films", options_.child_bytes);
    if (!started) return started;
    const auto ms = options_.patience.count();
    const timeval patience = {ms / 1000, ms % 1000 * 1000};
    ::setsockopt(child_.socket(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof(patience));
    VideoRequest request;
    request.task = options_.container == Container::kMp4 ? VideoTask::kWriteMp4
                                                         : VideoTask::kWriteWebm;
    request.format = options_.format;
    request.background = options_.background;
    // Here and below: one that is gone or takes nothing any more is found so by the answer
    // that does not come.
    static_cast<void>(send_with_file(child_.socket(), &request, sizeof(request), -1));
    return collect();
}

Result<void> FilmChild::add(const ImageView& picture) {
    FilmMessage message;
    message.step = FilmStep::kAdd;
    bool sent = send_all(child_.socket(), &message, sizeof(message));
    const std::size_t row_bytes =
        std::size_t{4} * static_cast<std::size_t>(picture.width);
    for (int y = 0; y < picture.height && sent; ++y) {
        sent = send_all(child_.socket(), picture.row(y), row_bytes);
    }
    return collect();
}

Result<void> FilmChild::finish() {
    FilmMessage message;
    message.step = FilmStep::kFinish;
    static_cast<void>(send_all(child_.socket(), &message, sizeof(message)));
    auto collected = collect();
    child_.kill_and_wait();
    return collected;
}

}  // namespace

Result<std::unique_ptr<VideoSink>> open_film_child(const VideoSinkOptions& options,
                                                   FilmOutput output) {
    assert(options.container == Container::kMp4 || options.container == Container::kWebm);
    auto film = std::make_unique<FilmChild>(options, std::move(output));
    if (auto opened = film->open(); !opened) return opened.error();
    return std::unique_ptr<VideoSink>(std::move(film));
}

}  // namespace haarmony::ingest
