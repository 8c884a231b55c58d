// Calls a template with the dimension of some points as a constant, so that its inner loops
// are unrolled: of two numbers a row they are twice as fast.
#pragma once

#include <cassert>
#include <type_traits>

#include "engine/curve/points.h"

namespace haarmony::curve {

// work(std::integral_constant<int, dimension>). Requires: 1 <= dimension <= kMostDimensions.
template <typename Work>
decltype(auto) with_dimension(int dimension, Work&& work) {
    static_assert(kMostDimensions == 8);
    assert(dimension >= 1 && dimension <= kMostDimensions);
    switch (dimension) {
        case 1:
            return work(std::integral_constant<int, 1>());
        case 2:
            return work(std::integral_constant<int, 2>());
        case 3:
            return work(std::integral_constant<int, 3>());
        case 4:
            return work(std::integral_constant<int, 4>());
        case 5:
            return work(std::integral_constant<int, 5>());
        case 6:
            return work(std::integral_constant<int, 6>());
        case 7:
            return work(std::integral_constant<int, 7>());
        default:
            return work(std::integral_constant<int, 8>());
    }
}

}  // namespace haarmony::curve
