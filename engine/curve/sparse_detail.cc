#include "engine/curve/sparse_detail.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/curve/bspline.h"
#include "engine/curve/bspline_filters.h"
#include "engine/curve/local_analysis.h"

namespace haarmony::curve {
namespace {

double norm(std::span<const double> numbers) {
    double sum = 0;
    for (const double number : numbers) sum += number * number;
    return std::sqrt(sum);
}

// How far a point may move at most if every row of D^level changes by 1: a point lies within
// the hull of its control points.
double reach_of_details(int level, Ends ends) {
    // All special rows of either end and the two kinds of others are among the first 32.
    const std::size_t rows = std::min(control_count(level + 1, ends), std::size_t{32});
    double most = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        const Taps taps = wavelet_row(level + 1, ends, row);
        double sum = 0;
        for (const double tap : taps.values()) sum += std::abs(tap);
        most = std::max(most, sum);
    }
    return most;
}

}  // namespace

SparseCurve::SparseCurve(Points whole, Ends ends)
    : ends_(ends),
      whole_level_(level_of(whole.size(), ends).value_or(-1)),
      control_(std::move(whole)) {
    assert(whole_level_ >= 0);
    roots_.resize(segment_count(whole_level_), kNone);
}

int SparseCurve::level() const {
    for (int level = kMostLevel - 1; level >= whole_level_; --level)
        if (nodes_at_[std::size_t(level)] > 0) return level + 1;
    return whole_level_;
}

std::span<double> SparseCurve::numbers_of(std::uint32_t node) {
    return std::span(numbers_).subspan(node * std::size_t(dimension()),
                                       std::size_t(dimension()));
}
std::span<const double> SparseCurve::numbers_of(std::uint32_t node) const {
    return std::span(numbers_).subspan(node * std::size_t(dimension()),
                                       std::size_t(dimension()));
}

std::uint32_t SparseCurve::find(int level, std::size_t index) const {
    assert(whole_level_ <= level && level < kMostLevel && index < segment_count(level));
    int below = level - whole_level_;
    std::uint32_t node = roots_[index >> below];
    while (node != kNone && below > 0) node = nodes_[node].child[index >> --below & 1];
    return node;
}

std::uint32_t SparseCurve::append(int level) {
    nodes_.push_back({{kNone, kNone}, level});
    numbers_.resize(numbers_.size() + std::size_t(dimension()));
    ++nodes_at_[std::size_t(level)];
    return std::uint32_t(nodes_.size() - 1);
}

std::span<const double> SparseCurve::detail(int level, std::size_t index) const {
    const std::uint32_t node = find(level, index);
    return node == kNone ? std::span<const double>() : numbers_of(node);
}

void SparseCurve::add_detail(int level,
                             std::size_t index,
                             std::span<const double> delta) {
    assert(whole_level_ <= level && level < kMostLevel && index < segment_count(level));
    assert(delta.size() == std::size_t(dimension()));
    const std::size_t root = index >> (level - whole_level_);
    if (roots_[root] == kNone) roots_[root] = append(whole_level_);
    std::uint32_t node = roots_[root];
    for (int j = whole_level_ + 1; j <= level; ++j) {
        const std::size_t side = index >> (level - j) & 1;
        if (nodes_[node].child[side] == kNone) {
            const std::uint32_t made = append(j);
            nodes_[node].child[side] = made;
        }
        node = nodes_[node].child[side];
    }
    const std::span<double> numbers = numbers_of(node);
    for (std::size_t d = 0; d < delta.size(); ++d) numbers[d] += delta[d];
}

std::size_t SparseCurve::move_control(int level,
                                      std::size_t index,
                                      std::span<const double> delta,
                                      double precision) {
    assert(whole_level_ <= level && level <= kMostLevel);
    assert(index < control_count(level, ends_) &&
           delta.size() == std::size_t(dimension()));
    assert(1e-16 <= precision && precision < 1);
    LocalRows change{index, Points(1, dimension())};
    std::ranges::copy(delta, change.rows[0].begin());
    const double least = precision * norm(delta);
    std::size_t visited = 1;
    for (int j = level; j > whole_level_ && !change.rows.empty(); --j) {
        LocalStep step = analyze_local(change, j, ends_, least, precision);
        visited += step.visited;
        const std::size_t count = segment_count(j - 1);
        for (std::size_t i = 0; i < step.detail.rows.size(); ++i)
            add_detail(j - 1, (step.detail.first + i) % count, step.detail.rows[i]);
        change = std::move(step.coarse);
    }
    for (std::size_t i = 0; i < change.rows.size(); ++i) {
        const auto point = control_[(change.first + i) % control_.size()];
        for (std::size_t d = 0; d < point.size(); ++d) point[d] += change.rows[i][d];
    }
    return visited;
}

std::vector<double> SparseCurve::point_at(double u) const {
    std::vector<double> point = curve::point_at(control_, ends_, u);
    for (int level = whole_level_; level < this->level(); ++level) {
        const BasisAt basis = basis_at(level + 1, ends_, u);
        const std::size_t points = control_count(level + 1, ends_);
        for (std::size_t i = 0; i < 4; ++i) {
            const Taps taps = wavelet_row(level + 1, ends_, (basis.first + i) % points);
            for (std::size_t k = 0; k < std::size_t(taps.count); ++k) {
                const auto row = detail(level, (taps.first + k) % segment_count(level));
                for (std::size_t d = 0; d < row.size(); ++d)
                    point[d] += basis.value[i] * taps.value[k] * row[d];
            }
        }
    }
    return point;
}

MultiresCurve SparseCurve::whole() const {
    MultiresCurve curve = decompose(control_, ends_);
    for (int level = whole_level_; level < this->level(); ++level) {
        curve.details.emplace_back(segment_count(level), dimension());
        // Without rows below it, a row costs a look at its root.
        Points& details = curve.details.back();
        for (std::size_t k = 0; k < details.size(); ++k)
            std::ranges::copy(detail(level, k), details[k].begin());
    }
    return curve;
}

double SparseCurve::prune(double tolerance) {
    assert(tolerance >= 0);
    const auto levels =
        std::ranges::count_if(nodes_at_, [](std::size_t n) { return n > 0; });
    std::array<double, kMostLevel> reach{};
    std::array<double, kMostLevel> largest{};
    for (int level = whole_level_; level < this->level(); ++level)
        reach[std::size_t(level)] = reach_of_details(level, ends_);
    // From the back, so that children are judged before their parents.
    std::vector<bool> kept(nodes_.size());
    const auto is_kept = [&](std::uint32_t child) {
        return child != kNone && kept[child];
    };
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        const auto level = std::size_t(nodes_[i].level);
        const double size = norm(numbers_of(std::uint32_t(i)));
        kept[i] = std::ranges::any_of(nodes_[i].child, is_kept) ||
                  size * reach[level] * double(levels) > tolerance;
        if (!kept[i]) largest[level] = std::max(largest[level], size);
    }
    std::vector<std::uint32_t> place(nodes_.size(), kNone);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
        if (kept[i]) place[i] = next++;
    const auto follow = [&](std::uint32_t& node) {
        if (node != kNone) node = place[node];
    };
    nodes_at_.fill(0);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (!kept[i]) continue;
        std::ranges::for_each(nodes_[i].child, follow);
        ++nodes_at_[std::size_t(nodes_[i].level)];
        nodes_[place[i]] = nodes_[i];
        std::ranges::copy(numbers_of(std::uint32_t(i)), numbers_of(place[i]).begin());
    }
    std::ranges::for_each(roots_, follow);
    nodes_.resize(next);
    numbers_.resize(next * std::size_t(dimension()));
    double bound = 0;
    for (std::size_t level = 0; level < reach.size(); ++level)
        bound += reach[level] * largest[level];
    return std::min(bound, tolerance);  // the sum may round above
}

}  // namespace haarmony::curve
