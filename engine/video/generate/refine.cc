#include "engine/video/generate/refine.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "engine/video/tree_writer.h"

namespace haarmony::video {
namespace {

class Refinement {
  public:
    Refinement(const Field& field, const FrameFormat& format, int depth, ImageTree& tree)
        : field_(field), width_(format.width), height_(format.height), writer_(tree) {
        const int levels = ClipShape::make(format, 1).value().space_levels();
        assert(levels >= kBrickLevel && depth >= kBrickLevel && depth <= levels);
        smallest_ = std::int32_t{1} << (levels - depth);
        root_cell_ = std::int32_t{1} << (levels - kBrickLevel);
    }

    void run() { writer_.finish(paint({0, 0, root_cell_})); }

  private:
    TreePart paint(const FieldSquare& square) {
        if (square.left >= width_ || square.top >= height_) return {};
        Brick brick;
        const bool finer = field_.sample(square, brick);
        const std::int32_t side = kBrickSide * square.cell;
        const bool crossed = (square.left + side > width_ && width_ % square.cell != 0) ||
                             (square.top + side > height_ && height_ % square.cell != 0);
        if (crossed || (finer && square.cell > smallest_)) {
            std::array<TreePart, 4> quadrants;
            for (std::int32_t q = 0; q < 4; ++q) {
                quadrants[static_cast<std::size_t>(q)] =
                    paint({square.left + (q & 1) * side / 2,
                           square.top + (q >> 1) * side / 2,
                           square.cell / 2});
            }
            return writer_.join(quadrants);
        }
        for (int i = 0; i < kBrickPixels; ++i) {
            if (square.x(i) > width_ || square.y(i) > height_) {
                brick[static_cast<std::size_t>(i)] = kClear;
            }
        }
        return writer_.add(brick);
    }

    const Field& field_;
    std::int32_t width_;
    std::int32_t height_;
    std::int32_t smallest_ = 1;   // pixel of the finest level that is painted
    std::int32_t root_cell_ = 1;  // pixel of level 3
    TreeWriter writer_;
};

class RefinedFrames final : public FrameSource {
  public:
    RefinedFrames(const FrameFormat& format,
                  std::int64_t frames,
                  int depth,
                  MovingField field)
        : format_(format), frames_(frames), depth_(depth), field_(std::move(field)) {}

    const FrameFormat& format() const override { return format_; }

    Result<bool> next(SourceFrame& frame) override {
        if (next_ == frames_) return false;
        const std::unique_ptr<Field> field = field_(next_);
        refine(*field, format_, depth_, frame.tree);
        frame.repeats = std::min(field->stays(), frames_ - next_);
        next_ += frame.repeats;
        return true;
    }

  private:
    FrameFormat format_;
    std::int64_t frames_;
    int depth_;
    MovingField field_;
    std::int64_t next_ = 0;
};

}  // namespace

void refine(const Field& field, const FrameFormat& format, int depth, ImageTree& tree) {
    Refinement(field, format, depth, tree).run();
}

std::unique_ptr<FrameSource> refined_frames(const FrameFormat& format,
                                            std::int64_t frames,
                                            int depth,
                                            MovingField field) {
    return std::make_unique<RefinedFrames>(format, frames, depth, std::move(field));
}

}  // namespace haarmony::video
