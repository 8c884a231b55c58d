#include "engine/video/build.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include "engine/video/frame_spool.h"
#include "engine/video/link_clip.h"
#include "engine/video/spooled_nodes.h"
#include "engine/video/time_sums.h"

namespace haarmony::video {
namespace {

// How far a build has come, told to whom it concerns.
struct Progress {
    const BuildOptions& options;
    std::int64_t frames_read = 0;
    std::int64_t nodes_written = 0;

    Result<void> tell() const {
        if (!options.progress || options.progress(frames_read, nodes_written)) return {};
        return Error{ErrorCode::kUnavailable,
                     "stopped after " + std::to_string(frames_read) +
                         " frames read and " + std::to_string(nodes_written) +
                         " time nodes written"};
    }
};

// Not all that look the same: those that do, byte for byte, which costs no more than reading.
bool same_bytes(const ImageTree& a, const ImageTree& b) {
    static_assert(std::has_unique_object_representations_v<Brick>);
    return a.root == b.root && a.bricks.size() == b.bricks.size() && a.nodes == b.nodes &&
           (a.bricks.empty() ||
            std::memcmp(
                a.bricks.data(), b.bricks.data(), a.bricks.size() * sizeof(Brick)) == 0);
}

// Pass 1.
Result<SpooledNodes> read_frames(FrameSource& source,
                                 FrameSpool& spool,
                                 Progress& progress) {
    const FrameFormat format = source.format();
    TimeSums sums(format, spool);
    const std::int64_t most = progress.options.max_frames;
    // Frames like the one before are added with it, when another one comes.
    SourceFrame frame;
    ImageTree run;
    std::int64_t run_length = 0;
    while (most == 0 || progress.frames_read < most) {
        const Result<bool> more = source.next(frame);
        if (!more) return more.error();
        if (!*more) break;
        assert(frame.repeats >= 1);
        const std::int64_t repeats =
            most == 0 ? frame.repeats
                      : std::min(frame.repeats, most - progress.frames_read);
        progress.frames_read += repeats;
        const Result<ClipShape> possible = ClipShape::make(format, progress.frames_read);
        if (!possible) return possible.error();
        if (run_length > 0 && !same_bytes(frame.tree, run)) {
            const Result<void> added = sums.add(run, run_length);
            if (!added) return added.error();
            run_length = 0;
        }
        if (run_length == 0) std::swap(run, frame.tree);
        run_length += repeats;
        const Result<void> told = progress.tell();
        if (!told) return told.error();
    }
    if (run_length == 0) {
        return Error{ErrorCode::kInvalidArgument, "the source has 0 frames", "frames"};
    }
    const Result<void> added = sums.add(run, run_length);
    if (!added) return added.error();
    return sums.finish();
}

}  // namespace

Result<ClipShape> build(FrameSource& source,
                        Spool& spool,
                        ClipSink& sink,
                        const BuildOptions& options) {
    // Not even one frame is read into sums of a size that no clip has.
    const Result<ClipShape> possible = ClipShape::make(source.format(), 1);
    if (!possible) return possible.error();
    FrameSpool frames(spool);
    Progress progress{options, 0, 0};
    const Result<SpooledNodes> nodes = read_frames(source, frames, progress);
    if (!nodes) return nodes.error();
    const Result<ClipShape> shape =
        ClipShape::make(source.format(), progress.frames_read);
    if (!shape) return shape.error();
    LinkOptions linking;
    linking.delta = options.delta;
    linking.written = [&progress](std::int64_t written) {
        progress.nodes_written = written;
        return progress.tell();
    };
    const Result<void> linked = link_clip(*shape, *nodes, frames, sink, linking);
    if (!linked) return linked.error();
    return *shape;
}

}  // namespace haarmony::video
