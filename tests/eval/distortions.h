// What happens to pictures between being kept and being asked for: the rows of the
// robustness table.
//
// Each row is a pure function of the picture and of the random numbers that it is given.
//
// Threads const-safe; one Random a thread.
// Source  sec. 4.5.3 for the first four kinds; the others are what copies on the Web suffer.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/eval/simulated_queries.h"

namespace haarmony::eval {

struct Distortion {
    std::string name;
    std::function<QueryPicture(const RgbPicture&, Random&)> apply;
};

// `share` of the width and height cut off at each side. Requires: 0 <= share < 0.5.
[[nodiscard]] RgbPicture crop(const RgbPicture& picture, double share);

// A flat frame around the picture: `across` of its width at the left and right, `along` of
// its height at the top and bottom.
[[nodiscard]] RgbPicture frame(const RgbPicture& picture,
                               double across,
                               double along,
                               std::uint8_t grey);

// A white bar with dark words over the lowest `share` of the height.
[[nodiscard]] RgbPicture caption(const RgbPicture& picture, double share, Random& random);

[[nodiscard]] RgbPicture mirror(const RgbPicture& picture);

// A quarter turn clockwise.
[[nodiscard]] RgbPicture turn(const RgbPicture& picture);

// Through JPEG of that quality and back.
[[nodiscard]] RgbPicture compress(const RgbPicture& picture, int quality);

// What is transparent filled with the mean colour of what is not: what a search does that
// knows of no mask. Requires: four channels.
[[nodiscard]] RgbPicture fill_with_mean(const QueryPicture& picture);

// A step of length `distance` in a random direction of the colour cube.
[[nodiscard]] RgbPicture random_colour_shift(const RgbPicture& picture,
                                             double distance,
                                             Random& random);

// A move by `distance` widths in a random direction.
[[nodiscard]] RgbPicture random_translation(const RgbPicture& picture,
                                            double distance,
                                            Random& random);

// All rows, in the order of the table.
[[nodiscard]] const std::vector<Distortion>& distortions();

// Requires: a name of the table.
[[nodiscard]] const Distortion& distortion(const std::string& name);

}  // namespace haarmony::eval
