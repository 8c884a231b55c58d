#include "engine/image/window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "engine/image/best_of.h"
#include "engine/image/index.h"
#include "tests/engine/image/all_kinds.h"
#include "tests/engine/image/pictures.h"

namespace haarmony::image {
namespace {

Pixels part_of(const Pixels& picture, int left, int top, int width, int height) {
    Pixels part = flat(width, height, std::vector<std::uint8_t>(picture.channels));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < picture.channels; ++c) {
                part.at(x, y, c) = picture.at(x + left, y + top, c);
            }
        }
    }
    return part;
}

TEST(Placements, LieInTheCanvasOnceEachTheWholeFirst) {
    std::set<std::vector<int>> seen;
    for (const Placement& placement : placements()) {
        EXPECT_GE(placement.left, 0);
        EXPECT_GE(placement.top, 0);
        EXPECT_LE(placement.left + placement.side, 100);
        EXPECT_LE(placement.top + placement.side, 100);
        seen.insert({placement.left, placement.top, placement.side});
    }
    EXPECT_EQ(seen.size(), placements().size());
    EXPECT_EQ(placements().front(), Placement{});
}

// The canvas painted by hand, of a picture that is its own sampling.
TEST(WindowSignatures, AreThoseOfThePictureOnALargerCanvas) {
    const Pixels picture = scene(192, 192, 1);
    for (const SignatureKind& kind : all_kinds()) {
        const auto windows = window_signatures(picture.view(), kind);
        ASSERT_EQ(windows.size(), placements().size());
        EXPECT_EQ(windows[0].signature, make_signature(picture.view(), kind));
        for (std::size_t i = 1; i < windows.size(); ++i) {
            const Placement& placement = windows[i].placement;
            EXPECT_EQ(placement, placements()[i]);
            const int side = 192 * 100 / placement.side;
            Pixels canvas = noise(side, side, 4, 2);
            for (int y = 0; y < side; ++y) {
                for (int x = 0; x < side; ++x) {
                    const int left = x - placement.left * side / 100;
                    const int top = y - placement.top * side / 100;
                    const bool inside = left >= 0 && left < 192 && top >= 0 && top < 192;
                    canvas.at(x, y, 3) = inside ? 255 : 0;
                    for (int c = 0; c < 3 && inside; ++c) {
                        canvas.at(x, y, c) = picture.at(left, top, c);
                    }
                }
            }
            EXPECT_EQ(windows[i].signature, make_signature(canvas.view(), kind)) << i;
        }
    }
}

// Of whole samples there is nothing to choose: magnified pictures are the same.
TEST(WindowSignatures, DoNotDependOnTheSize) {
    const Pixels picture = scene(192, 192, 3);
    Pixels magnified = flat(576, 384, {0, 0, 0});
    for (int y = 0; y < magnified.height; ++y) {
        for (int x = 0; x < magnified.width; ++x) {
            for (int c = 0; c < 3; ++c)
                magnified.at(x, y, c) = picture.at(x / 3, y / 2, c);
        }
    }
    const auto expected = window_signatures(picture.view(), {});
    const auto windows = window_signatures(magnified.view(), {});
    for (std::size_t i = 0; i < windows.size(); ++i) {
        EXPECT_EQ(windows[i].signature, expected[i].signature) << i;
    }
}

TEST(WindowSignatures, OfGreyAndOfOpaqueAlphaAreThoseOfColor) {
    const Pixels grey = noise(50, 40, 1, 4);
    Pixels rgb = flat(50, 40, {0, 0, 0});
    Pixels rgba = flat(50, 40, {0, 0, 0, 255});
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 50; ++x) {
            for (int c = 0; c < 3; ++c) {
                rgb.at(x, y, c) = rgba.at(x, y, c) = grey.at(x, y, 0);
            }
        }
    }
    const auto expected = window_signatures(rgb.view(), {});
    const auto of_grey = window_signatures(grey.view(), {});
    const auto of_rgba = window_signatures(rgba.view(), {});
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(of_grey[i].signature, expected[i].signature) << i;
        EXPECT_EQ(of_rgba[i].signature, expected[i].signature) << i;
    }
}

TEST(WindowSignatures, OfOnePixelAreItsColor) {
    for (const WindowSignature& window :
         window_signatures(flat(1, 1, {10, 200, 90}).view(), {})) {
        EXPECT_EQ(window.signature, make_signature(flat(1, 1, {10, 200, 90}).view()));
    }
}

TEST(WithWeightSum, ScalesEveryWeightAndNothingElse) {
    const Profile profile = *built_in_profile("painted");
    Query query = make_query(make_signature(scene(90, 80, 5).view()), profile, profile.m);
    query.aspect_weight = 50;
    const Query doubled = with_weight_sum(query, 2 * query.weight_sum);
    EXPECT_EQ(doubled.weight_sum, 2 * query.weight_sum);
    EXPECT_EQ(doubled.aspect_weight, 100);
    EXPECT_EQ(doubled.average, query.average);
    EXPECT_EQ(doubled.m, query.m);
    ASSERT_EQ(doubled.terms.size(), query.terms.size());
    for (std::size_t i = 0; i < query.terms.size(); ++i) {
        EXPECT_EQ(doubled.terms[i].key, query.terms[i].key);
        EXPECT_EQ(doubled.terms[i].weight, 2 * query.terms[i].weight);
    }
    for (int c = 0; c < kChannels; ++c) {
        EXPECT_EQ(doubled.average_weight[c], 2 * query.average_weight[c]);
    }
}

TEST(WithWeightSum, IsOffByTheRoundingOfTheTermsAlone) {
    const Profile profile = *built_in_profile("scanned");
    const Query query =
        make_query(make_signature(scene(90, 80, 6).view()), profile, profile.m);
    for (const std::int64_t wanted :
         {std::int64_t{0}, query.weight_sum, std::int64_t{12345}}) {
        const Query scaled = with_weight_sum(query, wanted);
        std::int64_t sum = 0;
        for (const QueryTerm& term : scaled.terms) sum += term.weight;
        EXPECT_EQ(scaled.weight_sum, sum);
        EXPECT_LE(std::abs(2 * (sum - wanted)), std::int64_t(scaled.terms.size()))
            << wanted;
    }
}

TEST(WithWeightSum, LeavesAQueryWithoutCoefficients) {
    const Profile profile = *built_in_profile("painted");
    const Query query =
        make_query(make_signature(flat(2, 2, {9, 9, 9}).view()), profile, profile.m);
    const Query scaled = with_weight_sum(query, 1000);
    EXPECT_EQ(scaled.weight_sum, 0);
    EXPECT_EQ(scaled.average_weight, query.average_weight);
}

TEST(WithWeightSum, KeepsWeightsWithinTheirBound) {
    Query query;
    query.average_weight = {kMaxWeight, 1, 0};
    query.terms = {{7, 1}};
    query.weight_sum = 1;
    const Query scaled = with_weight_sum(query, std::int64_t{300} * kMaxWeight);
    EXPECT_EQ(scaled.average_weight,
              (std::array<std::int32_t, 3>{kMaxWeight, kMaxWeight, 0}));
    EXPECT_EQ(scaled.weight_sum, kMaxWeight);
}

// The picture as it would be, by the place that each pixel comes from.
template <typename From>
Pixels rearranged(const Pixels& picture, const From& from) {
    Pixels result = picture;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const auto [from_x, from_y] = from(x, y);
            for (int c = 0; c < picture.channels; ++c) {
                result.at(x, y, c) = picture.at(std::clamp(from_x, 0, picture.width - 1),
                                                std::clamp(from_y, 0, picture.height - 1),
                                                c);
            }
        }
    }
    return result;
}

TEST(MovedSignatures, AreThoseOfThePictureMovedInEveryDirection) {
    const Pixels picture = scene(192, 192, 5);
    const std::vector<Signature> moved = moved_signatures(picture.view(), {});
    ASSERT_EQ(moved.size(), 10U);
    for (const int down : {-4, 0, 4}) {
        for (const int right : {-4, 0, 4}) {
            if (right == 0 && down == 0) continue;
            const Pixels other = rearranged(
                picture, [&](int x, int y) { return std::pair(x - right, y - down); });
            EXPECT_EQ(
                std::count(moved.begin(), moved.end(), make_signature(other.view())), 1)
                << right << ' ' << down;
        }
    }
}

TEST(MovedSignatures, AreThoseOfThePictureSmallerAndLarger) {
    const Pixels picture = scene(192, 192, 6);
    const std::vector<Signature> moved = moved_signatures(picture.view(), {});
    for (const double scale : {0.95, 1.05}) {
        const auto from = [&](int at) {
            return static_cast<int>(std::floor((at + 0.5 - 96) / scale + 96));
        };
        const Pixels other = rearranged(
            picture, [&](int x, int y) { return std::pair(from(x), from(y)); });
        EXPECT_EQ(std::count(moved.begin(), moved.end(), make_signature(other.view())), 1)
            << scale;
    }
}

// What a search does with them: parts of pictures find their pictures.
TEST(WindowSignatures, FindPicturesByTheirParts) {
    const Profile profile = *built_in_profile("scanned");
    constexpr int kPictures = 20;
    std::vector<Record> records;
    for (int i = 0; i < kPictures; ++i) {
        records.push_back({ImageId{i}, make_signature(scene(200, 200, 100 + i).view())});
    }
    Index index{IndexOptions{}};
    index.apply(records, {});
    const auto snapshot = index.snapshot();
    int found = 0;
    int found_whole = 0;
    for (int i = 0; i < kPictures; ++i) {
        const Pixels part = part_of(scene(200, 200, 100 + i), 42, 38, 120, 120);
        std::vector<Query> queries;
        for (const WindowSignature& window : window_signatures(part.view(), {})) {
            const Query query = make_query(window.signature, profile, profile.m);
            queries.push_back(with_weight_sum(
                query, queries.empty() ? query.weight_sum : queries[0].weight_sum));
        }
        std::vector<Way> ways;
        for (const Query& query : queries) ways.push_back({snapshot.get(), &query});
        SearchScope scope;
        scope.limit = 1;
        found += search_best(ways, scope).matches[0].id == ImageId{i} ? 1 : 0;
        ways.resize(1);
        found_whole += search_best(ways, scope).matches[0].id == ImageId{i} ? 1 : 0;
    }
    EXPECT_GE(found, kPictures - 1);
    EXPECT_LE(found_whole, kPictures * 3 / 4);  // or the parts would be no test
}

}  // namespace
}  // namespace haarmony::image
