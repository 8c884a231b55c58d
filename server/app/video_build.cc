#include "server/app/video_build.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "engine/video/accounting.h"
#include "engine/video/append.h"
#include "engine/video/build.h"
#include "engine/video/mrv_clip.h"
#include "engine/video/mrv_writer.h"
#include "server/app/file_spool.h"
#include "server/app/frame_signatures.h"
#include "server/app/grown_file.h"
#include "server/app/mapped_file.h"

namespace haarmony::server {
namespace {

// Of decoded layers, while a clip is counted: the walk comes back to the time-ancestors.
constexpr std::size_t kCountingCache = std::size_t{128} << 20;

std::string hexadecimal(std::uint64_t revision) {
    char text[17];
    std::snprintf(
        text, sizeof text, "%016llx", static_cast<unsigned long long>(revision));
    return text;
}

Result<schema::Video> describe(const video::MrvClip& clip,
                               std::uint64_t memory_bytes,
                               std::uint64_t file_bytes,
                               const VideoWishes& wishes) {
    const auto counts = video::count_storage(clip);
    if (!counts) return counts.error();
    const video::ClipShape& shape = clip.shape();
    schema::Video row;
    row.revision = hexadecimal(clip.revision());
    row.name = wishes.name;
    row.width = shape.width();
    row.height = shape.height();
    row.frames = shape.frames();
    row.rate_numerator = shape.rate().numerator;
    row.rate_denominator = shape.rate().denominator;
    row.delta = static_cast<double>(clip.delta()) / video::kDifferenceOne;
    row.storage = {static_cast<std::int64_t>(counts->time_nodes),
                   static_cast<std::int64_t>(counts->complete_subtrees),
                   static_cast<std::int64_t>(counts->pruned_subtrees),
                   static_cast<std::int64_t>(counts->own_subtrees),
                   static_cast<std::int64_t>(counts->uplinks),
                   static_cast<std::int64_t>(memory_bytes),
                   static_cast<std::int64_t>(file_bytes)};
    row.indexed = wishes.index;
    return row;
}

void tell(JobContext& job, const schema::Video& video, bool is_new) {
    job.counts().seen = video.frames;
    job.counts().added = is_new ? 1 : 0;
    job.set_total(video.frames);
    job.note("video", video.id);
}

// Whether an earlier run of the job has come to its end already.
Result<bool> made_before(JobContext& job, VideoService& videos, bool is_new) {
    const auto before = videos.made_by(job.job().id);
    if (!before) return before.error();
    if (before->has_value()) tell(job, **before, is_new);
    return before->has_value();
}

// Nothing while there is room on the disk, else what to say.
std::optional<Error> no_room(VideoService& videos, std::int64_t frames) {
    const auto free = videos.files().free_bytes();
    if (!free) return free.error();
    if (*free >= videos.room_left()) return std::nullopt;
    return Error{ErrorCode::kTooLarge,
                 "the disk has " + std::to_string(*free >> 20U) +
                     " MB left after frame " + std::to_string(frames) + ", and " +
                     std::to_string(videos.room_left() >> 20U) +
                     " MB are to stay free: make it with max_frames, smaller, or with a "
                     "larger delta"};
}

// Tells how far a build has come, and ends it when the job is stopped or the disk is full.
class BuildWatch {
  public:
    BuildWatch(JobContext& job, VideoService& videos) : job_(job), videos_(videos) {}

    [[nodiscard]] video::BuildObserver observer() {
        return [this](std::int64_t frames, std::int64_t nodes) {
            job_.counts().seen = frames;
            job_.counts().updated = nodes;
            job_.progress();
            full_ = no_room(videos_, frames);
            return !full_ && !job_.cancelled();
        };
    }
    // Why it was ended where the disk is full.
    [[nodiscard]] const std::optional<Error>& full() const { return full_; }

  private:
    JobContext& job_;
    VideoService& videos_;
    std::optional<Error> full_;
};

Result<std::vector<schema::FrameSignature>> signatures_of(JobContext& job,
                                                          const video::TimeTree& clip,
                                                          std::int64_t kept_frames) {
    return frame_signatures(clip, kept_frames, [&job] {
        job.progress();
        return !job.cancelled();
    });
}

// Counts what the layers take while they pass.
class CountingSink final : public video::ClipSink {
  public:
    explicit CountingSink(video::ClipSink& sink) : sink_(sink) {}

    Result<void> begin(const video::ClipShape& shape, std::uint32_t delta) override {
        return sink_.begin(shape, delta);
    }
    Result<void> add(video::Siblings siblings) override {
        bytes_ +=
            sizeof(video::TimeNode) * static_cast<std::size_t>(siblings.nodes.count);
        for (video::Layer& layer : siblings.layers) {
            layer.compact();
            bytes_ += layer.memory_bytes();
        }
        return sink_.add(std::move(siblings));
    }
    Result<void> finish() override { return sink_.finish(); }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

  private:
    video::ClipSink& sink_;
    std::uint64_t bytes_ = 0;
};

// Written, and on the disk: what it takes when all of it is decoded.
Result<std::uint64_t> write_clip(JobContext& job,
                                 VideoService& videos,
                                 video::FrameSource& source,
                                 const VideoWishes& wishes) {
    const VideoFiles& files = videos.files();
    auto averages = FileSpool::nameless(files.folder());
    if (!averages) return averages.error();
    auto waiting = FileSpool::nameless(files.folder());
    if (!waiting) return waiting.error();
    auto file = FileSpool::named(files.building_path(job.job().id));
    if (!file) return file.error();
    video::MrvWriter writer(*waiting, *file);
    video::BuildOptions options;
    options.delta = delta_units(wishes.delta);
    options.max_frames = wishes.max_frames;
    BuildWatch watch(job, videos);
    options.progress = watch.observer();
    CountingSink counted(writer);
    const auto shape = video::build(source, *averages, counted, options);
    if (watch.full()) return *watch.full();
    if (!shape) return shape.error();
    if (const auto synced = file->sync(); !synced) return synced.error();
    return counted.bytes();
}

// A copy of the clip with the frames behind its own, on the disk.
Result<void> write_grown(JobContext& job,
                         VideoService& videos,
                         const schema::Video& before,
                         const std::string& path,
                         video::FrameSource& source,
                         std::int64_t most) {
    const VideoFiles& files = videos.files();
    const std::string published = files.clip_path(before.id, before.revision);
    const auto file = MappedFile::open(published);
    // A client is not told where it was.
    if (!file && file.error().code == ErrorCode::kNotFound)
        return Error{ErrorCode::kNotFound,
                     "video " + std::to_string(before.id) + " has been removed",
                     "video"};
    if (!file) return file.error();
    auto grown = GrownFile::copy_of(published, path);
    if (!grown) return grown.error();
    const auto clip = video::MrvClip::open((*file)->bytes(), kCountingCache);
    if (!clip) return clip.error();
    auto averages = FileSpool::nameless(files.folder());
    if (!averages) return averages.error();
    auto waiting = FileSpool::nameless(files.folder());
    if (!waiting) return waiting.error();
    video::MrvWriter writer((*clip)->front(), *waiting, *grown);
    video::AppendOptions options;
    options.max_frames = most;
    BuildWatch watch(job, videos);
    options.progress = watch.observer();
    const auto shape = video::append(**clip, source, *averages, writer, options);
    if (watch.full()) return *watch.full();
    if (!shape) return shape.error();
    return {};
}

Result<schema::Video> keep_grown(JobContext& job,
                                 VideoService& videos,
                                 const schema::Video& before,
                                 const std::string& path) {
    const auto file = MappedFile::open(path);
    if (!file) return file.error();
    const auto clip = video::MrvClip::open((*file)->bytes(), kCountingCache);
    if (!clip) return clip.error();
    const auto memory = (*clip)->memory_bytes();
    if (!memory) return memory.error();
    auto row = describe(**clip, *memory, (*file)->bytes().size(), {});
    if (!row) return row.error();
    schema::GrownVideo grown;
    grown.before = before;
    grown.now = *std::move(row);
    grown.now.job = job.job().id;
    grown.time_levels = (*clip)->shape().time_levels();
    const auto old = video::ClipShape::make((*clip)->shape().format(), before.frames);
    if (!old) return old.error();
    grown.time_levels_before = old->time_levels();
    std::vector<schema::FrameSignature> frames;
    if (before.indexed) {
        auto signatures = signatures_of(job, **clip, before.frames);
        if (!signatures) return signatures.error();
        frames = *std::move(signatures);
    }
    if (job.cancelled()) return Error{ErrorCode::kUnavailable, "the job was stopped"};
    return videos.grow(path, grown, frames);
}

Result<void> keep(JobContext& job,
                  VideoService& videos,
                  const std::string& path,
                  const VideoWishes& wishes,
                  std::optional<std::uint64_t> memory_bytes) {
    const auto file = MappedFile::open(path);
    if (!file) return file.error();
    const auto clip = video::MrvClip::open((*file)->bytes(), kCountingCache);
    if (!clip) return clip.error();
    if (!memory_bytes) {
        const auto walked = (*clip)->memory_bytes();
        if (!walked) return walked.error();
        memory_bytes = *walked;
    }
    auto row = describe(**clip, *memory_bytes, (*file)->bytes().size(), wishes);
    if (!row) return row.error();
    row->job = job.job().id;
    std::vector<schema::FrameSignature> frames;
    if (wishes.index) {
        auto signatures = signatures_of(job, **clip, 0);
        if (!signatures) return signatures.error();
        frames = *std::move(signatures);
    }
    if (job.cancelled()) return {};
    const auto added = videos.add(path, *row, frames);
    if (!added) return added.error();
    tell(job, *added, true);
    return {};
}

}  // namespace

Result<void> keep_video(JobContext& job,
                        VideoService& videos,
                        const std::string& path,
                        const VideoWishes& wishes) {
    const auto before = made_before(job, videos, true);
    if (!before) return before.error();
    if (*before) return {};
    return keep(job, videos, path, wishes, std::nullopt);
}

Result<void> build_video(JobContext& job,
                         VideoService& videos,
                         video::FrameSource& source,
                         const VideoWishes& wishes,
                         std::optional<std::int64_t> frames) {
    const auto before = made_before(job, videos, true);
    if (!before) return before.error();
    if (*before) return {};
    if (frames) job.set_total(*frames);
    const std::string path = videos.files().building_path(job.job().id);
    const auto memory_bytes = write_clip(job, videos, source, wishes);
    const Result<void> done = memory_bytes
                                  ? keep(job, videos, path, wishes, *memory_bytes)
                                  : Result<void>(memory_bytes.error());
    // Gone where it was published.
    ::unlink(path.c_str());
    if (job.was_interrupted()) return {};
    return done;
}

Result<void> append_to_video(JobContext& job,
                             VideoService& videos,
                             std::int64_t id,
                             video::FrameSource& source,
                             std::int64_t most,
                             std::optional<std::int64_t> frames) {
    const auto before = made_before(job, videos, false);
    if (!before) return before.error();
    if (*before) return {};
    const auto video = videos.get(id);
    if (!video) return video.error();
    if (frames) {
        const std::int64_t more = most == 0 ? *frames : std::min(*frames, most);
        job.set_total(video->frames + more);
    }
    const std::string path = videos.files().building_path(job.job().id);
    Result<void> done = write_grown(job, videos, *video, path, source, most);
    if (done) {
        const auto grown = keep_grown(job, videos, *video, path);
        if (grown) tell(job, *grown, false);
        if (!grown) done = grown.error();
    }
    // Gone where it was published.
    ::unlink(path.c_str());
    if (job.was_interrupted()) return {};
    return done;
}

}  // namespace haarmony::server
