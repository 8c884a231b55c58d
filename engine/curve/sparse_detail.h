// A curve with more levels only where an edit needs them: pruned binary trees of details over
// a whole curve.
//   multires_curve.h, bspline_filters.h -> [sparse_detail.h]
//
// Shape    level n is that of the whole curve; a tree stands over each row of D^n, and the
//          children of row k of D^j are rows 2k and 2k + 1 of D^(j+1). A row that is not
//          there is 0, and so are all below it.
// Scale    details as in multires_curve.h.
// Errors   none; a level above kMostLevel, an index out of range are a caller's bug and assert.
// Threads  const-thread-safe.
// Cost     of an edit and of a point: a constant for each level between n and the finest.
// Source   sec. 3.6, "Sparse representations".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/curve/multires_curve.h"

namespace haarmony::curve {

class SparseCurve {
  public:
    // Requires: as many points as a level has.
    SparseCurve(Points whole, Ends ends);

    [[nodiscard]] Ends ends() const { return ends_; }
    [[nodiscard]] int dimension() const { return control_.dimension(); }
    // n, the level below the trees.
    [[nodiscard]] int whole_level() const { return whole_level_; }
    // That of the curve with all its details: above the finest of the trees.
    [[nodiscard]] int level() const;
    // Rows of details in the trees, those on the way to others among them.
    [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }

    // Row `index` of D^level, empty if it is not there; valid until the next change.
    // Requires: whole_level() <= level < kMostLevel.
    [[nodiscard]] std::span<const double> detail(int level, std::size_t index) const;
    // Adds to that row; makes it, and those above it, where they are not there.
    void add_detail(int level, std::size_t index, std::span<const double> delta);

    // Moves control point `index` of C^level by `delta`, as sweep_edit.h does at integer
    // levels: all details stay. The wavelets of the change fall off to 0.54 from one to the
    // next; those are left out that move no control point by more than `precision` * delta.
    // Returns the control points that were looked at, of all levels.
    // Requires: whole_level() <= level <= kMostLevel, 1e-16 <= precision < 1.
    std::size_t move_control(int level,
                             std::size_t index,
                             std::span<const double> delta,
                             double precision);

    // One point, dimension() numbers. Requires: 0 <= u <= 1.
    [[nodiscard]] std::vector<double> point_at(double u) const;

    // The same curve with all rows of all levels up to level(). Cost: linear in 2^level().
    [[nodiscard]] MultiresCurve whole() const;

    // Leaves out small rows that have none below them, so that no point of the curve moves
    // by more than the tolerance; unlike elsewhere in all numbers together, because details
    // of thickness alone must not be lost. Returns a bound on the move, at most `tolerance`;
    // at 0 only rows of zeros go. Requires: 0 <= tolerance.
    double prune(double tolerance);

  private:
    struct Node {
        // Of rows 2k and 2k + 1 of the next level: places in nodes_, or kNone.
        std::array<std::uint32_t, 2> child;
        int level;
    };
    static constexpr std::uint32_t kNone = 0xFFFFFFFF;

    [[nodiscard]] std::uint32_t find(int level, std::size_t index) const;
    std::uint32_t append(int level);
    [[nodiscard]] std::span<double> numbers_of(std::uint32_t node);
    [[nodiscard]] std::span<const double> numbers_of(std::uint32_t node) const;

    Ends ends_;
    int whole_level_;
    Points control_;                                  // C^n
    std::vector<std::uint32_t> roots_;                // by row of D^n
    std::vector<Node> nodes_;                         // parents before their children
    std::vector<double> numbers_;                     // dimension() for each node
    std::array<std::size_t, kMostLevel> nodes_at_{};  // by level
};

}  // namespace haarmony::curve
