#include "engine/curve/affected.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "engine/curve/bspline.h"

namespace haarmony::curve {
namespace {

using Row = std::array<double, kMostDimensions>;  // numbers that are not there are 0
using Segment = std::array<Row, 4>;

// A half has a quarter of the distance between hull and curve: after so many, none is left.
constexpr int kMostHalvings = 26;
// A curve that stays at the limit, but for rounding, must not be halved for ever.
constexpr double kSlack = 1 + 1e-9;

double norm(const Row& row) {
    double square = 0;
    for (const double number : row) square += number * number;
    return std::sqrt(square);
}

Row middle(const Row& a, const Row& b) {
    Row row;
    for (std::size_t d = 0; d < row.size(); ++d) row[d] = 0.5 * (a[d] + b[d]);
    return row;
}

// Whether the curve of these Bezier points is anywhere further than `limit` from 0: yes if
// an end is, no if no hull point is, otherwise as its halves say (de Casteljau).
bool exceeds(const Segment& b, double limit, int halvings) {
    // What is not a number moves.
    if (!(norm(b[0]) <= limit) || !(norm(b[3]) <= limit)) return true;
    if (norm(b[1]) <= kSlack * limit && norm(b[2]) <= kSlack * limit) return false;
    if (halvings == 0) return false;
    const Row left = middle(b[0], b[1]);
    const Row centre = middle(b[1], b[2]);
    const Row right = middle(b[2], b[3]);
    const Row left_centre = middle(left, centre);
    const Row right_centre = middle(centre, right);
    const Row split = middle(left_centre, right_centre);
    return exceeds({b[0], left, left_centre, split}, limit, halvings - 1) ||
           exceeds({split, right_centre, right, b[3]}, limit, halvings - 1);
}

Segment segment_of(const Points& hull, std::size_t number) {
    Segment segment{};
    for (std::size_t i = 0; i < segment.size(); ++i) {
        std::ranges::copy(hull[3 * number + i], segment[i].begin());
    }
    return segment;
}

// The longest run of segments that do not move, round the circle; the rest is affected.
Interval around(const std::vector<bool>& moves) {
    const std::size_t count = moves.size();
    const std::size_t some = std::size_t(std::ranges::find(moves, true) - moves.begin());
    if (some == count) return {};
    std::size_t longest = 0;
    std::size_t longest_end = 0;
    std::size_t run = 0;
    for (std::size_t step = 1; step <= count; ++step) {
        const std::size_t at = (some + step) % count;
        if (moves[at]) {
            run = 0;
        } else if (++run > longest) {
            longest = run;
            longest_end = at + 1;
        }
    }
    if (longest == 0) return {0, 1};
    const std::size_t from = longest_end % count;
    const std::size_t to = (longest_end + count - longest) % count;
    return {double(from) / double(count), to == 0 ? 1 : double(to) / double(count)};
}

}  // namespace

Interval affected_interval(const Points& change,
                           Ends ends,
                           int knot_level,
                           double tolerance) {
    const auto level = level_of(change.size(), ends);
    assert(level && knot_level >= 0 && *level >= knot_level);
    const Points hull = bezier_points(change, ends);
    const std::size_t parts = segment_count(*level - knot_level);
    std::vector<bool> moves(segment_count(knot_level));
    for (std::size_t knot = 0; knot < moves.size(); ++knot) {
        for (std::size_t part = 0; part < parts && !moves[knot]; ++part) {
            const Segment segment = segment_of(hull, knot * parts + part);
            moves[knot] = exceeds(segment, tolerance, kMostHalvings);
        }
    }
    if (ends == Ends::kClosed) return around(moves);
    const auto first = std::ranges::find(moves, true);
    if (first == moves.end()) return {};
    const auto last = std::find(moves.rbegin(), moves.rend(), true);
    return {double(first - moves.begin()) / double(moves.size()),
            double(moves.rend() - last) / double(moves.size())};
}

bool all_finite(const Points& points) {
    return std::ranges::all_of(points.numbers(),
                               [](double number) { return std::isfinite(number); });
}

double coordinate_size(const Points& points) {
    double size = 0;
    for (const double number : points.numbers()) size = std::max(size, std::abs(number));
    return size;
}

}  // namespace haarmony::curve
