#include "tests/eval/search_options.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/eval/distortions.h"
#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

const SearchOption& option(const std::string& name) {
    return *std::ranges::find(search_options(), name, &SearchOption::name);
}

class SearchOptions : public ::testing::Test {
  protected:
    [[nodiscard]] std::int64_t rank(const char* name, const RgbPicture& query) const {
        const SearchOption& asked = option(name);
        return rank_with(
            asked, asked.ways(query.view(), search_.kind()), search_, profile_, 5);
    }

    InlineExecutor executor_;
    Database database_ =
        make_database(generated_pictures(30), {image::SignatureKind{}}, executor_)
            .value();
    WaveletSearch search_{database_, image::SignatureKind{}};
    image::Profile profile_ = *image::built_in_profile("scanned");
};

TEST_F(SearchOptions, MirroredAndTurnedPicturesAreFoundWithOrientations) {
    const RgbPicture picture = generated_picture(5);
    EXPECT_EQ(rank("orientations=mirror", mirror(picture)), 1);
    EXPECT_EQ(rank("orientations=all", mirror(picture)), 1);
    EXPECT_EQ(rank("orientations=all", turn(picture)), 1);
    EXPECT_EQ(rank("orientations=all", turn(mirror(picture))), 1);
}

TEST_F(SearchOptions, FramedPicturesAreFoundWithAutocrop) {
    const RgbPicture picture = generated_picture(5);
    EXPECT_EQ(rank("autocrop", frame(picture, 0.1, 0.1, 255)), 1);
    EXPECT_EQ(rank("autocrop", frame(picture, 0.3, 0.3, 0)), 1);
    EXPECT_EQ(rank("autocrop", picture), 1);
}

TEST_F(SearchOptions, CutOutPartsAreFoundWithPartial) {
    const RgbPicture picture = generated_picture(5);
    EXPECT_EQ(rank("partial", picture), 1);
    EXPECT_EQ(rank("partial", crop(picture, 0.1)), 1);
    EXPECT_EQ(rank("partial", crop(picture, 0.2)), 1);
}

TEST_F(SearchOptions, EachIsMeantForRowsOfTheTable) {
    for (const SearchOption& each : search_options()) {
        EXPECT_FALSE(each.distortions.empty()) << each.name;
        for (const std::string& name : each.distortions)
            EXPECT_EQ(distortion(name).name, name);
    }
}

}  // namespace
}  // namespace haarmony::eval
