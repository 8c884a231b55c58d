// A clip held in memory as a whole: what a build makes when it is not written to a file.
//
// Errors   none of its own.
// Threads  const-thread-safe once finished.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "engine/video/layer.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

class MemoryClip final : public TimeTree {
  public:
    // Takes a clip from build(); clip() is there after finish().
    class Sink final : public ClipSink {
      public:
        [[nodiscard]] Result<void> begin(const ClipShape& shape,
                                         std::uint32_t delta) override;
        [[nodiscard]] Result<void> add(Siblings siblings) override;
        [[nodiscard]] Result<void> finish() override;
        // Requires: finish() was called. Leaves nothing behind.
        [[nodiscard]] std::unique_ptr<MemoryClip> take() { return std::move(clip_); }

      private:
        std::unique_ptr<MemoryClip> clip_;
    };

    [[nodiscard]] bool stored(const SiblingAddress& address) const override;
    [[nodiscard]] Result<Frame::Nodes> nodes(
        const SiblingAddress& address) const override;
    [[nodiscard]] Result<Frame::LayerPtr> layer(const SiblingAddress& address,
                                                int space_level) const override;
    // Nodes, bricks and time nodes.
    [[nodiscard]] std::uint64_t memory_bytes() const;

  private:
    struct Held {
        Frame::Nodes nodes;
        std::vector<Frame::LayerPtr> layers;
    };
    MemoryClip(const ClipShape& shape, std::uint32_t delta) : TimeTree(shape, delta) {}
    [[nodiscard]] const Held& held(const SiblingAddress& address) const;

    std::map<std::pair<int, std::int64_t>, Held> siblings_;
};

}  // namespace haarmony::video
