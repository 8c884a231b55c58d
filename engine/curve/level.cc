#include "engine/curve/level.h"

namespace haarmony::curve {

std::optional<int> level_of(std::size_t controls, Ends ends) {
    for (int level = 0; level <= kMostLevel; ++level) {
        if (control_count(level, ends) == controls) return level;
    }
    return std::nullopt;
}

}  // namespace haarmony::curve
