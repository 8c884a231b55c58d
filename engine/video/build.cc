#include "engine/video/build.h"

#include "engine/video/frame_spool.h"
#include "engine/video/link_clip.h"
#include "engine/video/spooled_nodes.h"
#include "engine/video/time_sums.h"

namespace haarmony::video {

Result<ClipShape> build(FrameSource& source,
                        Spool& spool,
                        ClipSink& sink,
                        const BuildOptions& options) {
    // Not even one frame is read into sums of a size that no clip has.
    const Result<ClipShape> possible = ClipShape::make(source.format(), 1);
    if (!possible) return possible.error();
    FrameSpool frames(spool);
    TimeSums sums(source.format(), frames);
    BuildProgress progress{options.progress, 0, 0};
    const Result<void> read = read_source(source, options.max_frames, sums, progress);
    if (!read) return read.error();
    const Result<SpooledNodes> nodes = sums.finish();
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
