#include "engine/curve/multires_curve.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <span>

#include "engine/curve/filter_bank.h"
#include "engine/curve/with_dimension.h"

namespace haarmony::curve {
namespace {

void analyze_rows(const double* control,
                  int level,
                  Ends ends,
                  int dimension,
                  double* coarse,
                  double* details) {
    with_dimension(dimension, [&](auto constant) {
        constexpr int kDimension = decltype(constant)::value;
        filter_bank::analyze_level<kDimension>(control, level, ends, coarse, details);
    });
}

void synthesize_rows(std::span<const double> coarse,
                     std::span<const double> details,
                     int level,
                     Ends ends,
                     int dimension,
                     double* control) {
    with_dimension(dimension, [&](auto constant) {
        constexpr int kDimension = decltype(constant)::value;
        if (details.empty()) {
            filter_bank::synthesize_level<kDimension, false>(
                coarse.data(), details.data(), level, ends, control);
        } else {
            filter_bank::synthesize_level<kDimension, true>(
                coarse.data(), details.data(), level, ends, control);
        }
    });
}

int known_level(const Points& control, Ends ends) {
    const std::optional<int> level = level_of(control.size(), ends);
    assert(level);
    return *level;
}

}  // namespace

AnalysisStep analyze(const Points& control, Ends ends) {
    const int level = known_level(control, ends);
    assert(level >= 1);
    AnalysisStep step{Points(control_count(level - 1, ends), control.dimension()),
                      Points(segment_count(level - 1), control.dimension())};
    analyze_rows(control.numbers().data(),
                 level,
                 ends,
                 control.dimension(),
                 step.coarse.numbers().data(),
                 step.detail.numbers().data());
    return step;
}

Points synthesize(const Points& coarse, const Points& detail, Ends ends) {
    const int level = known_level(coarse, ends) + 1;
    assert(detail.empty() || (detail.size() == segment_count(level - 1) &&
                              detail.dimension() == coarse.dimension()));
    Points control(control_count(level, ends), coarse.dimension());
    synthesize_rows(coarse.numbers(),
                    detail.numbers(),
                    level,
                    ends,
                    coarse.dimension(),
                    control.numbers().data());
    return control;
}

MultiresCurve decompose(const Points& control, Ends ends) {
    const int level = known_level(control, ends);
    const int dimension = control.dimension();
    MultiresCurve curve;
    curve.ends = ends;
    curve.details.resize(std::size_t(level));
    // Each C^j takes the place of the one before.
    Points sweep = control;
    for (int j = level; j >= 1; --j) {
        Points& detail = curve.details[std::size_t(j - 1)];
        detail = Points(segment_count(j - 1), dimension);
        double* const rows = sweep.numbers().data();
        analyze_rows(rows, j, ends, dimension, rows, detail.numbers().data());
    }
    curve.coarse = Points(control_count(0, ends), dimension);
    std::copy_n(sweep.numbers().begin(),
                curve.coarse.numbers().size(),
                curve.coarse.numbers().begin());
    return curve;
}

Points reconstruct(const MultiresCurve& curve, int level) {
    assert(0 <= level && level <= curve.level());
    if (level == 0) return curve.coarse;
    const int dimension = curve.coarse.dimension();
    // By turns into one and the other, the last time into `control`.
    Points control(control_count(level, curve.ends), dimension);
    Points other(control_count(level - 1, curve.ends), dimension);
    std::span<const double> sweep = curve.coarse.numbers();
    for (int j = 1; j <= level; ++j) {
        Points& next = (level - j) % 2 == 0 ? control : other;
        synthesize_rows(sweep,
                        curve.details[std::size_t(j - 1)].numbers(),
                        j,
                        curve.ends,
                        dimension,
                        next.numbers().data());
        sweep = next.numbers();
    }
    return control;
}

}  // namespace haarmony::curve
