#include "engine/video/link_clip.h"

#include <algorithm>
#include <utility>

#include "engine/video/image_tree.h"
#include "engine/video/up_links.h"

namespace haarmony::video {
namespace {

class Linker {
  public:
    Linker(const ClipShape& shape,
           const SpooledNodes& nodes,
           FrameSpool& spool,
           ClipSink& sink,
           const LinkOptions& options)
        : shape_(shape),
          nodes_(nodes),
          spool_(spool),
          sink_(sink),
          options_(options),
          links_(shape.space_levels(), options.delta, options.max_index) {}

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
        written_ += linked.count;
        if (options_.written) {
            const Result<void> told = options_.written(written_);
            if (!told) return told;
        }
        for (int i = 0; i < linked.count; ++i) {
            if (node(k, first + i).uniform || kept(k, first + i)) continue;
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

    // Complete and a clip's already, with all below it.
    [[nodiscard]] bool kept(int time_level, std::int64_t index) const {
        return (index + 1) << (shape_.time_levels() - time_level) <= options_.kept_frames;
    }

    const ClipShape& shape_;
    const SpooledNodes& nodes_;
    FrameSpool& spool_;
    ClipSink& sink_;
    const LinkOptions& options_;
    UpLinks links_;
    ExactFrame exact_;
    std::int64_t written_ = 0;
};

}  // namespace

Result<void> link_clip(const ClipShape& shape,
                       const SpooledNodes& nodes,
                       FrameSpool& spool,
                       ClipSink& sink,
                       const LinkOptions& options) {
    Result<void> done = sink.begin(shape, options.delta);
    if (!done) return done;
    done = Linker(shape, nodes, spool, sink, options).write({0, 0}, nullptr);
    if (!done) return done;
    return sink.finish();
}

}  // namespace haarmony::video
