#include "engine/image/canvas.h"

#include <gtest/gtest.h>

#include <vector>

namespace haarmony::image {
namespace {

std::vector<int> flushed(RowCover& row, int width) {
    std::vector<int> cover(std::size_t(width), 0);
    row.flush([&](std::size_t x, int value) { cover[x] = value; });
    return cover;
}

TEST(RowCover, CountsTheSharesOfPixels) {
    RowCover row(5);
    row.add({0.5, 3.25});
    EXPECT_EQ(flushed(row, 5), (std::vector<int>{128, 256, 256, 64, 0}));
    row.add({1.25, 1.75});
    EXPECT_EQ(flushed(row, 5), (std::vector<int>{0, 128, 0, 0, 0}));
}

TEST(RowCover, IsFullAfterAllLinesAndNeverMore) {
    RowCover row(3);
    for (int line = 0; line < kSubRows; ++line) row.add({-1e30, 1e30});
    EXPECT_EQ(flushed(row, 3), std::vector<int>(3, kFullCover));
}

TEST(RowCover, IgnoresWhatLiesBeside) {
    RowCover row(3);
    row.add({-9, -2});
    row.add({3, 1e12});
    EXPECT_EQ(flushed(row, 3), std::vector<int>(3, 0));
}

TEST(Canvas, StartsTransparentOrInTheBackgroundColor) {
    EXPECT_EQ(Canvas(1, 1, std::nullopt).straight(), std::vector<std::uint8_t>(4, 0));
    EXPECT_EQ(Canvas(1, 1, Rgb{1, 2, 3}).straight(),
              (std::vector<std::uint8_t>{1, 2, 3, 255}));
}

TEST(Canvas, KeepsTheColorOfWhatIsHalfCovered) {
    Canvas canvas(2, 1, std::nullopt);
    canvas.paint(1, 0, Rgb{10, 200, 255}, kFullCover / 2);
    EXPECT_EQ(canvas.straight(),
              (std::vector<std::uint8_t>{0, 0, 0, 0, 10, 200, 255, 128}));
}

TEST(Canvas, MixesLaterLayersOver) {
    Canvas canvas(1, 1, Rgb{0, 0, 0});
    canvas.paint(0, 0, Rgb{255, 255, 255}, kFullCover / 2);
    EXPECT_EQ(canvas.straight(), (std::vector<std::uint8_t>{128, 128, 128, 255}));
    canvas.paint(0, 0, Rgb{7, 8, 9}, kFullCover);
    EXPECT_EQ(canvas.straight(), (std::vector<std::uint8_t>{7, 8, 9, 255}));
}

}  // namespace
}  // namespace haarmony::image
