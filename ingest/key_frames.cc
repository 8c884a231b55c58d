#include "ingest/key_frames.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace haarmony::ingest {
namespace {

constexpr double kMicrosecondsASecond = 1e6;

void keep_every_second(std::vector<KeyFrame>& frames) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < frames.size(); i += 2)
        std::swap(frames[kept++], frames[i]);
    frames.resize(kept);
}

}  // namespace

Result<std::vector<KeyFrame>> describe_key_frames(
    PictureSource& pictures,
    std::size_t most,
    const std::function<Result<schema::NewImage>(const ImageView&)>& describe,
    const std::function<bool()>& keep_going) {
    assert(most >= 1);
    std::vector<KeyFrame> frames;
    TimedPicture shown;
    std::size_t stride = 1;
    std::int64_t last_ms = -1;
    for (std::size_t number = 0;;) {
        if (!keep_going()) return Error{ErrorCode::kUnavailable, "was stopped"};
        const Result<bool> more = pictures.next(shown);
        if (!more) return more.error();
        if (!*more) return frames;
        const std::int64_t time_us = std::max<std::int64_t>(shown.time_us, 0);
        const std::int64_t ms = (time_us + 500) / 1'000;
        if (ms == last_ms) continue;
        last_ms = ms;
        const std::size_t place = number++;
        if (place % stride != 0) continue;
        if (frames.size() == most) {
            keep_every_second(frames);
            stride *= 2;
            if (place % stride != 0) continue;
        }
        Result<schema::NewImage> image = describe(shown.picture.view());
        if (!image) return image.error();
        const double frames_a_second = pictures.format().rate.per_second();
        const auto frame = std::llround(static_cast<double>(time_us) * frames_a_second /
                                        kMicrosecondsASecond);
        frames.push_back({time_us, frame, *std::move(image)});
    }
}

}  // namespace haarmony::ingest
