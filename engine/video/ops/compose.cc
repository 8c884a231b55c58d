#include "engine/video/ops/compose.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "engine/video/ops/leaf_tree.h"
#include "engine/video/ops/place.h"
#include "engine/video/tree_writer.h"

namespace haarmony::video {
namespace {

Error refused(const char* param, const std::string& message) {
    return {ErrorCode::kInvalidArgument, message, param};
}

Result<void> check_count(std::span<const CompositionLayer> layers) {
    if (!layers.empty() && layers.size() <= kMaxLayers) return {};
    return refused("layers",
                   "layers are " + std::to_string(layers.size()) + "; want 1 to " +
                       std::to_string(kMaxLayers));
}

Result<CanvasBox> box_of(std::span<const CompositionLayer> layers, std::size_t i) {
    assert(layers[i].clip != nullptr);
    Result<CanvasBox> box = placed_box(layers[i].clip->shape(), layers[i].placement);
    if (box) return box;
    return refused(box.error().param.c_str(),
                   "layer " + std::to_string(i) + ": " + box.error().message);
}

Result<void> check_time(const CompositionLayer& layer, std::size_t i) {
    constexpr std::int64_t most = std::int64_t{1} << kMaxTimeLevels;
    const auto within = [](std::int64_t value) { return value >= 0 && value <= most; };
    if (within(layer.start) && within(layer.frames)) return {};
    const bool start = !within(layer.start);
    return refused(start ? "start" : "frames",
                   "layer " + std::to_string(i) + ": " + (start ? "start" : "frames") +
                       " is " + std::to_string(start ? layer.start : layer.frames) +
                       "; want 0 to " + std::to_string(most));
}

}  // namespace

Result<ClipShape> composed_shape(std::span<const CompositionLayer> layers,
                                 const FrameFormat& canvas) {
    if (Result<void> count = check_count(layers); !count) return count.error();
    std::int64_t frames = 0;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (Result<CanvasBox> box = box_of(layers, i); !box) return box.error();
        if (Result<void> time = check_time(layers[i], i); !time) return time.error();
        frames = std::max(frames, layers[i].end());
    }
    return ClipShape::make(canvas, frames);
}

Result<CanvasBox> composed_box(std::span<const CompositionLayer> layers) {
    if (Result<void> count = check_count(layers); !count) return count.error();
    std::int64_t left = 0, top = 0, right = 0, bottom = 0;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const Result<CanvasBox> box = box_of(layers, i);
        if (!box) return box.error();
        const bool first = i == 0;
        left = first ? (*box).left : std::min(left, (*box).left);
        top = first ? (*box).top : std::min(top, (*box).top);
        right = first ? (*box).left + (*box).width
                      : std::max(right, (*box).left + (*box).width);
        bottom = first ? (*box).top + (*box).height
                       : std::max(bottom, (*box).top + (*box).height);
    }
    return CanvasBox{left, top, right - left, bottom - top};
}

Placement moved_by(const Placement& placement,
                   const ClipShape& clip,
                   std::int64_t dx,
                   std::int64_t dy) {
    const int finest = clip.space_levels();
    const std::int64_t unit = std::int64_t{1}
                              << (finest - placement.at_level.value_or(finest));
    return {placement.scale, placement.dx * unit + dx, placement.dy * unit + dy, finest};
}

Result<std::unique_ptr<Composition>> Composition::make(
    std::vector<CompositionLayer> layers,
    const FrameFormat& canvas) {
    const Result<ClipShape> shape = composed_shape(layers, canvas);
    if (!shape) return shape.error();
    return std::unique_ptr<Composition>(new Composition(std::move(layers), *shape));
}

Composition::Composition(std::vector<CompositionLayer> layers, const ClipShape& shape)
    : layers_(std::move(layers)), shape_(shape), shown_(layers_.size()) {
    TreeWriter(clear_).finish({});
}

Result<bool> Composition::show(std::size_t i, std::int64_t& until) {
    const CompositionLayer& layer = layers_[i];
    Shown& shown = shown_[i];
    if (next_ < layer.start || next_ >= layer.end()) {
        if (next_ < layer.start) until = std::min(until, layer.start);
        if (shown.valid && shown.outside) return false;
        shown.valid = shown.outside = true;
        shown.placed = clear_;
        return true;
    }
    const ClipShape& shape = layer.clip->shape();
    const int level = shape.space_levels() - layer.placement.scale.shrink;
    const std::int64_t index = std::min(next_ - layer.start, shape.frames() - 1);
    const Result<Frame> frame = layer.clip->frame({shape.time_levels(), index}, level);
    if (!frame) return frame.error();
    const NodeAddress& stored = (*frame).stored();
    const std::int64_t stays = shape.frames_of(stored).end;
    until =
        std::min(until,
                 stays == shape.frames() ? layer.end()
                                         : std::min(layer.end(), layer.start + stays));
    if (shown.valid && !shown.outside && shown.stored == stored) return false;
    shown.valid = true;
    shown.outside = false;
    shown.stored = stored;
    visited_ += leaf_tree(*frame, leaf_);
    const CanvasBox box = placed_box(shape, layer.placement).value();
    visited_ +=
        place(leaf_,
              level,
              {layer.placement.scale.x, layer.placement.scale.y, box.left, box.top, 0},
              shape_.format(),
              shown.placed);
    return true;
}

Result<bool> Composition::next(SourceFrame& frame) {
    if (next_ == shape_.frames()) return false;
    std::int64_t until = shape_.frames();
    bool changed = false;
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        const Result<bool> moved = show(i, until);
        if (!moved) return moved.error();
        changed = changed || *moved;
        if (!changed) continue;
        visited_ += composite(shown_[i].placed,
                              i == 0 ? clear_ : shown_[i - 1].canvas,
                              layers_[i].op,
                              shown_[i].canvas);
    }
    frame.tree = shown_.back().canvas;
    frame.repeats = until - next_;
    next_ = until;
    return true;
}

}  // namespace haarmony::video
