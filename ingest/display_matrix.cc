#include "ingest/display_matrix.h"

#include <cassert>
#include <cstddef>

namespace haarmony::ingest {
namespace {

int sign(std::int32_t number) { return number > 0 ? 1 : number < 0 ? -1 : 0; }

}  // namespace

Turn turn_of(const std::array<std::int32_t, 9>& matrix) {
    const Turn signs = {
        sign(matrix[0]), sign(matrix[1]), sign(matrix[3]), sign(matrix[4])};
    const bool upright = signs.b == 0 && signs.c == 0 && signs.a != 0 && signs.d != 0;
    const bool sideways = signs.a == 0 && signs.d == 0 && signs.b != 0 && signs.c != 0;
    return upright || sideways ? signs : Turn{};
}

void turn(const video::Picture& from, const Turn& how, video::Picture& to) {
    assert(&from != &to);
    to.width = how.swaps_sides() ? from.height : from.width;
    to.height = how.swaps_sides() ? from.width : from.height;
    to.pixels.resize(from.pixels.size());
    const std::int32_t left = how.a + how.c < 0 ? to.width - 1 : 0;
    const std::int32_t top = how.b + how.d < 0 ? to.height - 1 : 0;
    for (std::int32_t y = 0; y < from.height; ++y) {
        for (std::int32_t x = 0; x < from.width; ++x) {
            to.at(left + how.a * x + how.c * y, top + how.b * x + how.d * y) =
                from.at(x, y);
        }
    }
}

}  // namespace haarmony::ingest
