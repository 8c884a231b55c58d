// The lists that a collection answers with, against a committed file.
//
// A change of a list is a change of what users see: make the file anew by running this test
// with HAARMONY_UPDATE_GOLDEN=1, and say in the commit why the lists changed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "engine/image/index.h"
#include "engine/image/profile.h"
#include "tests/eval/degrade.h"
#include "tests/golden/scenes.h"

namespace haarmony::golden {
namespace {

constexpr int kScenes = 300;
constexpr int kQueryStep = 25;

std::string line_of(const image::IndexSnapshot& snapshot,
                    const std::string& label,
                    const eval::RgbPicture& picture,
                    const std::string& profile_name) {
    const image::Profile profile = *image::built_in_profile(profile_name);
    const image::Query query =
        image::make_query(image::make_signature(picture.view()), profile, profile.m);
    std::ostringstream line;
    line << label << ' ' << profile_name << ':';
    for (const image::Match& match : snapshot.search(query, {20}).matches) {
        line << ' ' << to_int(match.id) << '/' << match.score;
    }
    line << '\n';
    return std::move(line).str();
}

std::string all_lines() {
    std::vector<image::Record> records;
    for (int number = 1; number <= kScenes; ++number) {
        records.push_back({ImageId{number}, image::make_signature(scene(number).view())});
    }
    image::Index index{image::IndexOptions{}};
    index.apply(records, {});
    const auto snapshot = index.snapshot();
    std::string lines;
    for (int number = kQueryStep; number <= kScenes; number += kQueryStep) {
        const eval::RgbPicture target = scene(number);
        const std::string label = std::to_string(number);
        lines += line_of(*snapshot, label + " copy", eval::poor_copy(target), "scanned");
        lines +=
            line_of(*snapshot, label + " mosaic", eval::mosaic(target, 8), "painted");
    }
    return lines;
}

TEST(Golden, TopTwentyListsAreTheCommittedOnes) {
    const std::string path = std::string(HAARMONY_GOLDEN_DIR) + "/top_20.txt";
    const std::string lines = all_lines();
    if (std::getenv("HAARMONY_UPDATE_GOLDEN") != nullptr) {
        std::ofstream(path) << lines;
    }
    std::ifstream file(path);
    std::ostringstream committed;
    committed << file.rdbuf();
    EXPECT_EQ(lines, committed.str());
}

TEST(Golden, EveryQueryOfTheFileFindsItsTargetFirst) {
    std::istringstream lines(all_lines());
    std::string line;
    int checked = 0;
    while (std::getline(lines, line)) {
        const std::string target = line.substr(0, line.find(' '));
        EXPECT_EQ(line.find(": " + target + "/"), line.find(": ")) << line;
        ++checked;
    }
    EXPECT_EQ(checked, 2 * kScenes / kQueryStep);
}

}  // namespace
}  // namespace haarmony::golden
