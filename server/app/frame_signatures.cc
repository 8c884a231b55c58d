#include "server/app/frame_signatures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "engine/image/signature.h"
#include "engine/image/signature_codec.h"
#include "engine/video/display.h"

namespace haarmony::server {
namespace {

// Of luminance times alpha; 0..255 * 255.
int luminance(video::Rgba pixel) {
    return (299 * pixel.r + 587 * pixel.g + 114 * pixel.b) * pixel.a / 1'000;
}

Result<video::Picture> picture_of(const video::TimeTree& clip,
                                  const video::NodeAddress& at) {
    const int level = std::min(kSignatureLevel, clip.shape().space_levels());
    const auto frame = clip.frame(at, level);
    if (!frame) return frame.error();
    return video::draw(*frame, level, video::Edge::kNormalize);
}

}  // namespace

double mean_difference(const video::Picture& a, const video::Picture& b) {
    assert(a.width == b.width && a.height == b.height && !a.pixels.empty());
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        sum += std::abs(luminance(a.pixels[i]) - luminance(b.pixels[i]));
    return static_cast<double>(sum) / 255 / static_cast<double>(a.pixels.size());
}

std::vector<std::int64_t> shots_of(const std::vector<double>& differences) {
    std::vector<std::int64_t> shots{0};
    int remembered = 0;  // differences of this shot that count, the last ones
    double sum = 0;      // of these
    for (std::size_t i = 0; i < differences.size(); ++i) {
        const double mean = remembered == 0 ? 0 : sum / remembered;
        const bool cut =
            differences[i] > kShotDifference && differences[i] > kShotFactor * mean;
        shots.push_back(shots.back() + (cut ? 1 : 0));
        if (cut) {
            remembered = 0;
            sum = 0;
            continue;
        }
        sum += differences[i];
        if (++remembered > kShotMemory)
            sum -= differences[i - static_cast<std::size_t>(--remembered)];
    }
    return shots;
}

Result<std::vector<std::int64_t>> find_shots(const video::TimeTree& clip,
                                             const std::function<bool()>& go_on) {
    const int leaves = clip.shape().time_levels();
    std::vector<double> differences;
    video::Picture before;
    for (std::int64_t frame = 0; frame < clip.shape().frames(); ++frame) {
        if (!go_on()) return Error{ErrorCode::kUnavailable, "the search was stopped"};
        auto picture = picture_of(clip, {leaves, frame});
        if (!picture) return picture.error();
        if (frame > 0) differences.push_back(mean_difference(before, *picture));
        before = *std::move(picture);
    }
    return shots_of(differences);
}

Result<std::vector<schema::FrameSignature>> frame_signatures(
    const video::TimeTree& clip,
    std::int64_t kept_frames,
    const std::function<bool()>& go_on) {
    const auto shots = find_shots(clip, go_on);
    if (!shots) return shots.error();
    std::vector<schema::FrameSignature> signatures;
    const video::ClipShape& shape = clip.shape();
    for (int level = 0; level <= shape.time_levels(); ++level) {
        for (std::int64_t node = 0; node < shape.nodes_at(level); ++node) {
            const video::NodeAddress at{level, node};
            const video::SiblingAddress siblings = video::siblings_of(at);
            if (level > 0 && (siblings.index + 1) << (shape.time_levels() - level + 1) <=
                                 kept_frames) {
                continue;
            }
            if (!clip.stored(siblings)) continue;
            const video::FrameRange frames = shape.frames_of(at);
            const std::int64_t shot = (*shots)[static_cast<std::size_t>(frames.first)];
            if ((*shots)[static_cast<std::size_t>(frames.end - 1)] != shot) continue;
            if (!go_on()) return Error{ErrorCode::kUnavailable, "the search was stopped"};
            const auto picture = picture_of(clip, at);
            if (!picture) return picture.error();
            const image::Signature signature = image::make_signature(picture->view());
            schema::FrameSignature row;
            row.time_level = level;
            row.node = node;
            row.shot = shot;
            row.signature = image::encode_signature(signature);
            signatures.push_back(std::move(row));
        }
    }
    return signatures;
}

}  // namespace haarmony::server
