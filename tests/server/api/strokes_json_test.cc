#include "server/api/strokes_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

namespace haarmony::server {
namespace {

using nlohmann::json;

json drawing() {
    return json::parse(
        R"({"width": 400, "height": 300, "background": "#0a0B0c", "items": [
        {"points": [[1, 2.5], [-3, 4e2]], "width": 7, "color": "#ff8000"},
        {"points": [[0, 0], [9, 9], [0, 9]], "width": [1, 2, 3], "color": "#000000"},
        {"points": [[0, 0], [9, 9], [0, 9]], "fill": true, "color": "#ffffff"}]})");
}

TEST(StrokesJson, ReadsEveryMember) {
    auto parsed = parse_strokes(drawing());
    ASSERT_TRUE(parsed);
    EXPECT_EQ(parsed->width, 400);
    EXPECT_EQ(parsed->height, 300);
    EXPECT_EQ(parsed->background, (image::Rgb{10, 11, 12}));
    ASSERT_EQ(parsed->items.size(), 3U);
    const image::Stroke& line = parsed->items[0];
    EXPECT_EQ(line.color, (image::Rgb{255, 128, 0}));
    EXPECT_FALSE(line.fill);
    EXPECT_EQ(line.widths, std::vector<float>{7});
    ASSERT_EQ(line.points.size(), 2U);
    EXPECT_EQ(line.points[0].y, 2.5F);
    EXPECT_EQ(line.points[1].x, -3.0F);
    EXPECT_EQ(line.points[1].y, 400.0F);
    EXPECT_EQ(parsed->items[1].widths, (std::vector<float>{1, 2, 3}));
    EXPECT_TRUE(parsed->items[2].fill);
    EXPECT_TRUE(parsed->items[2].widths.empty());
}

TEST(StrokesJson, BackgroundMayBeUnpainted) {
    for (json value : {drawing(), drawing()}) {
        value["background"] = nullptr;
        EXPECT_FALSE(parse_strokes(value)->background);
    }
    json absent = drawing();
    absent.erase("background");
    EXPECT_FALSE(parse_strokes(absent)->background);
    json only_background = drawing();
    only_background["items"] = json::array();
    EXPECT_TRUE(parse_strokes(only_background));
}

TEST(StrokesJson, NamesThePlaceOfWhatIsWrong) {
    json too_many = json::array();
    for (int i = 0; i <= image::kMaxStrokePoints; ++i) too_many.push_back({0, 0});
    // Where, the new value (null: the member goes), status, param.
    using Case = std::tuple<std::string, json, int, std::string>;
    const std::vector<Case> cases{
        {"/width", nullptr, 400, "strokes.width"},
        {"/width", 0, 400, "strokes.width"},
        {"/width", 65536, 400, "strokes.width"},
        {"/width", 10.5, 400, "strokes.width"},
        {"/height", "300", 400, "strokes.height"},
        {"/background", "red", 400, "strokes.background"},
        {"/background", "#12345g", 400, "strokes.background"},
        {"/background", "#-1-1-1", 400, "strokes.background"},
        {"/background", 7, 400, "strokes.background"},
        {"/colour", "#000000", 400, "strokes.colour"},
        {"/items", nullptr, 400, "strokes.items"},
        {"/items", json::object(), 400, "strokes.items"},
        {"/items/1", 5, 400, "strokes.items[1]"},
        {"/items/1/color", nullptr, 400, "strokes.items[1].color"},
        {"/items/1/fill", "yes", 400, "strokes.items[1].fill"},
        {"/items/1/brush", 1, 400, "strokes.items[1].brush"},
        {"/items/1/points", nullptr, 400, "strokes.items[1].points"},
        {"/items/1/points", json::array(), 422, "strokes.items[1].points"},
        {"/items/1/points", {{1, 2}, {3}}, 400, "strokes.items[1].points"},
        {"/items/1/points", {{1, 2}, {3, "4"}}, 400, "strokes.items[1].points"},
        {"/items/1/points", {{1, 2}, {3, 1e9}}, 400, "strokes.items[1].points"},
        {"/items/1/points", too_many, 413, "strokes"},
        {"/items/1/width", nullptr, 400, "strokes.items[1].width"},
        {"/items/1/width", -1, 400, "strokes.items[1].width"},
        {"/items/1/width", {1, 2}, 400, "strokes.items[1].width"},
        {"/items/1/width", json::array(), 400, "strokes.items[1].width"},
        {"/items/1/width", {1, 2, nullptr}, 400, "strokes.items[1].width"},
    };
    for (const auto& [where, value, status, param] : cases) {
        SCOPED_TRACE(where + " = " + value.dump().substr(0, 60));
        json changed = drawing();
        const json::json_pointer pointer(where);
        changed[pointer] = value;
        if (value.is_null()) changed[pointer.parent_pointer()].erase(pointer.back());
        auto refused = parse_strokes(changed);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.problem().status, status);
        EXPECT_EQ(refused.problem().param, param);
    }
}

TEST(StrokesJson, NothingPaintedIsImpossible) {
    auto refused = parse_strokes({{"width", 4}, {"height", 3}, {"items", json::array()}});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.problem().status, 422);
    EXPECT_EQ(refused.problem().code, "nothing_painted");
    EXPECT_EQ(parse_strokes(json("drawing")).problem().param, "strokes");
}

}  // namespace
}  // namespace haarmony::server
