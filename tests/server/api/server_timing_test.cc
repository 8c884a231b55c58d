#include "server/api/server_timing.h"

#include <gtest/gtest.h>

namespace haarmony::server {
namespace {

using std::chrono::hours;
using std::chrono::nanoseconds;

TEST(ServerTiming, PartsAreMillisecondsInTheirOrder) {
    EXPECT_EQ(server_timing({}), "");
    EXPECT_EQ(server_timing({{"search", nanoseconds(1'204'400)}}), "search;dur=1.204");
    EXPECT_EQ(server_timing({{"decode", nanoseconds(0)},
                             {"draw", nanoseconds(80'000)},
                             {"encode", hours(24)}}),
              "decode;dur=0.000, draw;dur=0.080, encode;dur=86400000.000");
}

}  // namespace
}  // namespace haarmony::server
