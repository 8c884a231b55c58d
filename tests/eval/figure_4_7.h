// Figure 4.7: how much scaling, turning, moving and recolouring each metric stands.
//
// 100 pictures, the same ones at every strength, in the same random direction: a curve falls
// because the strength rises and for no other reason. What a move or a turn leaves undefined
// is the picture's average colour; colours are clamped.
// The upper row distorts the targets themselves; the lower row distorts simulated scanned
// and painted queries, under L^q alone.
//
// Units   scale 1..2, rotation 0..45 degrees, translation 0..0.5 widths, colour shift 0..1;
//         all four in that order, their strengths rising together.
// Source  sec. 4.5.3, Figure 4.7.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/eval/csv.h"
#include "tests/eval/experiment.h"
#include "tests/eval/ranking.h"
#include "tests/eval/statistics.h"

namespace haarmony::eval {

enum class Effect { kScale, kRotation, kTranslation, kColourShift, kAll };
inline constexpr std::array kEffects = {Effect::kScale,
                                        Effect::kRotation,
                                        Effect::kTranslation,
                                        Effect::kColourShift,
                                        Effect::kAll};
[[nodiscard]] std::string effect_name(Effect effect);

// What the figure's axis says.
[[nodiscard]] std::string axis_label(Effect effect);

// The value on the figure's axis at a strength in [0, 1]; for kAll the strength itself.
[[nodiscard]] double effect_value(Effect effect, double strength);

// Requires: 0 <= strength <= 1. Draws the same random numbers at every strength.
[[nodiscard]] RgbPicture distort(const RgbPicture& picture,
                                 Effect effect,
                                 double strength,
                                 Random& random);

// One point of one curve.
struct DistortionPoint {
    Effect effect{};
    double value = 0;
    std::string query;  // "target", "scanned" or "painted"
    MetricName name;
    std::string profile;
    RankSummary summary;
};

struct Figure47 {
    std::vector<DistortionPoint> points;
};

// Each effect at `steps` even strengths from none to the most. Requires: steps >= 2.
[[nodiscard]] Figure47 measure_figure_4_7(const Experiment& experiment,
                                          const MetricPanel& panel,
                                          int steps);

[[nodiscard]] CsvTable to_csv(const Figure47& figure);
[[nodiscard]] std::string to_html(const Figure47& figure);

}  // namespace haarmony::eval
