#include "tests/eval/csv.h"

#include <gtest/gtest.h>

#include <limits>

namespace haarmony::eval {
namespace {

TEST(Csv, HasAHeaderAndOneLineARow) {
    CsvTable table({"name", "share", "count"});
    table.add({"L^q", 0.25, 7});
    table.add({std::string("L1"), 100.0, std::int64_t{-3}});
    EXPECT_EQ(table.text(), "name,share,count\nL^q,0.25,7\nL1,100,-3\n");
}

TEST(Csv, QuotesWhatWouldBreakTheWidth) {
    CsvTable table({"a", "b"});
    table.add({"one, two", "say \"hi\""});
    table.add({"line\nbreak", ""});
    EXPECT_EQ(table.text(), "a,b\n\"one, two\",\"say \"\"hi\"\"\"\n\"line\nbreak\",\n");
}

TEST(Csv, NumbersHaveNoNeedlessZeros) {
    EXPECT_EQ(number(0, 6), "0");
    EXPECT_EQ(number(-0.0000001, 6), "0");
    EXPECT_EQ(number(100, 0), "100");
    EXPECT_EQ(number(2.0 / 3, 3), "0.667");
    EXPECT_EQ(number(97.50, 1), "97.5");
    EXPECT_EQ(number(1e300, 0).size(), 301U);
}

TEST(Csv, NumbersOfAnySizeHaveAPowerOfTen) {
    EXPECT_EQ(scientific(0, 1), "0.0e+00");
    EXPECT_EQ(scientific(2.13e-13, 1), "2.1e-13");
    EXPECT_EQ(scientific(-12345, 3), "-1.234e+04");
    EXPECT_EQ(scientific(-std::numeric_limits<double>::max(), 9).size(), 17U);
}

TEST(CsvDeathTest, RefusesARowOfAnotherWidthAndWhatIsNotFinite) {
    CsvTable table({"a", "b"});
    EXPECT_DEBUG_DEATH(table.add({"only one"}), "width");
    EXPECT_DEBUG_DEATH((void)number(std::numeric_limits<double>::quiet_NaN(), 2),
                       "isfinite");
    EXPECT_DEBUG_DEATH((void)number(std::numeric_limits<double>::infinity(), 2),
                       "isfinite");
}

}  // namespace
}  // namespace haarmony::eval
