#include "server/app/video_service.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "engine/video/decoded_cache.h"
#include "engine/video/mrv_clip.h"
#include "server/app/log_value.h"
#include "server/app/mapped_file.h"

namespace haarmony::server {
namespace {

// What the client only sees as "the server could not answer".
template <typename Answer>
Answer logged(Answer answer) {
    if (!answer && (answer.error().code == ErrorCode::kIo ||
                    answer.error().code == ErrorCode::kUndecodable))
        spdlog::error("event=video_failed reason={}", log_value(answer.error().message));
    return answer;
}

class MappedVideo final : public OpenVideo {
  public:
    MappedVideo(schema::Video row,
                std::unique_ptr<video::TimeTree> clip,
                std::shared_ptr<const MappedFile> file)
        : OpenVideo(std::move(row), std::move(clip)), file_(std::move(file)) {}

  private:
    std::shared_ptr<const MappedFile> file_;
};

// A damaged clip is the server's own: the client has sent nothing wrong.
Error broken(const schema::Video& video, const Error& error) {
    return {ErrorCode::kIo,
            "video " + std::to_string(video.id) + " cannot be read: " + error.message};
}

Result<std::shared_ptr<const OpenVideo>> open_video(
    const VideoFiles& files,
    const schema::Video& row,
    const std::shared_ptr<video::DecodedCache>& layers) {
    auto file = MappedFile::open(files.clip_path(row.id, row.revision));
    if (!file) return broken(row, file.error());
    auto clip = video::MrvClip::open((*file)->bytes(), layers);
    if (!clip) return broken(row, clip.error());
    return std::shared_ptr<const OpenVideo>(
        std::make_shared<MappedVideo>(row, std::move(clip).value(), *std::move(file)));
}

// The inputs of all jobs that have not ended.
Result<std::set<std::string, std::less<>>> wanted_inputs(schema::JobStore& jobs) {
    constexpr int kPage = 1'000;
    std::set<std::string, std::less<>> inputs;
    std::optional<std::int64_t> after;
    for (;;) {
        const auto page = jobs.list(kPage, after);
        if (!page) return page.error();
        for (const schema::Job& job : *page) {
            after = job.id;
            if (job.state != schema::JobState::kQueued &&
                job.state != schema::JobState::kRunning)
                continue;
            const auto request = nlohmann::json::parse(job.request, nullptr, false);
            if (request.is_object() && request.contains("input") &&
                request["input"].is_string())
                inputs.insert(request["input"].get<std::string>());
        }
        if (page->size() < kPage) return inputs;
    }
}

}  // namespace

Result<std::unique_ptr<VideoService>> VideoService::open(
    const VideoServiceOptions& options) {
    auto writer =
        Connection::open(options.database_path, schema::Database::Mode::kReadWriteCreate);
    if (!writer) return std::move(writer).error();
    std::unique_ptr<VideoService> service(
        new VideoService(options, std::move(writer).value()));
    Result<void> ready = service->files_.prepare();
    if (ready) ready = service->sweep();
    if (!ready) return ready.error();
    return service;
}

VideoService::VideoService(const VideoServiceOptions& options,
                           std::unique_ptr<Connection> writer)
    : options_(options),
      files_(options.database_path),
      replies_(options.reply_cache_bytes),
      layers_(std::make_shared<video::DecodedCache>(options.layer_cache_bytes)),
      writer_(std::move(writer)),
      readers_([path = options.database_path] {
          return Connection::open(path, schema::Database::Mode::kReadOnly);
      }) {}

Result<void> VideoService::sweep() {
    const std::lock_guard lock(writer_mutex_);
    const auto inputs = wanted_inputs(writer_->jobs());
    if (!inputs) return inputs.error();
    return writer_->videos().while_nobody_writes(
        [&](const std::vector<schema::Video>& videos) -> Result<void> {
            const auto removed = files_.sweep(
                videos, [&](std::string_view input) { return inputs->contains(input); });
            if (!removed) return removed.error();
            if (*removed > 0)
                spdlog::info("event=video_files_removed count={}", *removed);
            return {};
        });
}

template <typename Work>
auto VideoService::read(Work&& work) {
    using Answer = decltype(work(std::declval<schema::VideoStore&>()));
    auto connection = readers_.lend();
    if (!connection) return logged(Answer(connection.error()));
    return logged(work((*connection)->videos()));
}

Result<schema::Video> VideoService::get(std::int64_t id) {
    return read([&](schema::VideoStore& videos) { return videos.get(id); });
}

Result<std::vector<schema::Video>> VideoService::list(int limit, std::int64_t after) {
    return read([&](schema::VideoStore& videos) { return videos.list(limit, after); });
}

Result<std::int64_t> VideoService::count() {
    return read([](schema::VideoStore& videos) { return videos.count(); });
}

Result<std::optional<schema::Video>> VideoService::made_by(std::int64_t job) {
    return read([&](schema::VideoStore& videos) { return videos.made_by(job); });
}

Result<void> VideoService::remove(std::int64_t id) {
    const auto removed = [&] {
        const std::lock_guard lock(writer_mutex_);
        return logged(writer_->videos().remove(id));
    }();
    if (!removed) return removed.error();
    {
        decltype(held_)::node_type closed;  // with all its layers, behind the lock
        const std::lock_guard lock(mutex_);
        closed = held_.extract(id);
    }
    replies_.forget(id);
    files_.remove_clip(*removed);
    return {};
}

Result<std::shared_ptr<const OpenVideo>> VideoService::clip(std::int64_t id) {
    auto row = get(id);
    if (!row) return row.error();
    {
        const std::lock_guard lock(mutex_);
        const auto found = held_.find(id);
        if (found != held_.end() &&
            found->second.video->row().revision == row->revision) {
            found->second.used = ++uses_;
            return found->second.video;
        }
    }
    auto opened = open_video(files_, *row, layers_);
    // Removed or grown since the row was read: nobody's fault.
    constexpr int kTries = 3;
    for (int tries = 1; !opened && tries < kTries; ++tries) {
        const auto now = get(id);
        if (!now) return now.error();
        if (now->revision == row->revision) break;
        row = now;
        opened = open_video(files_, *row, layers_);
    }
    if (!opened) return logged(std::move(opened));
    std::shared_ptr<const OpenVideo> closed;  // with all its layers, behind the lock
    const std::lock_guard lock(mutex_);
    Held& held = held_[id];
    closed = std::exchange(held.video, *opened);
    held.used = ++uses_;
    if (held_.size() > options_.open_clips) {
        const auto oldest = std::min_element(
            held_.begin(), held_.end(), [](const auto& a, const auto& b) {
                return a.second.used < b.second.used;
            });
        closed = std::move(oldest->second.video);
        held_.erase(oldest);
    }
    return opened;
}

std::size_t VideoService::layer_bytes() const { return layers_->bytes(); }

Result<schema::Video> VideoService::add(const std::string& built,
                                        const schema::Video& video,
                                        std::span<const schema::FrameSignature> frames) {
    const std::lock_guard lock(writer_mutex_);
    schema::VideoStore& videos = writer_->videos();
    if (video.job) {
        auto before = videos.made_by(*video.job);
        if (!before) return logged(Result<schema::Video>(before.error()));
        if (*before) return **std::move(before);
    }
    return logged(videos.add(video, frames, [&](const schema::Video& stored) {
        return files_.publish(built, stored);
    }));
}

Result<schema::Video> VideoService::grow(const std::string& built,
                                         const schema::GrownVideo& video,
                                         std::span<const schema::FrameSignature> frames) {
    const auto grown = [&]() -> Result<schema::Video> {
        const std::lock_guard lock(writer_mutex_);
        schema::VideoStore& videos = writer_->videos();
        if (video.now.job) {
            auto before = videos.made_by(*video.now.job);
            if (!before) return logged(Result<schema::Video>(before.error()));
            if (*before) return **std::move(before);
        }
        return logged(videos.grow(video, frames, [&](const schema::Video& stored) {
            return files_.publish(built, stored);
        }));
    }();
    if (!grown || grown->revision == video.before.revision) return grown;
    {
        const std::lock_guard lock(mutex_);
        held_.erase(video.before.id);
    }
    replies_.forget(video.before.id);
    files_.remove_clip(video.before);
    return grown;
}

}  // namespace haarmony::server
