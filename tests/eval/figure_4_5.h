// Figure 4.5: which colour space, decomposition, number of coefficients and bin rule find
// the most, for each kind of query; with the weights of the built-in profile and with
// weights fitted for the combination itself.
//
// Weights are fitted on one set of queries, combinations are compared on a second one, and
// what wins there is measured once more on the queries of the other figures.
//
// Errors  kInvalidArgument where the trainer refuses the pairs.
// Source  sec. 4.5.1, Figure 4.5; sec. 4.6 for L*a*b* and L*u*v*.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/image/profile.h"
#include "tests/eval/csv.h"
#include "tests/eval/experiment.h"
#include "tests/eval/statistics.h"

namespace haarmony::eval {

// Every colour space with both decompositions.
[[nodiscard]] const std::vector<image::SignatureKind>& all_kinds();

struct ChoicePoint {
    QueryKind query{};
    image::Profile profile;
    bool fitted = false;  // or the built-in weights
    RankSummary summary;  // of the selection queries
};

struct Winner {
    QueryKind query{};
    std::string among;  // what it won against
    image::Profile profile;
    bool fitted = false;
    RankSummary selection;
    RankSummary evaluation;
};

struct Figure45 {
    std::vector<ChoicePoint> points;
    std::vector<Winner> winners;
};

// Of two results the better one: more in the top 1 %, then more at rank 1, then the larger
// mean reciprocal rank, then fewer coefficients.
[[nodiscard]] bool is_better(const ChoicePoint& a, const ChoicePoint& b);

// `ms`: the numbers of coefficients to try, each 1..kMaxCoefficients.
// Requires: the database has signatures of all_kinds(). Without enough pictures to train
// with there are no fitted weights.
[[nodiscard]] Result<Figure45> measure_figure_4_5(const Experiment& experiment,
                                                  const std::vector<int>& ms);

[[nodiscard]] CsvTable to_csv(const Figure45& figure);
[[nodiscard]] CsvTable winners_csv(const Figure45& figure);
[[nodiscard]] std::string to_html(const Figure45& figure);
// The table that the page ends with.
[[nodiscard]] std::string winners_html(const Figure45& figure);

}  // namespace haarmony::eval
