#include "engine/curve/geojson.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "engine/curve/bezier_text.h"
#include "engine/curve/number_text.h"
#include "engine/curve/plane_cubic.h"

namespace haarmony::curve {
namespace {

// Chords of equal t that are within `flatness`: a chord over h is within h^2 / 8 times the
// largest second derivative, which is 6 times the larger second difference.
double chords(const PlaneCubic& p, double flatness) {
    const double bend = 6 * std::max(norm((p[2] - p[1]) - (p[1] - p[0])),
                                     norm((p[3] - p[2]) - (p[2] - p[1])));
    return std::max(1.0, std::ceil(std::sqrt(bend / (8 * flatness))));
}

void append_position(std::string& text, PlaneVector p) {
    text += '[';
    append_number(text, p.x);
    text += ',';
    append_number(text, p.y);
    text += ']';
}

void append_property(std::string& text, const char* name, double value) {
    text += '"';
    text += name;
    text += "\":";
    append_number(text, value);
}

}  // namespace

Result<std::string> geojson(const Approximation& approximation, double flatness) {
    assert(flatness > 0 && approximation.count() > 0);
    const std::vector<PlaneCubic> cubics = cubics_of(approximation.bezier);
    double positions = 0;
    for (const PlaneCubic& cubic : cubics) positions += chords(cubic, flatness) + 1;
    if (!(positions <= static_cast<double>(kMostPositions))) {
        return Error{ErrorCode::kTooLarge,
                     "within " + number_text(flatness) + " of the curve takes " +
                         number_text(positions) + " positions, more than " +
                         std::to_string(kMostPositions),
                     "tolerance"};
    }
    const std::vector<std::size_t> starts = subpath_starts(approximation.bezier);
    const bool several = starts.size() > 1;
    std::string text = R"({"type":"Feature","properties":{)";
    append_property(text, "tolerance", approximation.tolerance + flatness);
    text += ',';
    append_property(text, "bound", approximation.bound + flatness);
    text += ',';
    append_property(text, "max_error", approximation.max_error + flatness);
    text += ',';
    append_property(text, "flatness", flatness);
    text += ",\"count\":" + std::to_string(approximation.count());
    text += ",\"possible\":" + std::to_string(approximation.possible);
    text += several ? R"(},"geometry":{"type":"MultiLineString","coordinates":[[)"
                    : R"(},"geometry":{"type":"LineString","coordinates":[)";
    auto start = starts.begin();
    for (std::size_t i = 0; i < cubics.size(); ++i) {
        if (start != starts.end() && *start == i) {
            if (i > 0) text += "],[";
            append_position(text, cubics[i][0]);
            ++start;
        }
        const PlanePolynomial polynomial(cubics[i]);
        const double count = chords(cubics[i], flatness);
        for (double k = 1; k <= count; ++k) {
            text += ',';
            append_position(text, k < count ? polynomial.value(k / count) : cubics[i][3]);
        }
    }
    text += several ? "]]}}" : "]}}";
    return text;
}

}  // namespace haarmony::curve
