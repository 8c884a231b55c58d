#include "tests/eval/video_clips.h"

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>

#include "engine/video/create_frame.h"
#include "engine/video/generate/generator.h"
#include "engine/video/ops/tree_picture.h"
#include "ingest/sniff.h"
#include "ingest/video_source.h"

namespace haarmony::eval {
namespace {

namespace fs = std::filesystem;

// A panorama is all around: four times as wide as high.
constexpr std::int32_t kPanoramaAspect = 4;

Error named(const std::string& name, const Error& error) {
    return {error.code, name + ": " + error.message, error.param};
}

bool begins_like_a_clip(const fs::path& path) {
    std::array<char, ingest::kSniffBytes> first{};
    std::ifstream file(path, std::ios::binary);
    file.read(first.data(), static_cast<std::streamsize>(first.size()));
    const auto count = static_cast<std::size_t>(file.gcount());
    return ingest::is_video(
        std::span(reinterpret_cast<const std::uint8_t*>(first.data()), count));
}

Result<VideoClip> load_file(const std::string& name,
                            const std::string& path,
                            std::int64_t frames) {
    ingest::FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.valid()) {
        return Error{ErrorCode::kIo,
                     path + ": " + std::generic_category().message(errno)};
    }
    auto opened = ingest::open_video(std::move(file), {});
    if (!opened) return named(name, opened.error());
    VideoClip clip{name, VideoKind::kNatural, (*opened)->format(), {}};
    ingest::TimedPicture shown;
    while (static_cast<std::int64_t>(clip.frames.size()) < frames) {
        const Result<bool> more = (*opened)->next(shown);
        if (!more) return named(name, more.error());
        if (!*more) break;
        clip.frames.push_back(shown.picture);
    }
    if (clip.frames.empty()) {
        return Error{ErrorCode::kUndecodable, name + ": not a single frame"};
    }
    return clip;
}

Result<VideoClip> load_generated(const std::string& name,
                                 std::int32_t side,
                                 std::int64_t frames) {
    video::GeneratorParameters parameters;
    parameters.width = name == "panorama" ? kPanoramaAspect * side : side;
    parameters.height = side;
    parameters.frames = frames;
    auto source = video::make_generator(name, parameters);
    if (!source) return named(name, source.error());
    auto drawn = drawn_frames(**source);
    if (!drawn) return named(name, drawn.error());
    return VideoClip{name, VideoKind::kGenerated, (*source)->format(), *std::move(drawn)};
}

}  // namespace

const char* video_kind_name(VideoKind kind) {
    switch (kind) {
        case VideoKind::kNatural:
            return "natural";
        case VideoKind::kGenerated:
            return "generated";
        case VideoKind::kClipArt:
            break;
    }
    return "clip-art";
}

std::uint64_t VideoClip::raw_bytes() const {
    return sizeof(video::Rgba) * static_cast<std::uint64_t>(format.width) *
           static_cast<std::uint64_t>(format.height) * frames.size();
}

Result<std::vector<VideoClipSource>> folder_clips(const std::string& folder) {
    std::vector<VideoClipSource> clips;
    std::error_code failure;
    for (fs::recursive_directory_iterator it(folder, failure), end; !failure && it != end;
         it.increment(failure)) {
        if (!it->is_regular_file(failure) || !begins_like_a_clip(it->path())) continue;
        const std::string name = it->path().lexically_relative(folder).string();
        clips.push_back({name, [name, path = it->path().string()](std::int64_t frames) {
                             return load_file(name, path, frames);
                         }});
    }
    if (failure) return Error{ErrorCode::kNotFound, folder + ": " + failure.message()};
    std::sort(clips.begin(), clips.end(), [](const auto& a, const auto& b) {
        return a.name < b.name;
    });
    return clips;
}

std::vector<VideoClipSource> generated_clips(std::int32_t side) {
    std::vector<VideoClipSource> clips;
    for (const std::string_view known : video::kGeneratorNames) {
        const std::string name(known);
        clips.push_back({name, [name, side](std::int64_t frames) {
                             return load_generated(name, side, frames);
                         }});
    }
    return clips;
}

Result<std::vector<video::Picture>> drawn_frames(video::FrameSource& source) {
    std::vector<video::Picture> frames;
    video::SourceFrame frame;
    for (;;) {
        const Result<bool> more = source.next(frame);
        if (!more) return more.error();
        if (!*more) return frames;
        const video::Picture drawn = video::tree_picture(frame.tree, source.format());
        frames.insert(frames.end(), static_cast<std::size_t>(frame.repeats), drawn);
    }
}

Result<bool> PictureFrames::next(video::SourceFrame& frame) {
    if (next_ == pictures_.size()) return false;
    video::create_frame(pictures_[next_++].view(), frame.tree);
    frame.repeats = 1;
    return true;
}

}  // namespace haarmony::eval
