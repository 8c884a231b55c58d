#include "tests/eval/video_sizes.h"

#include <cassert>
#include <utility>

#include "engine/video/accounting.h"
#include "engine/video/build.h"
#include "engine/video/mrv_writer.h"
#include "tests/eval/video_encoder.h"

namespace haarmony::eval {
namespace {

constexpr double kNaturalMemory = 2.2;
constexpr double kNaturalFile = 3;
constexpr double kClipArtMemory = 0.15;
constexpr double kClipArtFile = 0.15;

Error named(const VideoClip& clip, const Error& error) {
    return {error.code, clip.name + ": " + error.message, error.param};
}

Result<std::uint64_t> encoded_bytes(const VideoClip& clip, VideoEncoding encoding) {
    const auto film = encode_film(clip.frames, encoding);
    if (!film) return named(clip, film.error());
    return film->bytes();
}

}  // namespace

std::optional<double> memory_target(VideoKind kind) {
    if (kind == VideoKind::kGenerated) return std::nullopt;
    return kind == VideoKind::kNatural ? kNaturalMemory : kClipArtMemory;
}

std::optional<double> file_target(VideoKind kind) {
    if (kind == VideoKind::kGenerated) return std::nullopt;
    return kind == VideoKind::kNatural ? kNaturalFile : kClipArtFile;
}

Result<std::unique_ptr<video::MemoryClip>> built_in_memory(const VideoClip& clip,
                                                           std::uint32_t delta) {
    PictureFrames source(clip.format, clip.frames);
    video::MemorySpool spool;
    video::MemoryClip::Sink sink;
    video::BuildOptions options;
    options.delta = delta;
    const auto shape = video::build(source, spool, sink, options);
    if (!shape) return named(clip, shape.error());
    return sink.take();
}

Result<std::unique_ptr<video::MemorySpool>> built_as_file(const VideoClip& clip,
                                                          std::uint64_t& file_bytes) {
    PictureFrames source(clip.format, clip.frames);
    video::MemorySpool spool;
    video::MemorySpool waiting;
    auto file = std::make_unique<video::MemorySpool>();
    video::MrvWriter writer(waiting, *file);
    const auto shape = video::build(source, spool, writer, {});
    if (!shape) return named(clip, shape.error());
    file_bytes = writer.file_bytes();
    return file;
}

Result<VideoSizes> measure_video_sizes(const VideoClip& clip) {
    assert(!clip.frames.empty());
    VideoSizes sizes;
    sizes.name = clip.name;
    sizes.kind = clip.kind;
    sizes.width = clip.format.width;
    sizes.height = clip.format.height;
    sizes.frames = static_cast<std::int64_t>(clip.frames.size());
    sizes.raw = clip.raw_bytes();
    const auto built = built_in_memory(clip, 0);
    if (!built) return built.error();
    sizes.memory = (*built)->memory_bytes();
    const auto counts = video::count_storage(**built);
    if (!counts) return named(clip, counts.error());
    sizes.paper = counts->paper_bytes;
    const auto file = built_as_file(clip, sizes.file);
    if (!file) return file.error();
    for (const auto& [encoding, bytes] :
         {std::pair{VideoEncoding::kFfv1, &sizes.ffv1},
          std::pair{VideoEncoding::kLossless, &sizes.x264_lossless},
          std::pair{VideoEncoding::kIntra, &sizes.x264_intra}}) {
        const auto encoded = encoded_bytes(clip, encoding);
        if (!encoded) return encoded.error();
        *bytes = *encoded;
    }
    return sizes;
}

}  // namespace haarmony::eval
