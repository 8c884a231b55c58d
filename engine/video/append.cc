#include "engine/video/append.h"

#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "engine/video/exact_mean.h"
#include "engine/video/frame_spool.h"
#include "engine/video/link_clip.h"
#include "engine/video/ops/clip_frames.h"
#include "engine/video/spooled_nodes.h"
#include "engine/video/time_sums.h"

namespace haarmony::video {
namespace {

std::string text(const FrameRate& rate) {
    return std::to_string(rate.numerator) + "/" + std::to_string(rate.denominator);
}

Error differs(const char* name, const std::string& theirs, const std::string& ours) {
    return {ErrorCode::kInvalidArgument,
            std::string(name) + " of the frames is " + theirs + ", of the clip " + ours,
            name};
}

// The clip's frames, as the blocks of a power of two that they are in the time tree.
Result<void> add_clip(const TimeTree& clip, TimeSums& sums, BuildProgress& progress) {
    const ClipShape& shape = clip.shape();
    for (int height = shape.time_levels(); height >= 0; --height) {
        const std::int64_t block = std::int64_t{1} << height;
        if ((shape.frames() & block) == 0) continue;
        const std::int64_t first = sums.frames();
        const auto frames = range_frames(clip, {first, first + block});
        if (!frames) return frames.error();
        FrameSum sum(shape.format());
        SourceFrame frame;
        for (;;) {
            const Result<bool> more = (*frames)->next(frame);
            if (!more) return more.error();
            if (!*more) break;
            sum.add(frame.tree, frame.repeats);
            progress.frames_read += frame.repeats;
            if (Result<void> told = progress.tell(); !told) return told;
        }
        const NodeAddress at{shape.time_levels() - height, first >> height};
        const bool uniform = !clip.finer_in_time(at);
        if (Result<void> added = sums.add_whole(height, std::move(sum), uniform); !added)
            return added;
    }
    return {};
}

}  // namespace

Result<void> can_follow(const FrameFormat& more, const FrameFormat& clip) {
    if (more.width != clip.width)
        return differs("width", std::to_string(more.width), std::to_string(clip.width));
    if (more.height != clip.height)
        return differs(
            "height", std::to_string(more.height), std::to_string(clip.height));
    if (std::int64_t{more.rate.numerator} * clip.rate.denominator !=
        std::int64_t{clip.rate.numerator} * more.rate.denominator) {
        return differs("rate", text(more.rate), text(clip.rate));
    }
    return {};
}

Result<ClipShape> append(const TimeTree& clip,
                         FrameSource& more,
                         Spool& spool,
                         ClipSink& sink,
                         const AppendOptions& options) {
    const ClipShape& old = clip.shape();
    if (clip.delta() != 0) {
        std::ostringstream delta;
        delta << double(clip.delta()) / kDifferenceOne;
        return Error{ErrorCode::kConflict,
                     "the clip's delta is " + delta.str() +
                         ", so that its frames are not those of its source; only to a "
                         "clip of delta 0 can frames be appended"};
    }
    if (const Result<void> same = can_follow(more.format(), old.format()); !same)
        return same.error();
    FrameSpool frames(spool);
    TimeSums sums(old.format(), frames);
    BuildProgress progress{options.progress, 0, 0};
    if (const Result<void> added = add_clip(clip, sums, progress); !added)
        return added.error();
    if (const Result<void> read = read_source(more, options.max_frames, sums, progress);
        !read) {
        return read.error();
    }
    const Result<ClipShape> shape = ClipShape::make(old.format(), sums.frames());
    if (!shape) return shape.error();
    const Result<SpooledNodes> nodes = sums.finish();
    if (!nodes) return nodes.error();
    LinkOptions linking;
    linking.kept_frames = old.frames();
    linking.written = [&progress](std::int64_t written) {
        progress.nodes_written = written;
        return progress.tell();
    };
    const Result<void> linked = link_clip(*shape, *nodes, frames, sink, linking);
    if (!linked) return linked.error();
    return *shape;
}

}  // namespace haarmony::video
