#include <fcntl.h>

#include <memory>
#include <utility>

#include "ingest/decode.h"
#include "ingest/describe.h"
#include "ingest/pipeline.h"
#include "ingest/video_source.h"

namespace haarmony::ingest {
namespace {

FilmSteps film_steps(const std::vector<image::SignatureKind>& kinds, std::size_t most) {
    FilmSteps steps;
    steps.describe = [kinds, most](
                         int file,
                         const KeepGoing& keep_going) -> Result<std::vector<KeyFrame>> {
        VideoSourceOptions options;
        options.frames = VideoFrames::kKey;
        const auto film =
            open_video(FileDescriptor(::fcntl(file, F_DUPFD_CLOEXEC, 0)), options);
        if (!film) return film.error();
        return describe_key_frames(
            **film,
            most,
            [&kinds](const ImageView& picture) {
                return describe_pixels(picture, kinds);
            },
            keep_going);
    };
    steps.content_hash = [](int file, const KeepGoing& keep_going) {
        return content_hash(file, keep_going);
    };
    return steps;
}

}  // namespace

MakePictureSteps picture_steps(std::vector<image::SignatureKind> kinds,
                               std::size_t most_key_frames) {
    return [kinds = std::move(kinds), most_key_frames]() -> PictureSteps {
        const auto decoder = std::make_shared<Decoder>(DecodeLimits{});
        return {[decoder, kinds](std::span<const std::uint8_t> bytes) {
                    return describe(*decoder, bytes, kinds);
                },
                [](std::span<const std::uint8_t> bytes) { return content_hash(bytes); },
                film_steps(kinds, most_key_frames)};
    };
}

}  // namespace haarmony::ingest
