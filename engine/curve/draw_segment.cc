#include "engine/curve/draw_segment.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "engine/curve/plane_cubic.h"

namespace haarmony::curve {
namespace {

class Drawing {
  public:
    Drawing(std::span<const SegmentLevel> levels,
            double tolerance,
            std::span<const std::size_t> turns)
        : levels_(levels), tolerance_(tolerance), turns_(turns) {
        assert(!levels.empty() && tolerance > 0);
        assert(std::ranges::is_sorted(turns));
        double size = 0;
        for (const SegmentLevel& level : levels) {
            for (std::size_t i = 0; i < level.bezier.size(); ++i) {
                const PlaneVector p = in_plane(level.bezier[i]);
                size = std::max({size, std::abs(p.x), std::abs(p.y)});
            }
        }
        // Each level adds its own; what is left at the finest level is exact.
        rounding_ = 64 * std::numeric_limits<double>::epsilon() * size *
                    static_cast<double>(levels.size());
    }

    int finest() const { return static_cast<int>(levels_.size()) - 1; }

    double bound(SegmentName s) const {
        if (s.level == finest()) return 0;
        return levels_[std::size_t(s.level)].bound[s.index] + rounding_;
    }

    void draw(SegmentName s, std::vector<SegmentName>& names) const {
        if ((bound(s) < tolerance_ && !turns_within(s)) || s.level == finest()) {
            names.push_back(s);
            return;
        }
        draw({s.level + 1, 2 * s.index}, names);
        draw({s.level + 1, 2 * s.index + 1}, names);
    }

    // The Bezier point of a segment.
    std::span<const double> row(SegmentName s, std::size_t k) const {
        return levels_[std::size_t(s.level)].bezier[3 * s.index + k];
    }

    DrawnSegments drawn(std::vector<SegmentName> names) const {
        DrawnSegments result{std::move(names), {}, 0};
        result.bezier =
            Points(4 * result.names.size(), levels_.front().bezier.dimension());
        for (std::size_t i = 0; i < result.names.size(); ++i) {
            for (std::size_t k = 0; k < 4; ++k) {
                std::ranges::copy(row(result.names[i], k),
                                  result.bezier[4 * i + k].begin());
            }
            result.bound = std::max(result.bound, bound(result.names[i]));
        }
        return result;
    }

    // Where segments i - 1 and i meet, by i; the first and last row are the ends.
    Points joints(std::span<const SegmentName> names, Ends ends) const {
        const std::size_t count = names.size();
        const bool around = ends == Ends::kClosed;
        Points result(count + 1, levels_.front().bezier.dimension());
        for (std::size_t i = 0; i <= count; ++i) {
            const bool end = i == 0 || i == count;
            const std::size_t knot = i == count ? knots() : start_of(names[i]);
            const bool turns =
                turns_at(knot) || (end && around && turns_at(knots() - knot));
            const auto before = row(names[i == 0 ? count - 1 : i - 1], 3);
            const auto after = row(names[i == count ? 0 : i], 0);
            const auto curve = levels_.back().bezier[3 * knot];
            for (std::size_t d = 0; d < result[i].size(); ++d) {
                result[i][d] = turns            ? curve[d]
                               : !end || around ? (before[d] + after[d]) / 2
                               : i == 0         ? after[d]
                                                : before[d];
            }
        }
        return result;
    }

    // By how much a segment moves when its ends do.
    double move(SegmentName s,
                std::span<const double> start,
                std::span<const double> end) const {
        // B_0 and B_3 are together at most 1: of two moved ends the larger move counts.
        return std::max(distance(row(s, 0), start), distance(row(s, 3), end));
    }

    double tolerance() const { return tolerance_; }

  private:
    double distance(std::span<const double> from, std::span<const double> to) const {
        const double length = norm(in_plane(to) - in_plane(from));
        return length > 0 ? length + rounding_ : 0;
    }

    std::size_t knots() const { return levels_.back().bezier.size() / 3; }
    std::size_t start_of(SegmentName s) const { return s.index << (finest() - s.level); }

    bool turns_at(std::size_t knot) const {
        return std::ranges::binary_search(turns_, knot);
    }
    bool turns_within(SegmentName s) const {
        const auto first = std::upper_bound(turns_.begin(), turns_.end(), start_of(s));
        return first != turns_.end() && *first < start_of({s.level, s.index + 1});
    }

    std::span<const SegmentLevel> levels_;
    double tolerance_;
    std::span<const std::size_t> turns_;
    double rounding_ = 0;
};

}  // namespace

DrawnSegments draw_segments(std::span<const SegmentLevel> levels,
                            double tolerance,
                            std::span<const std::size_t> turns) {
    const Drawing drawing(levels, tolerance, turns);
    std::vector<SegmentName> names;
    drawing.draw({0, 0}, names);
    return drawing.drawn(std::move(names));
}

DrawnSegments draw_joined_segments(std::span<const SegmentLevel> levels,
                                   Ends ends,
                                   double tolerance,
                                   std::span<const std::size_t> turns) {
    const Drawing drawing(levels, tolerance, turns);
    std::vector<SegmentName> names;
    drawing.draw({0, 0}, names);
    Points joints;
    // A split changes the moves of its neighbours, so all is looked at again. It ends:
    // segments of the finest level meet.
    for (bool again = true; again;) {
        again = false;
        joints = drawing.joints(names, ends);
        std::vector<SegmentName> finer;
        for (std::size_t i = 0; i < names.size(); ++i) {
            const SegmentName s = names[i];
            const double bound =
                drawing.bound(s) + drawing.move(s, joints[i], joints[i + 1]);
            if (bound < drawing.tolerance() || s.level == drawing.finest()) {
                finer.push_back(s);
                continue;
            }
            finer.push_back({s.level + 1, 2 * s.index});
            finer.push_back({s.level + 1, 2 * s.index + 1});
            again = true;
        }
        names = std::move(finer);
    }
    DrawnSegments result = drawing.drawn(std::move(names));
    for (std::size_t i = 0; i < result.names.size(); ++i) {
        const SegmentName s = result.names[i];
        result.bound = std::max(
            result.bound, drawing.bound(s) + drawing.move(s, joints[i], joints[i + 1]));
        std::ranges::copy(joints[i], result.bezier[4 * i].begin());
        std::ranges::copy(joints[i + 1], result.bezier[4 * i + 3].begin());
    }
    return result;
}

}  // namespace haarmony::curve
