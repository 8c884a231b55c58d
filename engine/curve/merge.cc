#include "engine/curve/merge.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <optional>

#include "engine/curve/carried_fit.h"
#include "engine/curve/chain.h"
#include "engine/curve/cubic_fit.h"
#include "engine/curve/run_bound.h"

namespace haarmony::curve {
namespace {

// Joints that are tried further of those that equally many segments reach. With the joints
// beyond the farthest, three take 0.7 of the segments that one alone takes, for three times
// the fits; six would take 0.6, for six times.
constexpr std::size_t kBreadth = 3;
// Joints that are tried beyond the farthest one that was reached.
constexpr std::size_t kLookahead = 4;

constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

// How a joint was reached first: the segment that ends there.
struct Arrival {
    std::size_t from = kNowhere;
    PlaneCubic cubic{};
    double bound = 0;
};

class Search {
  public:
    Search(const Chain& chain, double tolerance)
        : chain_(chain),
          tolerance_(tolerance),
          fitter_(chain, tolerance),
          arrivals_(chain.pieces.size() + 1) {}

    // Finds arrivals up to `last`, from where `first` is.
    void run(std::size_t first, std::size_t last) {
        std::vector<std::size_t> layer{first};
        while (arrivals_[last].from == kNowhere) {
            reached_.clear();
            for (const std::size_t from : layer) extend(from, last);
            std::ranges::sort(reached_, std::greater());
            // The others may be reached again, by more segments.
            for (std::size_t i = kBreadth; i < reached_.size(); ++i) {
                arrivals_[reached_[i]].from = kNowhere;
            }
            if (reached_.size() > kBreadth) reached_.resize(kBreadth);
            layer = reached_;
        }
    }

    const Arrival& arrival(std::size_t joint) const { return arrivals_[joint]; }

  private:
    // Whether one segment reaches from joint to joint.
    bool reaches(std::size_t from, std::size_t to) {
        Arrival arrival{from, chain_.pieces[from], 0};
        if (to > from + 1) {
            const std::optional<PlaneCubic> cubic = fitter_.fit(from, to);
            if (!cubic) return false;
            const std::optional<double> bound =
                proved_bound(chain_, from, to, *cubic, tolerance_, cuts_);
            if (!bound) return false;
            arrival = {from, *cubic, *bound};
        }
        if (arrivals_[to].from == kNowhere) {
            arrivals_[to] = arrival;
            reached_.push_back(to);
        }
        return true;
    }

    // Galloping, then halving, then a little further: that one run is not close enough does
    // not mean that no longer one is.
    void extend(std::size_t from, std::size_t last) {
        std::size_t good = from + 1;
        reaches(from, good);
        std::size_t bad = last + 1;
        for (std::size_t step = 1; good < last && bad > last; step *= 2) {
            const std::size_t to = std::min(last, good + step);
            (reaches(from, to) ? good : bad) = to;
        }
        while (bad - good > 1 && good < last) {
            const std::size_t to = good + (bad - good) / 2;
            (reaches(from, to) ? good : bad) = to;
        }
        for (std::size_t to = good + 2; to <= good + 1 + kLookahead && to <= last; ++to) {
            reaches(from, to);
        }
    }

    const Chain& chain_;
    double tolerance_;
    CubicFitter fitter_;
    Cuts cuts_;
    std::vector<Arrival> arrivals_;
    std::vector<std::size_t> reached_;  // by the layer's segments, for the first time
};

void write(const PlaneCubic& cubic, Points& rows, std::size_t first) {
    for (std::size_t i = 0; i < 4; ++i) {
        rows[first + i][0] = cubic[i].x;
        if (rows.dimension() > 1) rows[first + i][1] = cubic[i].y;
    }
}

}  // namespace

MergedSegments merge(const Points& bezier,
                     double tolerance,
                     std::span<const std::size_t> corners) {
    assert(tolerance > 0 && std::ranges::is_sorted(corners));
    const Chain chain = make_chain(bezier);
    const std::size_t end = chain.pieces.size();
    Search search(chain, tolerance);
    std::size_t start = 0;
    const auto run_to = [&](std::size_t joint) {
        if (joint > start && joint <= end) search.run(start, joint);
        start = std::max(start, joint);
    };
    for (const std::size_t corner : corners) run_to(corner);
    run_to(end);

    MergedSegments merged;
    for (std::size_t joint = end; joint > 0; joint = search.arrival(joint).from) {
        merged.joints.push_back(joint);
    }
    merged.joints.push_back(0);
    std::ranges::reverse(merged.joints);
    merged.bezier = Points(4 * (merged.joints.size() - 1), bezier.dimension());
    Cuts cuts;
    for (std::size_t i = 0; i + 1 < merged.joints.size(); ++i) {
        const std::size_t from = merged.joints[i];
        const std::size_t to = merged.joints[i + 1];
        const Arrival& arrival = search.arrival(to);
        merged.bound = std::max(merged.bound, arrival.bound);
        if (to == from + 1) {
            for (std::size_t k = 0; k < 4; ++k) {
                std::ranges::copy(bezier[3 * from + k], merged.bezier[4 * i + k].begin());
            }
            continue;
        }
        write(arrival.cubic, merged.bezier, 4 * i);
        if (bezier.dimension() > 2) {
            static_cast<void>(
                proved_bound(chain, from, to, arrival.cubic, tolerance, cuts));
            fit_carried(bezier, from, to, cuts, merged.bezier, 4 * i);
        }
    }
    return merged;
}

}  // namespace haarmony::curve
