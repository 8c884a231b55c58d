#include "engine/curve/corner_joints.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace haarmony::curve {
namespace {

constexpr double kAtJoint =
    1e-9;  // of a piece: a corner so close to a joint is meant there

// De Casteljau: writes rows 3 * piece .. + 3 of what is before t, and leaves in `rest`, the
// control points of all dimensions, what is after.
void cut(Points& rest, double t, Points& rows, std::size_t piece) {
    for (std::size_t i = 0; i < 4; ++i) {
        std::ranges::copy(rest[0], rows[3 * piece + i].begin());
        for (std::size_t k = 0; k + 1 < 4 - i; ++k) {
            for (std::size_t d = 0; d < rest[k].size(); ++d) {
                rest[k][d] += t * (rest[k + 1][d] - rest[k][d]);
            }
        }
    }
}

}  // namespace

std::vector<double> corner_places(std::span<const double> corners, std::size_t pieces) {
    std::vector<double> places;
    for (const double u : corners) {
        assert(u >= 0 && u <= 1);
        const double place = u * static_cast<double>(pieces);
        const double joint = std::round(place);
        places.push_back(std::abs(place - joint) < kAtJoint ? joint : place);
    }
    std::ranges::sort(places);
    const auto same = [](double a, double b) { return b - a < kAtJoint; };
    places.erase(std::unique(places.begin(), places.end(), same), places.end());
    return places;
}

CorneredChain split_at_corners(const Points& chain, std::span<const double> corners) {
    assert(chain.size() >= 4 && chain.size() % 3 == 1);
    const std::size_t pieces = chain.size() / 3;
    std::vector<double> places = corner_places(corners, pieces);
    std::erase_if(places, [&](double place) {
        return place == 0 || place == static_cast<double>(pieces);
    });
    const auto within = static_cast<std::size_t>(std::ranges::count_if(
        places, [](double place) { return place != std::floor(place); }));
    CorneredChain result;
    result.chain = Points(3 * (pieces + within) + 1, chain.dimension());
    std::size_t written = 0;
    auto place = places.begin();
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        Points rest(4, chain.dimension());
        for (std::size_t i = 0; i < 4; ++i) {
            std::ranges::copy(chain[3 * piece + i], rest[i].begin());
        }
        double start = 0;  // of `rest`, within the piece
        const auto number = static_cast<double>(piece);
        for (; place != places.end() && *place < number + 1; ++place) {
            if (*place > number) {
                const double t = *place - number;
                cut(rest, (t - start) / (1 - start), result.chain, written++);
                start = t;
            }
            result.joints.push_back(written);
        }
        for (std::size_t i = 0; i < 4; ++i) {
            std::ranges::copy(rest[i], result.chain[3 * written + i].begin());
        }
        ++written;
    }
    return result;
}

}  // namespace haarmony::curve
