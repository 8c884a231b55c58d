#include "engine/video/bricks.h"

namespace haarmony::video {

void Bricks::push_back(const Brick& brick) {
    BrickColors colors;
    BrickAlphas alphas;
    const std::size_t i = colors_.size();
    if (!pack(brick, colors, alphas)) {
        const auto before = static_cast<std::uint32_t>(alphas_.size());
        with_alpha_.resize(i / 32 + 1, {0, before});
        with_alpha_.back().bits |= std::uint32_t{1} << i % 32;
        alphas_.push_back(alphas);
    }
    colors_.push_back(colors);
}

void Bricks::shrink_to_fit() {
    colors_.shrink_to_fit();
    alphas_.shrink_to_fit();
    with_alpha_.shrink_to_fit();
}

void Bricks::clear() {
    colors_.clear();
    alphas_.clear();
    with_alpha_.clear();
}

}  // namespace haarmony::video
