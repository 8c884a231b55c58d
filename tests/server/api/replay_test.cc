// haarmony-eval replay: after how many strokes a painting finds its target.
#include "tests/eval/replay.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "engine/image/signature_codec.h"
#include "tests/server/app/collection.h"

namespace haarmony::eval {
namespace {

constexpr int kM = 20;
const image::Profile kPainted = *image::built_in_profile("painted");

image::Stroke block(float left, float top, float side, image::Rgb color) {
    image::Stroke stroke;
    stroke.points = {
        {left, top}, {left + side, top}, {left + side, top + side}, {left, top + side}};
    stroke.color = color;
    stroke.fill = true;
    return stroke;
}

// Four squares; what is stored is the finished painting.
LoggedPainting four_squares() {
    LoggedPainting painting;
    painting.strokes.width = 64;
    painting.strokes.height = 64;
    painting.strokes.items = {block(0, 0, 32, {200, 30, 30}),
                              block(32, 0, 32, {30, 160, 60}),
                              block(0, 32, 32, {20, 60, 200}),
                              block(32, 32, 32, {240, 220, 90})};
    painting.target = ImageId{1};
    painting.seconds = 8;
    return painting;
}

image::Record record_of(std::int64_t id, const image::StrokePicture& strokes) {
    return {ImageId{id}, image::make_signature(image::rasterize(strokes).view())};
}

TEST(Replay, CountsTheStrokesUntilTheTargetIsFirst) {
    const LoggedPainting painting = four_squares();
    // Another picture is all red: until the second stroke it is nearer.
    image::StrokePicture red = painting.strokes;
    red.items = {block(0, 0, 64, {200, 30, 30})};
    image::Index index({.index_m = kM});
    index.apply(std::vector{record_of(1, painting.strokes), record_of(2, red)}, {});
    EXPECT_EQ(strokes_to_target(painting, *index.snapshot(), kPainted, kM, 1), 2);
    EXPECT_EQ(strokes_to_target(painting, *index.snapshot(), kPainted, kM, 2), 1);
}

TEST(Replay, ATargetThatIsNotThereIsNeverFound) {
    LoggedPainting painting = four_squares();
    image::Index index({.index_m = kM});
    index.apply(std::vector{record_of(1, painting.strokes)}, {});
    painting.target = ImageId{9};
    EXPECT_EQ(strokes_to_target(painting, *index.snapshot(), kPainted, kM, 20),
              std::nullopt);
}

TEST(Replay, DatabasesGrowAroundTheTargets) {
    const LoggedPainting painting = four_squares();
    std::vector<image::Record> pictures{record_of(1, painting.strokes)};
    for (int id = 2; id <= 41; ++id) {
        image::StrokePicture other = painting.strokes;
        const auto level = static_cast<std::uint8_t>(6 * id);
        other.items = {block(0, 0, 32.0F + static_cast<float>(id) / 2, {level, 90, 40})};
        pictures.push_back(record_of(id, other));
    }
    ReplayOptions options;
    options.databases = 4;
    const auto rows = replay(std::vector{painting}, pictures, kPainted, options);
    ASSERT_EQ(rows.size(), 4U);
    int before = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].pictures, 11 + 10 * static_cast<int>(i));
        ASSERT_EQ(rows[i].strokes.size(), 1U);
        // More pictures never bring the target up.
        ASSERT_TRUE(rows[i].strokes[0]);
        EXPECT_GE(*rows[i].strokes[0], before);
        before = *rows[i].strokes[0];
    }
}

TEST(Replay, ReadsWhatTheServiceLogged) {
    server::Collection collection;
    collection.open();
    for (unsigned number = 1; number <= 3; ++number) collection.add(number);
    ReplayOptions options;
    options.database = collection.path();
    std::ostringstream out;
    const auto nothing = replay_database(options, out);
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().code, ErrorCode::kNotFound);

    schema::NewFeedback feedback;
    feedback.kind = "painted";
    feedback.target = ImageId{2};
    feedback.seconds = 6;
    feedback.strokes =
        R"({"width":40,"height":30,"items":[{"points":[[1,2],[30,20]],"width":8,)"
        R"("color":"#c04020"}]})";
    const auto connection = server::beside(collection);
    ASSERT_TRUE(connection->feedback().add(feedback));
    options.databases = 1;
    ASSERT_TRUE(replay_database(options, out));
    // Of three pictures all are among the 20 best.
    EXPECT_EQ(out.str(),
              "1 paintings\n"
              "pictures  found  median strokes  median seconds\n"
              "       3      1             1.0             6.0\n");
}

TEST(Replay, SaysWhatIsMissing) {
    server::Collection collection;
    ReplayOptions options;
    options.database = collection.folder.file("none.db");
    std::ostringstream out;
    EXPECT_FALSE(replay_database(options, out));
    options.database = collection.path();
    options.profile = "crayon";
    const auto unknown = replay_database(options, out);
    ASSERT_FALSE(unknown);
    EXPECT_NE(unknown.error().message.find("crayon"), std::string::npos);
}

}  // namespace
}  // namespace haarmony::eval
