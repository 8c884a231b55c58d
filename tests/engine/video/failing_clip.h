// A clip whose storage says no at the n-th thing that it is asked for.
#pragma once

#include <string>

#include "engine/video/time_tree.h"

namespace haarmony::video::testing {

class FailingClip final : public TimeTree {
  public:
    // `clip` must outlive this.
    FailingClip(const TimeTree& clip, int fails_at)
        : TimeTree(clip.shape(), clip.delta()), clip_(clip), fails_at_(fails_at) {}

    [[nodiscard]] bool stored(const SiblingAddress& address) const override {
        return clip_.stored(address);
    }
    [[nodiscard]] Result<Frame::Nodes> nodes(
        const SiblingAddress& address) const override {
        if (asked_++ == fails_at_) return error();
        return clip_.nodes(address);
    }
    [[nodiscard]] Result<Frame::LayerPtr> layer(const SiblingAddress& address,
                                                int space_level) const override {
        if (asked_++ == fails_at_) return error();
        return clip_.layer(address, space_level);
    }
    [[nodiscard]] int asked() const { return asked_; }

  private:
    [[nodiscard]] Error error() const {
        return {ErrorCode::kIo, "the " + std::to_string(fails_at_) + "th read fails", ""};
    }
    const TimeTree& clip_;
    int fails_at_;
    mutable int asked_ = 0;
};

// Runs `work(clip)`, which returns a Result, once for each read that it makes, failing that
// one; false unless every one is passed on and nothing is passed on when none fails.
template <typename Work>
bool passes_on_every_failure(const TimeTree& clip, const Work& work) {
    const FailingClip counting(clip, -1);
    if (!work(counting).has_value() || counting.asked() == 0) return false;
    for (int n = 0; n < counting.asked(); ++n) {
        const auto result = work(FailingClip(clip, n));
        if (result.has_value() || result.error().code != ErrorCode::kIo) return false;
    }
    return true;
}

}  // namespace haarmony::video::testing
