#include "ingest/gallery/field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace haarmony::gallery {
namespace {

TEST(Field, IsExactForWhatIsLinear) {
    const auto plane = [](Point p) { return 2 * p.x - 3 * p.y + 0.5; };
    // Sides that are no multiples of the pitch.
    const Frame frame{50, 31};
    const Field field(frame, 1, plane);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            ASSERT_NEAR(field.at(x, y), plane({(x + 0.5) / 31, (y + 0.5) / 31}), 1e-6)
                << x << ", " << y;
}

TEST(Field, IsCloseForWhatIsSmooth) {
    const auto swell = [](Point p) { return std::sin(5 * p.x) * std::cos(4 * p.y); };
    const Frame frame{160, 120};
    const Field field(frame, 1, swell);
    // A straight line misses a curve by an eighth of its bend times the pitch squared.
    const double pitch = static_cast<double>(Field::kPitch) / frame.height;
    const double bound = pitch * pitch / 8 * (5 * 5 + 4 * 4);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            ASSERT_NEAR(
                field.at(x, y), swell({(x + 0.5) / 120, (y + 0.5) / 120}), bound + 1e-6);
}

TEST(Field, CallsOnlyForRowsThatAreWanted) {
    const Frame frame{30, 300};
    int calls = 0;
    double lowest = 0;
    const Field field(frame, 0.5, [&](Point p) {
        ++calls;
        lowest = p.y > lowest ? p.y : lowest;
        return p.y;
    });
    EXPECT_EQ(calls, 12 * 52);
    EXPECT_LT(lowest, 0.53);
    EXPECT_NEAR(field.at(29, 149), 149.5 / 300, 1e-6);
}

}  // namespace
}  // namespace haarmony::gallery
