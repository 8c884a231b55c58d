// Clips of any length, size and depth on top of each other, frame by frame.
//   placement.h, place.h, composite.h -> [compose.h] -> build.h
//
// Single frames are placed and composited, the lowest layer first onto a clear canvas, with
// a = the layer and b = what lies below. Outside its frames a layer is clear. Frames are
// lined up one to one, whatever the clips' rates.
//
// Errors   param layers (none, or too many); op, scale, translate, at_level, start or frames
//          of the layer whose number is in the message; width, height, rate or frames of
//          the result. next(): what the clips' storage meets.
// Threads  one caller.
// Cost     linear in the squares of what changes: layers that stay, and all that lies below
//          them, are placed and composited once.
// Source   sec. 5.3.3, CompositeTimeTrees(), sec. 5.4.4; ERRATA of the project, video 22-25.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/ops/composite.h"
#include "engine/video/ops/placement.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

inline constexpr std::size_t kMaxLayers = 256;

struct CompositionLayer {
    const TimeTree* clip = nullptr;  // must outlive the composition
    Placement placement = {};
    std::int64_t start = 0;  // the composition's frame that shows the layer's first
    std::int64_t frames =
        0;  // how many are shown, 0 = the clip's; its last frame stays for
            // those beyond its end
    Operator op = Operator::kAOverB;

    [[nodiscard]] std::int64_t end() const {
        return start + (frames == 0 ? clip->shape().frames() : frames);
    }
};

// The shape of the result: the canvas, and as many frames as the layer that ends last.
// Refuses what no composition can be made of.
[[nodiscard]] Result<ClipShape> composed_shape(std::span<const CompositionLayer> layers,
                                               const FrameFormat& canvas);

// The smallest box that holds all layers: a canvas that has grown to what is on it. Give
// its size as the canvas and take its left and top from every layer (moved_by).
[[nodiscard]] Result<CanvasBox> composed_box(std::span<const CompositionLayer> layers);

// The placement moved by pixels of the canvas.
[[nodiscard]] Placement moved_by(const Placement& placement,
                                 const ClipShape& clip,
                                 std::int64_t dx,
                                 std::int64_t dy);

class Composition final : public FrameSource {
  public:
    [[nodiscard]] static Result<std::unique_ptr<Composition>> make(
        std::vector<CompositionLayer> layers,
        const FrameFormat& canvas);

    [[nodiscard]] const FrameFormat& format() const override { return shape_.format(); }
    [[nodiscard]] const ClipShape& shape() const { return shape_; }
    [[nodiscard]] Result<bool> next(SourceFrame& frame) override;
    // So far.
    [[nodiscard]] const Visited& visited() const { return visited_; }

  private:
    // What a layer shows now, and everything up to it.
    struct Shown {
        bool valid = false;
        bool outside = false;  // before its start or after its end
        NodeAddress stored;
        ImageTree placed;
        ImageTree canvas;
    };
    Composition(std::vector<CompositionLayer> layers, const ClipShape& shape);
    // Whether it has changed. `until` becomes the frame where it changes next, if
    // earlier.
    [[nodiscard]] Result<bool> show(std::size_t layer, std::int64_t& until);

    std::vector<CompositionLayer> layers_;
    ClipShape shape_;
    std::vector<Shown> shown_;
    ImageTree clear_;
    ImageTree leaf_;
    std::int64_t next_ = 0;
    Visited visited_;
};

}  // namespace haarmony::video
