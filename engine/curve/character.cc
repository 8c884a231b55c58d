#include "engine/curve/character.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "engine/curve/affected.h"

namespace haarmony::curve {
namespace {

Error invalid(std::string message, const char* param) {
    return {ErrorCode::kInvalidArgument, std::move(message), param};
}

// D^j of the result in the character's frames, in the dimensions of the curve; those that
// the character does not have are 0.
Points given(const Points& detail, int dimension, double strength) {
    Points points(detail.size(), dimension);
    const std::size_t shared = std::size_t(std::min(dimension, detail.dimension()));
    for (std::size_t row = 0; row < detail.size(); ++row) {
        for (std::size_t d = 0; d < shared; ++d) {
            points[row][d] = strength * detail[row][d];
        }
    }
    return points;
}

// The numbers from dimension `first` on, row by row.
void copy_dimensions(const Points& from, std::size_t first, Points& to) {
    for (std::size_t row = 0; row < from.size(); ++row) {
        std::ranges::copy(from[row].subspan(first), to[row].begin() + first);
    }
}

}  // namespace

Result<Points> give_character(const MultiresCurve& sweep,
                              const LocalDetails& character,
                              int from_level,
                              double strength) {
    if (from_level < 0 || from_level > sweep.level()) {
        return invalid("from_level " + std::to_string(from_level) + " is outside 0.." +
                           std::to_string(sweep.level()),
                       "from_level");
    }
    if (!std::isfinite(strength)) {
        return invalid("strength " + std::to_string(strength) + " is not finite",
                       "strength");
    }
    const int dimension = sweep.coarse.dimension();
    // A frame mixes x and y: whoever has the one has both.
    const int had =
        std::max(character.coarse.dimension(), character.frame == Frame::kFixed ? 1 : 2);
    Points control = reconstruct(sweep, from_level);
    for (int level = from_level; level < character.level(); ++level) {
        Points detail = given(character.details[level], dimension, strength);
        out_of_frames(detail, control, sweep.ends, character.frame);
        if (had < dimension && level < sweep.level()) {
            copy_dimensions(sweep.details[level], std::size_t(had), detail);
        }
        control = synthesize(control, detail, sweep.ends);
    }
    if (!all_finite(control)) {
        std::ostringstream message;
        message << "strength " << strength
                << " takes the curve beyond the largest number";
        return invalid(message.str(), "strength");
    }
    return control;
}

}  // namespace haarmony::curve
