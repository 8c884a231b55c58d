#include "server/api/video_upload.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/video/append.h"
#include "engine/video/generate/generator.h"
#include "engine/video/mrv_clip.h"
#include "ingest/sniff.h"
#include "ingest/video_source.h"
#include "server/api/inputs.h"
#include "server/api/leaves_json.h"
#include "server/api/points_json.h"
#include "server/api/video_json.h"
#include "server/api/video_wishes.h"
#include "server/app/mapped_file.h"
#include "server/app/raw_frames.h"
#include "server/app/video_request.h"
#include "server/http/header_value.h"

namespace haarmony::server {
namespace {

using Bytes = std::span<const std::byte>;

Bytes bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

std::span<const std::uint8_t> first_of(std::string_view bytes) {
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()),
            std::min(bytes.size(), ingest::kSniffBytes)};
}

// Where frames go: into a new video, or behind those of one that there is.
struct Upload {
    const Context& context;
    std::optional<schema::Video> grows = {};
    video::FrameFormat format = {};  // of the one that grows

    [[nodiscard]] VideoWishes wishes(Inputs& inputs) const {
        for (const std::string_view name : {"name", "delta", "index"})
            if (grows && inputs.has(name))
                inputs.refuse(malformed(
                    std::string(name) + " does not apply: the video keeps its own",
                    name));
        return read_video_wishes(inputs);
    }
    // What is not said is as in the video that grows.
    [[nodiscard]] video::FrameFormat frame_format(Inputs& inputs) const {
        video::FrameFormat read = read_frame_format(inputs);
        if (!grows) return read;
        if (!inputs.has("width")) read.width = format.width;
        if (!inputs.has("height")) read.height = format.height;
        if (!inputs.has("rate")) read.rate = format.rate;
        if (const auto problem = refuses(read)) inputs.refuse(*problem);
        return read;
    }
    [[nodiscard]] std::optional<http::Problem> refuses(
        const video::FrameFormat& frames) const {
        if (!grows) return {};
        const auto follows = video::can_follow(frames, format);
        if (follows) return {};
        return impossible("other_format", follows.error().message, follows.error().param);
    }
    [[nodiscard]] Reply queue(VideoRequest video,
                              std::span<const std::byte> input) const {
        if (grows) video.append_to = grows->id;
        return queue_video(context, std::move(video), input);
    }
};

// "application/json; charset=utf-8" -> "application/json".
std::string media_type_of(const http::Request& request) {
    const std::string_view header = request.header("Content-Type");
    return http::lower_case(http::trim(header.substr(0, header.find(';'))));
}

// Of bytes that are neither a clip nor a film.
http::Problem unsupported(std::string_view bytes, const std::string& type) {
    const auto known = ingest::sniff(first_of(bytes));
    const std::string what =
        known ? std::string(known->name) + " (" + std::string(known->media_type) + ")"
              : "a body of type '" + type + "'";
    return {415,
            "unsupported_format",
            what +
                " is not read; send a film, an animation, a .mrv file, frames of RGBA "
                "as application/octet-stream with width and height, or "
                "application/json",
            "Content-Type",
            {}};
}

// Whether the bytes are a .mrv file, or why they are a bad one.
Outcome<bool> is_clip(const Upload& upload, Bytes bytes) {
    // Nothing is decoded here.
    constexpr std::size_t kNoCache = 0;
    const auto clip = video::MrvClip::open(bytes, kNoCache);
    if (clip) {
        if (const auto problem = upload.refuses((*clip)->shape().format()))
            return *problem;
        return true;
    }
    switch (clip.error().code) {
        case ErrorCode::kUnsupportedFormat:
            return false;
        case ErrorCode::kNewerVersion:
            return impossible("newer_version", clip.error().message, "");
        default:
            return clip.error();
    }
}

Outcome<VideoRequest> read_raw(const Upload& upload,
                               Inputs& inputs,
                               const http::Request& request) {
    VideoRequest video;
    video.origin = VideoOrigin::kRaw;
    video.wishes = upload.wishes(inputs);
    const auto format = upload.frame_format(inputs);
    for (const std::string_view side : {"width", "height"})
        if (!upload.grows && !inputs.has(side))
            inputs.refuse(malformed(std::string(side) + " is missing", side));
    if (const auto problem = inputs.refused()) return *problem;
    video.format = format;
    const auto one = video::ClipShape::make(format, 1);
    if (!one) return impossible(one.error());
    const std::size_t size = raw_frame_bytes(format);
    const std::size_t bytes = request.body.size();
    if (bytes == 0 || bytes % size != 0)
        return impossible("not_whole_frames",
                          std::to_string(bytes) + " bytes are not whole frames of " +
                              std::to_string(size),
                          "width");
    const auto shape =
        video::ClipShape::make(format, static_cast<std::int64_t>(bytes / size));
    if (!shape) return impossible(shape.error());
    return video;
}

Outcome<VideoRequest> read_clip(const Upload& upload, Inputs& inputs) {
    VideoRequest video;
    video.origin = VideoOrigin::kClip;
    for (const std::string_view name : {"delta", "max_frames"})
        if (!upload.grows && inputs.has(name))
            inputs.refuse(malformed(
                std::string(name) + " does not apply: a .mrv file is kept as it is",
                name));
    video.wishes = upload.wishes(inputs);
    if (const auto problem = inputs.refused()) return *problem;
    return video;
}

Outcome<VideoRequest> read_media(const Upload& upload, Inputs& inputs) {
    VideoRequest video;
    video.origin = VideoOrigin::kMedia;
    video.wishes = upload.wishes(inputs);
    if (const auto problem = inputs.refused()) return *problem;
    return video;
}

Reply post_bytes(const Upload& upload,
                 const http::Request& request,
                 const std::string& type) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const bool raw = type == "application/octet-stream" &&
                     (inputs->has("width") || inputs->has("height"));
    if (raw) {
        auto video = read_raw(upload, *inputs, request);
        if (!video) return video.problem();
        return upload.queue(*std::move(video), bytes_of(request.body));
    }
    auto clip = is_clip(upload, bytes_of(request.body));
    if (!clip) return clip.problem();
    if (*clip) {
        auto video = read_clip(upload, *inputs);
        if (!video) return video.problem();
        return upload.queue(*std::move(video), bytes_of(request.body));
    }
    if (ingest::is_video(first_of(request.body))) {
        auto video = read_media(upload, *inputs);
        if (!video) return video.problem();
        return upload.queue(*std::move(video), bytes_of(request.body));
    }
    if (type == "application/octet-stream") {
        // Frames without their size, which is that of the video that they follow.
        auto video = read_raw(upload, *inputs, request);
        if (!video) return video.problem();
        if (upload.grows) return upload.queue(*std::move(video), bytes_of(request.body));
    }
    return unsupported(request.body, type);
}

// A file or a folder of the server.
Reply post_path(const Upload& upload, Inputs& inputs) {
    const std::string path = inputs.text("path").value_or("");
    auto video = read_media(upload, inputs);
    if (!video) return video.problem();
    const auto real = upload.context.media_roots.locate_path(path);
    if (!real) {
        http::Problem problem = http::problem_of(real.error());
        problem.param = "path";
        return problem;
    }
    video->path = path;
    std::error_code error;
    if (std::filesystem::is_directory(*real, error))
        return upload.queue(*std::move(video), {});
    const auto file = MappedFile::open(*real);
    if (!file) return file.error();
    const Bytes bytes = (*file)->bytes();
    auto clip = is_clip(upload, bytes);
    if (!clip) return clip.problem();
    if (*clip) {
        // Its own file becomes the video's, so it is a copy.
        auto kept = read_clip(upload, inputs);
        if (!kept) return kept.problem();
        return upload.queue(*std::move(kept), bytes);
    }
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                                bytes.size());
    if (!ingest::is_video(first_of(text))) return unsupported(text, "");
    return upload.queue(*std::move(video), {});
}

Reply post_leaves(const Upload& upload, Inputs& inputs) {
    VideoRequest video;
    video.origin = VideoOrigin::kLeaves;
    video.wishes = upload.wishes(inputs);
    const video::FrameFormat format = upload.frame_format(inputs);
    const nlohmann::json* frames = inputs.peek("frames");
    if (const auto problem = inputs.refused()) return *problem;
    auto leaves = read_leaf_frames(*frames, format);
    if (!leaves) return leaves.problem();
    video.format = leaves->format;
    return upload.queue(std::move(video), leaves->bytes);
}

Reply post_generator(const Upload& upload, Inputs& inputs) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    VideoRequest video;
    video.origin = VideoOrigin::kGenerated;
    video.generator =
        inputs.one_of("generate", video::kGeneratorNames).value_or(std::string());
    video.wishes = upload.wishes(inputs);
    const video::FrameFormat format = upload.frame_format(inputs);
    video.parameters.width = format.width;
    video.parameters.height = format.height;
    video.parameters.rate = format.rate;
    video.parameters.frames = inputs.integer("frames", -kMost, kMost).value_or(0);
    if (const auto depth = inputs.integer("depth", -kMost, kMost))
        video.parameters.depth = static_cast<int>(*depth);
    video.parameters.seed =
        static_cast<std::uint32_t>(inputs.integer("seed", 0, kMost).value_or(1));
    if (video.parameters.frames < 1 && inputs.has("frames"))
        inputs.refuse(impossible("out_of_range", "frames is not above 0", "frames"));
    if (const auto problem = inputs.refused()) return *problem;
    const auto source = video::make_generator(video.generator, video.parameters);
    if (!source) return impossible(source.error());
    if (const auto problem = upload.refuses((*source)->format())) return *problem;
    return upload.queue(std::move(video), {});
}

Reply post_json(const Upload& upload, const http::Request& request) {
    const Context& context = upload.context;
    if (request.body.size() > context.max_body)
        return http::Problem{413,
                             "body_too_large",
                             "JSON of " + std::to_string(request.body.size()) +
                                 " bytes is longer than the " +
                                 std::to_string(context.max_body) + " that are taken",
                             "Content-Length",
                             {}};
    auto inputs = Inputs::of_request(request);
    if (!inputs) return inputs.problem();
    const int sources = (inputs->has("generate") ? 1 : 0) +
                        (inputs->has("path") ? 1 : 0) +
                        (inputs->has("frames") && !inputs->has("generate") ? 1 : 0);
    if (sources > 1)
        return http::Problem{400,
                             "several_sources",
                             "only one of path, generate and frames may be given",
                             "path",
                             {}};
    if (inputs->has("path")) return post_path(upload, *inputs);
    if (inputs->has("generate")) return post_generator(upload, *inputs);
    if (inputs->has("frames")) return post_leaves(upload, *inputs);
    return http::Problem{400,
                         "no_source",
                         "there is nothing to make a video of: send frames, path or "
                         "generate",
                         "frames",
                         {}};
}

Reply post(const Upload& upload, const http::Request& request) {
    const std::string type = media_type_of(request);
    return type == "application/json" ? post_json(upload, request)
                                      : post_bytes(upload, request, type);
}

}  // namespace

Reply post_video(const Context& context, const http::Request& request) {
    return post({.context = context, .grows = {}, .format = {}}, request);
}

Reply post_frames(const Context& context, const http::Request& request) {
    auto id = video_id_of(request);
    if (!id) return id.problem();
    auto video = context.videos.get(*id);
    if (!video) return video.error();
    if (video->delta != 0)
        return Error{ErrorCode::kConflict,
                     "video " + std::to_string(*id) + " has a delta of " +
                         number_text(video->delta) +
                         ": its frames are not those of its source, and so none can be "
                         "appended",
                     "delta"};
    const auto shape = shape_of(*video);
    if (!shape) return shape.error();
    return post(
        {.context = context, .grows = *std::move(video), .format = shape->format()},
        request);
}

}  // namespace haarmony::server
