// Figure 3.8: one sweep with the characters of others, alone and in a drawing.
//
// Source  sec. 3.4.2; sec. 3.4.3 (unnormalised frames, as the dissertation's figure).
#pragma once

#include <string>
#include <vector>

#include "engine/curve/points.h"

namespace haarmony::eval {

// Of the single stroke: its sweep below this level, characters from it on.
inline constexpr int kCharacterLevel = 3;

struct WithCharacter {
    std::string character;
    curve::Points control;
    double sweep_error = 0;  // f^kCharacterLevel beside that of the sweep
    double distance = 0;     // the largest from the sweep, at equal u
};

struct DrawnPart {
    std::string name;
    std::string character;
    curve::Points control;
};

struct Figure38 {
    curve::Points sweep;
    std::vector<WithCharacter> characters;  // every built-in one
    std::vector<std::vector<DrawnPart>>
        drawings;  // smooth, in two hands, each part its own
};

[[nodiscard]] Figure38 measure_figure_3_8();
[[nodiscard]] std::string to_html(const Figure38& figure);

// The landscape with the character that suits each part.
[[nodiscard]] std::vector<DrawnPart> drawn_landscape();

}  // namespace haarmony::eval
