#include "engine/video/generate/clip_art.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/video/build.h"
#include "engine/video/ops/compose.h"

namespace haarmony::video {
namespace {

class OwningComposition final : public FrameSource {
  public:
    OwningComposition(std::vector<std::unique_ptr<MemoryClip>> clips,
                      std::unique_ptr<Composition> composition)
        : clips_(std::move(clips)), composition_(std::move(composition)) {}

    const FrameFormat& format() const override { return composition_->format(); }
    Result<bool> next(SourceFrame& frame) override { return composition_->next(frame); }

  private:
    std::vector<std::unique_ptr<MemoryClip>> clips_;
    std::unique_ptr<Composition> composition_;
};

}  // namespace

ClipArt::ClipArt(const Recipe& recipe)
    : recipe_(recipe),
      finest_(
          std::int32_t{1} << (ClipShape::make(recipe.format, 1).value().space_levels() -
                              recipe.depth)) {}

Recipe ClipArt::piece(double width, double height, int cell) const {
    const auto pixels = [this, cell](double part) {
        return std::max(kBrickSide,
                        static_cast<std::int32_t>(std::ceil(part / unit(cell))));
    };
    const FrameFormat format{pixels(width), pixels(height), recipe_.format.rate};
    const int levels = ClipShape::make(format, 1).value().space_levels();
    return {format, recipe_.frames, levels, recipe_.seed};
}

double ClipArt::unit(int cell) const {
    return static_cast<double>(finest_) * cell / recipe_.format.height;
}

Result<void> ClipArt::add(FrameSource& source, double left, double top, int cell) {
    MemorySpool spool;
    MemoryClip::Sink sink;
    if (const Result<ClipShape> built = build(source, spool, sink); !built) {
        return built.error();
    }
    // At whole pixels of its own size, so that no finer detail arises.
    const std::int32_t scale = finest_ * cell;
    const auto at = [&](double part) {
        return static_cast<std::int64_t>(std::floor(part / unit(cell))) * scale;
    };
    pieces_.push_back({sink.take(), at(left), at(top), scale});
    return {};
}

Result<std::unique_ptr<FrameSource>> ClipArt::composed() {
    std::vector<std::unique_ptr<MemoryClip>> clips;
    std::vector<CompositionLayer> layers;
    for (Piece& piece : pieces_) {
        CompositionLayer& layer = layers.emplace_back();
        layer.clip = piece.clip.get();
        layer.placement = {{piece.scale, piece.scale, 0}, piece.dx, piece.dy, {}};
        layer.frames = recipe_.frames;
        clips.push_back(std::move(piece.clip));
    }
    pieces_.clear();
    Result<std::unique_ptr<Composition>> composition =
        Composition::make(std::move(layers), recipe_.format);
    if (!composition) return std::move(composition).error();
    return std::unique_ptr<FrameSource>(
        std::make_unique<OwningComposition>(std::move(clips), *std::move(composition)));
}

}  // namespace haarmony::video
