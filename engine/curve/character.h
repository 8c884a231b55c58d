// The character of a curve: its details, taken from one curve and given to another.
//   frame.h -> [character.h] -> built_in_character.h
//
// The result has the sweep f^from_level of one curve and, from there on, the details of the
// other, and so the other's level, or from_level where that is finer: a level of the sweep's
// own details beyond it would be a character too. Dimensions that the character does not
// have keep the curve's own details, as far as the level of the result goes. A closed curve
// takes an open one's character and the other way round: their details are row for row.
//
// Scale    strength 0 is the sweep alone, 1 the whole character, others scale its details,
//          below 0 mirrored; in the frames of the character.
// Errors   give_character: a level that the curve does not have, a strength that is not
//          finite; `param` names the argument.
// Threads  const-thread-safe.
// Cost     linear in the control points of the result.
// Source   sec. 3.4.2, sec. 3.4.3.
#pragma once

#include "engine/core/result.h"
#include "engine/curve/frame.h"

namespace haarmony::curve {

[[nodiscard]] inline LocalDetails character_of(const Points& control,
                                               Ends ends,
                                               Frame frame) {
    return to_local(decompose(control, ends), frame);
}

// Control points at the level of the result.
[[nodiscard]] Result<Points> give_character(const MultiresCurve& sweep,
                                            const LocalDetails& character,
                                            int from_level,
                                            double strength);

}  // namespace haarmony::curve
