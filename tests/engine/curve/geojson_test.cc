#include "engine/curve/geojson.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/curve/bspline.h"
#include "engine/curve/plane_cubic.h"
#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

using Json = nlohmann::json;

Approximation approximated(Ends ends, double tolerance, Joining joining) {
    return approximate(
               drawn_stroke({.level = 6, .ends = ends}), ends, tolerance, joining, {})
        .value();
}

// Lines as cubics, so that they can be measured like curves.
Points lines_of(const Json& positions) {
    Points rows(4 * (positions.size() - 1), 2);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t d = 0; d < 2; ++d) {
            const double from = positions[i / 4][d];
            const double to = positions[i / 4 + 1][d];
            rows[i][d] = from + (to - from) * double(i % 4) / 3;
        }
    }
    return rows;
}

TEST(GeoJson, LinesAreAsCloseAsPromised) {
    const double tolerance = 2;
    const double flatness = kFlatnessShare * tolerance;
    const Approximation a = approximated(Ends::kOpen, tolerance - flatness, Joining::kG1);
    const auto text = geojson(a, flatness);
    ASSERT_TRUE(text);
    const Json feature = Json::parse(*text);
    EXPECT_EQ(feature["type"], "Feature");
    EXPECT_EQ(feature["geometry"]["type"], "LineString");
    const Points lines = lines_of(feature["geometry"]["coordinates"]);
    EXPECT_LE(sampled_hausdorff(lines, a.bezier, 40),
              flatness + std::max(widest_gap(lines, 40), widest_gap(a.bezier, 40)));
    const Json& properties = feature["properties"];
    EXPECT_DOUBLE_EQ(properties["tolerance"], tolerance);
    EXPECT_DOUBLE_EQ(properties["bound"], a.bound + flatness);
    EXPECT_DOUBLE_EQ(properties["max_error"], a.max_error + flatness);
    EXPECT_EQ(properties["flatness"], flatness);
    EXPECT_EQ(properties["count"], a.count());
    EXPECT_EQ(properties["possible"], 64);
}

TEST(GeoJson, ChordsStayWithinTheFlatnessAtEqualParameters) {
    const Approximation a = approximated(Ends::kOpen, 1, Joining::kC0);
    for (const double flatness : {10.0, 0.5, 0.01}) {
        const Json feature = Json::parse(geojson(a, flatness).value());
        const Json& positions = feature["geometry"]["coordinates"];
        // Each segment's chords are found by its end.
        std::size_t from = 0;
        for (std::size_t i = 0; i < a.count(); ++i) {
            const PlaneVector end = in_plane(a.bezier[4 * i + 3]);
            std::size_t to = from + 1;
            while (PlaneVector{positions[to][0], positions[to][1]} != end) ++to;
            const double chords = double(to - from);
            for (std::size_t k = from; k < to; ++k) {
                const PlaneVector p{positions[k][0], positions[k][1]};
                const PlaneVector q{positions[k + 1][0], positions[k + 1][1]};
                const double t = (double(k - from) + 0.5) / chords;
                const PlaneVector on = in_plane(bernstein_sum(a.bezier, 4 * i, t));
                EXPECT_LE(norm(on - between(p, q, 0.5)), flatness * (1 + 1e-9));
            }
            from = to;
        }
        EXPECT_EQ(from + 1, positions.size());
    }
}

TEST(GeoJson, SegmentsThatDoNotMeetAreLinesOfTheirOwn) {
    const Approximation a = approximated(Ends::kOpen, 3, Joining::kDyadic);
    const Json feature = Json::parse(geojson(a, 0.1).value());
    EXPECT_EQ(feature["geometry"]["type"], "MultiLineString");
    std::size_t lines = 1;
    for (std::size_t i = 1; i < a.count(); ++i) {
        lines += in_plane(a.bezier[4 * i]) != in_plane(a.bezier[4 * i - 1]) ? 1 : 0;
    }
    ASSERT_GT(lines, 1U);
    EXPECT_EQ(feature["geometry"]["coordinates"].size(), lines);
}

TEST(GeoJson, OfAClosedCurveComesBack) {
    const Approximation a = approximated(Ends::kClosed, 1, Joining::kG1);
    const Json feature = Json::parse(geojson(a, 0.1).value());
    const Json& positions = feature["geometry"]["coordinates"];
    EXPECT_EQ(positions.front(), positions.back());
}

TEST(GeoJson, RefusesMorePositionsThanItMayHave) {
    const Approximation a = approximated(Ends::kOpen, 1, Joining::kG1);
    const auto text = geojson(a, 1e-13);
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().code, ErrorCode::kTooLarge);
    EXPECT_EQ(text.error().param, "tolerance");
    EXPECT_NE(text.error().message.find("1e-13"), std::string::npos);
    EXPECT_NE(text.error().message.find("1000000"), std::string::npos);
}

}  // namespace
}  // namespace haarmony::curve
