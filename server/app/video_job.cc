#include "server/app/video_job.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "engine/video/generate/generator.h"
#include "engine/video/mrv_clip.h"
#include "engine/video/ops/clip_frames.h"
#include "engine/video/ops/compose.h"
#include "server/app/leaf_frames.h"
#include "server/app/mapped_file.h"
#include "server/app/raw_frames.h"
#include "server/app/video_build.h"
#include "server/app/video_media.h"
#include "server/app/video_request.h"

namespace haarmony::server {
namespace {

// Of decoded layers, while a clip from elsewhere is checked.
constexpr std::size_t kCheckingCache = std::size_t{128} << 20;

// A client is told that his upload is gone, and not where it was.
Result<std::shared_ptr<const MappedFile>> open_input(const VideoFiles& files,
                                                     const std::string& input) {
    auto file = MappedFile::open(files.input_path(input));
    if (!file && file.error().code == ErrorCode::kNotFound)
        return Error{ErrorCode::kNotFound, "what was sent for this job is gone"};
    return file;
}

// A new video, or an old one that goes on.
Result<void> make_video(JobContext& job,
                        VideoService& videos,
                        const VideoRequest& request,
                        video::FrameSource& source,
                        std::optional<std::int64_t> frames) {
    if (!request.append_to)
        return build_video(job, videos, source, request.wishes, frames);
    return append_to_video(
        job, videos, *request.append_to, source, request.wishes.max_frames, frames);
}

Result<void> build_raw(JobContext& job,
                       VideoService& videos,
                       const VideoRequest& request) {
    const auto input = open_input(videos.files(), request.input);
    if (!input) return input.error();
    RawFrames frames((*input)->bytes(), request.format);
    auto count = static_cast<std::int64_t>((*input)->bytes().size() /
                                           raw_frame_bytes(request.format));
    if (request.wishes.max_frames > 0) count = std::min(count, request.wishes.max_frames);
    return make_video(job, videos, request, frames, count);
}

Result<void> build_leaves(JobContext& job,
                          VideoService& videos,
                          const VideoRequest& request) {
    const auto input = open_input(videos.files(), request.input);
    if (!input) return input.error();
    LeafFrames frames((*input)->bytes(), request.format);
    return make_video(job, videos, request, frames, std::nullopt);
}

Result<void> keep_clip(JobContext& job,
                       VideoService& videos,
                       const VideoRequest& request) {
    const auto before = videos.made_by(job.job().id);
    if (!before) return before.error();
    // An earlier run has made the input the video's own file.
    if (!before->has_value()) {
        const auto input = open_input(videos.files(), request.input);
        if (!input) return input.error();
        const auto clip = video::MrvClip::open((*input)->bytes(), kCheckingCache);
        if (!clip) return clip.error();
        if (const auto whole = (*clip)->verify(); !whole) return whole;
    }
    return keep_video(
        job, videos, videos.files().input_path(request.input), request.wishes);
}

Result<void> append_clip(JobContext& job,
                         VideoService& videos,
                         const VideoRequest& request) {
    const auto input = open_input(videos.files(), request.input);
    if (!input) return input.error();
    const auto clip = video::MrvClip::open((*input)->bytes(), kCheckingCache);
    if (!clip) return clip.error();
    if (const auto whole = (*clip)->verify(); !whole) return whole;
    const std::int64_t count = (*clip)->shape().frames();
    const auto frames = video::range_frames(**clip, {0, count});
    if (!frames) return frames.error();
    return make_video(job, videos, request, **frames, count);
}

Result<void> build_generated(JobContext& job,
                             VideoService& videos,
                             const VideoRequest& request) {
    const auto source = video::make_generator(request.generator, request.parameters);
    if (!source) return source.error();
    return make_video(job, videos, request, **source, std::nullopt);
}

Result<void> build_composed(JobContext& job,
                            VideoService& videos,
                            const VideoRequest& request) {
    std::shared_ptr<const MappedFile> stills;
    if (!request.input.empty()) {
        auto input = open_input(videos.files(), request.input);
        if (!input) return input.error();
        stills = *std::move(input);
    }
    const auto opened =
        OpenComposition::open(videos,
                              request.composition,
                              stills ? stills->bytes() : std::span<const std::byte>());
    if (!opened) return opened.error();
    const auto source = video::Composition::make(opened->layers(), opened->canvas());
    if (!source) return source.error();
    return build_video(job, videos, **source, request.wishes, opened->shape().frames());
}

Result<void> build_media(JobContext& job,
                         VideoService& videos,
                         const MediaRoots& media_roots,
                         const VideoRequest& request) {
    std::string path = videos.files().input_path(request.input);
    if (!request.path.empty()) {
        auto real = media_roots.locate_path(request.path);
        if (!real) return real.error();
        path = *std::move(real);
    }
    const auto source = open_media(path, media_roots);
    if (!source) return source.error();
    return make_video(job, videos, request, **source, std::nullopt);
}

Result<void> run(JobContext& job, VideoService& videos, const MediaRoots& media_roots) {
    const auto request = video_request_of(job.request());
    if (!request) return request.error();
    switch (request->origin) {
        case VideoOrigin::kRaw:
            return build_raw(job, videos, *request);
        case VideoOrigin::kLeaves:
            return build_leaves(job, videos, *request);
        case VideoOrigin::kClip:
            return request->append_to ? append_clip(job, videos, *request)
                                      : keep_clip(job, videos, *request);
        case VideoOrigin::kGenerated:
            return build_generated(job, videos, *request);
        case VideoOrigin::kComposed:
            return build_composed(job, videos, *request);
        case VideoOrigin::kMedia:
            return build_media(job, videos, media_roots, *request);
    }
    return Error{ErrorCode::kInvalidArgument,
                 "the request " + job.request() + " is not understood"};
}

}  // namespace

JobType video_job(VideoService& videos, const MediaRoots& media_roots) {
    JobType type;
    type.run = [&videos, media_roots](JobContext& job) {
        return run(job, videos, media_roots);
    };
    type.ended = [&videos](const schema::Job& job) {
        if (const auto input = input_of_request(job.request))
            videos.files().remove_input(*input);
    };
    return type;
}

}  // namespace haarmony::server
