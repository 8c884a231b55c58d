// Plants from rewritten strings (L-systems) and a turtle that draws them.
//
// Alphabet  F forward, + - turn, [ ] remember and return, L a leaf, * a blossom; every
//           other symbol only takes part in rewriting.
// Units     Points in picture heights; angles in radians, 0 = upwards.
// Threads   const-safe.
// Source    Prusinkiewicz, Lindenmayer: The Algorithmic Beauty of Plants (1990), ch. 1.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ingest/gallery/coverage.h"
#include "ingest/gallery/random.h"

namespace haarmony::gallery {

struct Rule {
    char symbol;
    std::vector<std::string> successors;  // one is chosen at random each time
};

struct Grammar {
    std::string axiom;
    std::vector<Rule> rules;
};

// Every symbol that has a rule is replaced, `generations` times; growth stops early when
// the string would pass `limit` symbols.
[[nodiscard]] std::string rewrite(const Grammar& grammar,
                                  int generations,
                                  std::size_t limit,
                                  Random& random);

struct Twig {
    Point from;
    Point to;
    int depth = 0;   // brackets that are open
    double age = 0;  // 0 at the foot .. 1 at the last symbol
};

struct Bud {
    Point at;
    double heading = 0;
    bool blossom = false;
};

struct Plant {
    std::vector<Twig> twigs;
    std::vector<Bud> buds;
};

struct Turtle {
    double angle = 0.4;  // of + and -
    double wander = 0;   // deviation added to every turn
    double shrink = 1;   // length of a step for each open bracket
    double lift = 0;     // how much headings bend back upwards in a step
};

// The plant stands at (0, 0) and reaches as far as its string says in steps of length 1;
// y is negative above the ground.
[[nodiscard]] Plant grow(std::string_view symbols, const Turtle& turtle, Random& random);

// Moved and scaled, so that it stands at `foot` and fits a box of `width` and `height`.
[[nodiscard]] Plant fitted(const Plant& plant, Point foot, double width, double height);

}  // namespace haarmony::gallery
