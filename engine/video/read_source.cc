#include "engine/video/read_source.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include "engine/video/clip_shape.h"
#include "engine/video/image_tree.h"

namespace haarmony::video {
namespace {

// Not all that look the same: those that do, byte for byte, which costs no more than reading.
bool same_bytes(const ImageTree& a, const ImageTree& b) {
    static_assert(std::has_unique_object_representations_v<Brick>);
    return a.root == b.root && a.bricks.size() == b.bricks.size() && a.nodes == b.nodes &&
           (a.bricks.empty() ||
            std::memcmp(
                a.bricks.data(), b.bricks.data(), a.bricks.size() * sizeof(Brick)) == 0);
}

}  // namespace

Result<void> BuildProgress::tell() const {
    if (!told || told(frames_read, nodes_written)) return {};
    return Error{ErrorCode::kUnavailable,
                 "stopped after " + std::to_string(frames_read) + " frames read and " +
                     std::to_string(nodes_written) + " time nodes written"};
}

Result<void> read_source(FrameSource& source,
                         std::int64_t most,
                         TimeSums& sums,
                         BuildProgress& progress) {
    const std::int64_t end = most == 0 ? 0 : progress.frames_read + most;
    SourceFrame frame;
    ImageTree run;
    std::int64_t run_length = 0;
    while (most == 0 || progress.frames_read < end) {
        const Result<bool> more = source.next(frame);
        if (!more) return more.error();
        if (!*more) break;
        assert(frame.repeats >= 1);
        const std::int64_t repeats =
            most == 0 ? frame.repeats
                      : std::min(frame.repeats, end - progress.frames_read);
        progress.frames_read += repeats;
        const Result<ClipShape> possible =
            ClipShape::make(source.format(), progress.frames_read);
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
    return sums.add(run, run_length);
}

}  // namespace haarmony::video
