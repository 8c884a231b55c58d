#include "tests/eval/synthetic_signatures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "server/app/thread_executor.h"
#include "tests/eval/synthetic_pictures.h"
#include "tests/eval/test/generated_pictures.h"

namespace haarmony::eval {
namespace {

SmallPhotos few_photos() {
    server::ThreadExecutor threads(1);
    return *load_small_photos(generated_pictures(12), threads);
}

SyntheticCollection made(const SyntheticSize& size, int threads) {
    server::ThreadExecutor executor(threads - 1);
    return make_synthetic_collection(few_photos(), size, executor);
}

int shared_coefficients(const PackedSignature& a, const PackedSignature& b) {
    int shared = 0;
    for (int c = 0; c < image::kChannels; ++c) {
        const auto of_a = a.largest(c, kPackedCoefficients);
        const std::set<int> of_b(b.largest(c, kPackedCoefficients).begin(),
                                 b.largest(c, kPackedCoefficients).end());
        shared += static_cast<int>(
            std::ranges::count_if(of_a, [&](int index) { return of_b.contains(index); }));
    }
    return shared;
}

TEST(SyntheticSignatures, DependOnTheSeedAndNotOnTheThreads) {
    const SyntheticCollection one = made({5, 20, 4}, 1);
    const SyntheticCollection again = made({5, 20, 4}, 3);
    EXPECT_EQ(one.signatures, again.signatures);
    EXPECT_EQ(one.cells, again.cells);
    EXPECT_EQ(one.histograms, again.histograms);
    EXPECT_EQ(one.queries, again.queries);
    EXPECT_EQ(one.source_digest, again.source_digest);
    EXPECT_NE(one.signatures, made({6, 20, 4}, 1).signatures);
}

TEST(SyntheticSignatures, SmallerCollectionIsAPrefix) {
    const SyntheticCollection large = made({5, 20, 3}, 2);
    const SyntheticCollection small = made({5, 9, 2}, 2);
    EXPECT_TRUE(std::ranges::equal(
        small.signatures, std::span(large.signatures).first(small.signatures.size())));
    for (std::size_t k = 0; k < kSyntheticKinds.size(); ++k) {
        EXPECT_TRUE(std::ranges::equal(
            small.queries[k], std::span(large.queries[k]).first(small.queries[k].size())))
            << synthetic_kind_name(kSyntheticKinds[k]);
    }
}

// A near query shares most with its own picture, a sketch more than a stranger would.
TEST(SyntheticSignatures, QueriesShowThePictureOfTheirNumber) {
    const SyntheticCollection collection = made({1, 24, 8}, 2);
    for (const SyntheticKind kind : {SyntheticKind::kNear, SyntheticKind::kSketch}) {
        int found = 0;
        for (std::size_t q = 0; q < 8; ++q) {
            const PackedSignature& query =
                collection.queries[static_cast<std::size_t>(kind)][q].signature;
            std::vector<int> shared;
            for (const PackedSignature& signature : collection.signatures)
                shared.push_back(shared_coefficients(query, signature));
            found += std::ranges::max_element(shared) - shared.begin() ==
                     static_cast<std::ptrdiff_t>(q);
        }
        EXPECT_GE(found, 7) << synthetic_kind_name(kind);
    }
}

// Of a red and a blue photo one is held out: novel queries show it and no picture does.
TEST(SyntheticSignatures, NovelQueriesAreOfPhotosThatNoPictureShows) {
    int held_out_red = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SmallPhotos photos;
        photos.pictures = {flat(8, 8, 0, 0, 200), flat(8, 8, 200, 0, 0)};
        InlineExecutor executor;
        const SyntheticCollection collection =
            make_synthetic_collection(photos, {seed, 10, 4}, executor);
        const auto is_red = [](const CellBytes& cells) { return cells[0] > cells[2]; };
        const auto& novel =
            collection.queries[static_cast<std::size_t>(SyntheticKind::kNovel)];
        const bool red = is_red(novel.front().features.cells);
        for (const SyntheticQuery& query : novel)
            EXPECT_EQ(is_red(query.features.cells), red) << seed;
        for (const CellBytes& cells : collection.cells)
            EXPECT_EQ(is_red(cells), !red) << seed;
        held_out_red += red ? 1 : 0;
    }
    EXPECT_GT(held_out_red, 0);
    EXPECT_LT(held_out_red, 6);
}

TEST(SyntheticPictures, RecipeGivesTheSamePictureEveryTime) {
    const SmallPhotos photos = few_photos();
    const PictureKitchen kitchen(photos.pictures);
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        gallery::Random random(seed);
        const PictureRecipe recipe =
            random_recipe(0, static_cast<int>(photos.pictures.size()), random);
        const RgbPicture picture = kitchen.render(recipe);
        EXPECT_EQ(picture.rgb, kitchen.render(recipe).rgb) << seed;
        EXPECT_EQ(picture.rgb.size(), std::size_t{image::kCoefficientCount} * 3) << seed;
    }
}

TEST(SyntheticPictures, WholePhotoWithoutRecolouringIsThePhoto) {
    const std::vector<RgbPicture> photos = {gradient(image::kSide, image::kSide)};
    EXPECT_EQ(PictureKitchen(photos).render({}).rgb, photos.front().rgb);
}

TEST(SyntheticPictures, MirroredCutIsThePhotoFromRightToLeft) {
    const std::vector<RgbPicture> photos = {gradient(image::kSide, image::kSide)};
    PictureRecipe recipe;
    recipe.cuts[0].mirrored = true;
    const RgbPicture picture = PictureKitchen(photos).render(recipe);
    for (int y = 0; y < image::kSide; ++y) {
        for (int x = 0; x < image::kSide; ++x) {
            for (int c = 0; c < 3; ++c) {
                ASSERT_EQ(picture.rgb[(y * image::kSide + x) * 3 + c],
                          photos.front().rgb[(y * image::kSide + 127 - x) * 3 + c])
                    << x << ' ' << y;
            }
        }
    }
}

TEST(SyntheticPictures, BlendOfBlackAndWhiteIsAsGreyAsTheShareSays) {
    const std::vector<RgbPicture> photos = {flat(9, 9, 255, 255, 255),
                                            flat(9, 9, 0, 0, 0)};
    PictureRecipe recipe;
    recipe.composition = Composition::kBlend;
    recipe.cuts[1].photo = 1;
    recipe.share = 0.25;
    const RgbPicture picture = PictureKitchen(photos).render(recipe);
    EXPECT_EQ(picture.rgb, flat(image::kSide, image::kSide, 64, 64, 64).rgb);
}

TEST(SyntheticPictures, HalvesAndQuartersStandWhereTheRecipeSays) {
    const std::vector<RgbPicture> photos = {flat(9, 9, 10, 0, 0),
                                            flat(9, 9, 20, 0, 0),
                                            flat(9, 9, 30, 0, 0),
                                            flat(9, 9, 40, 0, 0)};
    PictureRecipe recipe;
    for (int i = 0; i < 4; ++i) recipe.cuts[i].photo = i;
    recipe.share = 0.25;
    const PictureKitchen kitchen(photos);
    const auto red = [&](int x, int y) {
        return kitchen.render(recipe).rgb[(y * image::kSide + x) * 3];
    };
    recipe.composition = Composition::kHalves;
    EXPECT_EQ(red(31, 127), 10);
    EXPECT_EQ(red(32, 0), 20);
    recipe.upright = true;
    EXPECT_EQ(red(127, 31), 10);
    EXPECT_EQ(red(0, 32), 20);
    recipe.composition = Composition::kQuarters;
    EXPECT_EQ(red(63, 63), 10);
    EXPECT_EQ(red(64, 63), 20);
    EXPECT_EQ(red(63, 64), 30);
    EXPECT_EQ(red(64, 64), 40);
}

TEST(SyntheticPictures, VariationKeepsEveryCutWithinItsPhoto) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        gallery::Random random(seed);
        const PictureRecipe recipe = varied(random_recipe(0, 3, random), random);
        for (int i = 0; i < cuts_of(recipe.composition); ++i) {
            const Cut& cut = recipe.cuts[i];
            EXPECT_GE(cut.left, 0) << seed;
            EXPECT_GE(cut.top, 0) << seed;
            EXPECT_LE(cut.left + cut.width, 1 + 1e-12) << seed;
            EXPECT_LE(cut.top + cut.height, 1 + 1e-12) << seed;
        }
    }
}

TEST(SmallPhotos, AreSmallAndLeaveOutWhatCannotBeRead) {
    PictureSource source;
    source.names = {"large", "broken", "small"};
    source.load = [](std::size_t i) -> Result<RgbPicture> {
        if (i == 1) return Error{ErrorCode::kUndecodable, "broken"};
        return i == 0 ? gradient(400, 200) : gradient(30, 20);
    };
    InlineExecutor executor;
    const auto photos = load_small_photos(source, executor);
    ASSERT_TRUE(photos);
    ASSERT_EQ(photos->pictures.size(), 2U);
    EXPECT_EQ(photos->unreadable, 1);
    EXPECT_EQ(photos->pictures[0].width, kSmallSide);
    EXPECT_EQ(photos->pictures[0].height, kSmallSide / 2);
    EXPECT_EQ(photos->pictures[1].rgb, gradient(30, 20).rgb);
}

TEST(SmallPhotos, DigestTellsPhotosApart) {
    const auto digest = [](RgbPicture picture) {
        PictureSource source;
        source.names = {"one"};
        source.load = [picture](std::size_t) -> Result<RgbPicture> { return picture; };
        InlineExecutor executor;
        return load_small_photos(source, executor)->digest;
    };
    const std::uint64_t original = digest(flat(6, 4, 1, 2, 3));
    EXPECT_EQ(original, digest(flat(6, 4, 1, 2, 3)));
    EXPECT_NE(original, digest(flat(6, 4, 1, 2, 4)));
    EXPECT_NE(original, digest(flat(4, 6, 1, 2, 3)));
}

TEST(SmallPhotos, NoneThatCanBeReadIsAnError) {
    PictureSource source;
    source.names = {"a", "b"};
    source.load = [](std::size_t) -> Result<RgbPicture> {
        return Error{ErrorCode::kUndecodable, "broken"};
    };
    InlineExecutor executor;
    const auto photos = load_small_photos(source, executor);
    ASSERT_FALSE(photos);
    EXPECT_EQ(photos.error().code, ErrorCode::kNotFound);
    EXPECT_EQ(photos.error().message, "none of 2 files is a picture that can be read");
}

TEST(PackedSignature, KeepsTheFirstSixtyCoefficients) {
    const image::Signature signature = image::make_signature(gradient(64, 64).view());
    const PackedSignature packed = pack(signature);
    const image::Signature unpacked = unpack(packed);
    EXPECT_EQ(pack(unpacked), packed);
    EXPECT_EQ(unpacked.low_information, signature.low_information);
    for (int c = 0; c < image::kChannels; ++c) {
        EXPECT_EQ(unpacked.channels[c].average, signature.channels[c].average);
        EXPECT_TRUE(std::ranges::equal(unpacked.channels[c].largest(100),
                                       signature.channels[c].largest(60)));
        EXPECT_TRUE(
            std::ranges::equal(packed.largest(c, 7), signature.channels[c].largest(7)));
    }
    EXPECT_EQ(unpack(pack(image::make_signature(flat(4, 4, 9, 9, 9).view()))),
              image::make_signature(flat(4, 4, 9, 9, 9).view()));
}

}  // namespace
}  // namespace haarmony::eval
