#include "tests/eval/plot_svg.h"

#include <gtest/gtest.h>

#include "tests/eval/test/xml_reader.h"

namespace haarmony::eval {
namespace {

Plot two_lines() {
    return {
        "a < b & c",
        {"x", 0, 10},
        {"y", 0, 100},
        {{"first", {0, 0}, {{0, 0}, {10, 100}}, true, false},
         {"second \"quoted\"", {1, 1}, {{0, 50, 40, 60}, {5, 60, 55, 70}}, true, true}}};
}

TEST(PlotSvg, IsWellFormedWithEveryLineAndMark) {
    const XmlReading reading = read_xml(to_svg(two_lines()));
    EXPECT_EQ(reading.error, "");
    EXPECT_EQ(reading.elements.at("svg"), 1);
    EXPECT_EQ(reading.elements.at("polyline"), 2);
    EXPECT_EQ(reading.elements.at("circle"), 2);
    EXPECT_EQ(reading.elements.at("polygon"), 3);  // two marks and the band
    EXPECT_EQ(reading.elements.at("title"), 4);
}

TEST(PlotSvg, PointsLieBetweenTheAxes) {
    const XmlReading reading = read_xml(to_svg(two_lines()));
    EXPECT_EQ(reading.attributes.at("points").at(1), "48,222 350,30");
}

TEST(PlotSvg, WhatLeavesTheAxesIsDrawnAtTheirEnds) {
    Plot plot = two_lines();
    plot.series.resize(1);
    plot.series[0].points = {{-5, -20}, {99, 400}};
    EXPECT_EQ(read_xml(to_svg(plot)).attributes.at("points").at(0), "48,222 350,30");
}

TEST(PlotSvg, LogarithmicAxesHaveEvenDecades) {
    Plot plot = two_lines();
    plot.series.resize(1);
    plot.x = {"x", 0.1, 1000, true};
    plot.series[0].points = {{0.1, 0}, {10, 0}, {1000, 0}};
    EXPECT_EQ(read_xml(to_svg(plot)).attributes.at("points").at(0),
              "48,222 199,222 350,222");
}

TEST(PlotSvg, ASeriesWithoutPointsIsNoLine) {
    Plot plot = two_lines();
    plot.series[0].points.clear();
    EXPECT_EQ(read_xml(to_svg(plot)).elements.at("polyline"), 1);
}

TEST(Ticks, AreRoundAndInside) {
    EXPECT_EQ(ticks({"", 0, 100}), (std::vector<double>{0, 20, 40, 60, 80, 100}));
    EXPECT_EQ(ticks({"", 0, 45}), (std::vector<double>{0, 10, 20, 30, 40}));
    EXPECT_EQ(ticks({"", 0, 900}), (std::vector<double>{0, 200, 400, 600, 800}));
    EXPECT_EQ(ticks({"", 0.1, 100, true}).size(), 4U);
    EXPECT_EQ(ticks({"", 0.11, 100, true}).size(), 3U);
    for (double high = 0.013; high < 1e6; high *= 1.7) {
        const auto values = ticks({"", 0, high});
        EXPECT_GE(values.size(), 4U) << high;
        EXPECT_LE(values.size(), 11U) << high;
        EXPECT_LE(values.back(), high * (1 + 1e-6)) << high;
    }
}

TEST(Legend, NamesEachLineOnce) {
    const XmlReading reading = read_xml(legend({two_lines(), two_lines()}));
    EXPECT_EQ(reading.error, "");
    EXPECT_EQ(reading.elements.at("li"), 2);
}

}  // namespace
}  // namespace haarmony::eval
