#include "engine/video/constant_speed.h"

#include <algorithm>
#include <cassert>

namespace haarmony::video {
namespace {

// A change is judged by the mean of so many pictures since the last one: the worse is left
// quickly, the better must prove itself.
constexpr int kBeforeCoarser = 4;
constexpr int kBeforeFiner = 8;
// What a finer picture is expected to cost, at most, must leave this much room: without it
// the two would alternate as costs waver.
constexpr double kRoom = 0.7;
constexpr double kCostOfALevel = 4;

}  // namespace

Quality::Quality(const QualityOptions& options)
    : options_(options), space_level_(options.finest_level) {
    assert(options.slowest_fps > 0 && options.slowest_fps <= options.fps);
    assert(options.coarsest_level >= 0 && options.coarsest_level <= options.finest_level);
    assert(options.budget >= 0);
}

void Quality::set_budget(double budget) {
    assert(budget >= 0);
    options_.budget = budget;
}

void Quality::drawn(double cost_s) {
    assert(cost_s >= 0);
    total_s_ += cost_s;
    ++pictures_;
    const double mean_s = total_s_ / pictures_;
    if (pictures_ >= kBeforeCoarser && mean_s > allowed_s()) {
        go_coarser();
    } else if (pictures_ >= kBeforeFiner) {
        go_finer(mean_s);
    }
}

void Quality::go_coarser() {
    start_over();
    if (space_level_ > options_.coarsest_level) {
        --space_level_;
    } else if (fps() / 2 >= options_.slowest_fps) {
        ++halvings_;
    }
}

void Quality::go_finer(double cost_s) {
    start_over();
    if (halvings_ > 0) {
        if (cost_s <= kRoom * allowed_s() / 2) --halvings_;
    } else if (space_level_ < options_.finest_level) {
        if (kCostOfALevel * cost_s <= kRoom * allowed_s()) ++space_level_;
    }
}

std::optional<QualityStep> ConstantSpeed::next(double now_s) {
    const double period_s = 1 / quality_.fps();
    const std::optional<TimeStep> time = playback_.next(now_s, period_s);
    if (!time) return std::nullopt;
    counts_ = !time->repeated;
    // On time the steps keep their beat; late, it begins again.
    due_s_ = (now_s - due_s_ < period_s ? std::min(due_s_, now_s) : now_s) + period_s;
    return QualityStep{*time, quality_.space_level(), due_s_};
}

void ConstantSpeed::drawn(double cost_s) {
    if (counts_) quality_.drawn(cost_s);
}

}  // namespace haarmony::video
