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
    Drawing(std::span<const SegmentLevel> levels, double tolerance)
        : levels_(levels), tolerance_(tolerance) {
        assert(!levels.empty() && tolerance > 0);
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
        if (bound(s) < tolerance_ || s.level == finest()) {
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

    // By how much averaging moves each segment's start; one more for the end of the last.
    std::vector<double> moves(std::span<const SegmentName> names, Ends ends) const {
        std::vector<double> result(names.size() + 1);
        for (std::size_t i = 1; i < names.size(); ++i) {
            result[i] = move(names[i - 1], names[i]);
        }
        if (ends == Ends::kClosed) {
            result.front() = result.back() = move(names.back(), names.front());
        }
        return result;
    }

    double tolerance() const { return tolerance_; }

  private:
    double move(SegmentName before, SegmentName after) const {
        const double gap = norm(in_plane(row(after, 0)) - in_plane(row(before, 3)));
        return gap > 0 ? gap / 2 + rounding_ : 0;
    }

    std::span<const SegmentLevel> levels_;
    double tolerance_;
    double rounding_ = 0;
};

void average(std::span<double> a, std::span<double> b) {
    for (std::size_t d = 0; d < a.size(); ++d) a[d] = b[d] = (a[d] + b[d]) / 2;
}

}  // namespace

DrawnSegments draw_segments(std::span<const SegmentLevel> levels, double tolerance) {
    const Drawing drawing(levels, tolerance);
    std::vector<SegmentName> names;
    drawing.draw({0, 0}, names);
    return drawing.drawn(std::move(names));
}

DrawnSegments draw_joined_segments(std::span<const SegmentLevel> levels,
                                   Ends ends,
                                   double tolerance) {
    const Drawing drawing(levels, tolerance);
    std::vector<SegmentName> names;
    drawing.draw({0, 0}, names);
    std::vector<double> moves;
    // A split changes the moves of its neighbours, so all is looked at again. It ends:
    // segments of the finest level meet.
    for (bool again = true; again;) {
        again = false;
        moves = drawing.moves(names, ends);
        std::vector<SegmentName> finer;
        for (std::size_t i = 0; i < names.size(); ++i) {
            const SegmentName s = names[i];
            // B_0 and B_3 are together at most 1: of two moved ends the larger move counts.
            const double bound = drawing.bound(s) + std::max(moves[i], moves[i + 1]);
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
    const std::size_t count = result.names.size();
    for (std::size_t i = 0; i < count; ++i) {
        result.bound =
            std::max(result.bound,
                     drawing.bound(result.names[i]) + std::max(moves[i], moves[i + 1]));
        const bool last = i + 1 == count;
        if (!last || ends == Ends::kClosed) {
            average(result.bezier[4 * i + 3], result.bezier[last ? 0 : 4 * (i + 1)]);
        }
    }
    return result;
}

}  // namespace haarmony::curve
