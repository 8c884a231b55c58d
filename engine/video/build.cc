#include "engine/video/build.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include "engine/video/frame_spool.h"
#include "engine/video/spooled_nodes.h"
#include "engine/video/time_sums.h"
#include "engine/video/up_links.h"

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

// Pass 2.
class Linker {
  public:
    Linker(const ClipShape& shape,
           const SpooledNodes& nodes,
           FrameSpool& spool,
           ClipSink& sink,
           Progress& progress)
        : shape_(shape),
          nodes_(nodes),
          spool_(spool),
          sink_(sink),
          progress_(progress),
          links_(shape.space_levels(), progress.options.delta) {}

    // The siblings at an address and all below them.
    Result<void> write(const SiblingAddress& address, const TimeNode* parent) {
        const int k = address.time_level;
        const std::int64_t first = k == 0 ? 0 : 2 * address.index;
        links_.descend();
        Siblings siblings;
        siblings.address = address;
        siblings.nodes.count = static_cast<int>(
            std::min(std::int64_t{k == 0 ? 1 : 2}, shape_.nodes_at(k) - first));
        for (int i = 0; i < siblings.nodes.count; ++i) {
            const Result<void> read = spool_.get(node(k, first + i).frame, exact_);
            if (!read) return read;
            Result<TimeNode> linked = links_.link(exact_, parent);
            if (!linked) return std::move(linked).error();
            siblings.nodes.node[static_cast<std::size_t>(i)] = *std::move(linked);
        }
        siblings.layers = links_.layers();
        const SiblingNodes linked = siblings.nodes;
        const Result<void> taken = sink_.add(std::move(siblings));
        if (!taken) return taken;
        progress_.nodes_written += linked.count;
        const Result<void> told = progress_.tell();
        if (!told) return told;
        for (int i = 0; i < linked.count; ++i) {
            if (node(k, first + i).uniform) continue;
            const Result<void> below =
                write({k + 1, first + i}, &linked.node[static_cast<std::size_t>(i)]);
            if (!below) return below;
        }
        links_.ascend();
        return {};
    }

  private:
    [[nodiscard]] const SpooledNode& node(int time_level, std::int64_t index) const {
        return nodes_.at(shape_.time_levels() - time_level, index);
    }

    const ClipShape& shape_;
    const SpooledNodes& nodes_;
    FrameSpool& spool_;
    ClipSink& sink_;
    Progress& progress_;
    UpLinks links_;
    ExactFrame exact_;
};

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
    Result<void> done = sink.begin(*shape, options.delta);
    if (!done) return done.error();
    done = Linker(*shape, *nodes, frames, sink, progress).write({0, 0}, nullptr);
    if (!done) return done.error();
    done = sink.finish();
    if (!done) return done.error();
    return *shape;
}

}  // namespace haarmony::video
