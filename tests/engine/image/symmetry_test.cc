#include "engine/image/symmetry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "engine/image/color_space.h"
#include "engine/image/haar.h"
#include "engine/image/resample.h"
#include "tests/engine/image/all_kinds.h"
#include "tests/engine/image/pictures.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

// Where the pixel that comes to (x, y) stood in a picture of width x height, from what the
// names say.
struct Place {
    int x, y;
};
Place origin(Symmetry symmetry, int x, int y, int width, int height) {
    switch (symmetry) {
        case Symmetry::kIdentity:
            break;
        case Symmetry::kMirrorX:
            return {width - 1 - x, y};
        case Symmetry::kMirrorY:
            return {x, height - 1 - y};
        case Symmetry::kTurn90:  // the lower left corner comes to the upper left
            return {y, height - 1 - x};
        case Symmetry::kTurn180:
            return {width - 1 - x, height - 1 - y};
        case Symmetry::kTurn270:  // the upper right corner comes to the upper left
            return {width - 1 - y, x};
        case Symmetry::kTranspose:
            return {y, x};
        case Symmetry::kAntiTranspose:
            return {width - 1 - y, height - 1 - x};
    }
    return {x, y};
}

Pixels turned(const Pixels& picture, Symmetry symmetry) {
    Pixels result = picture;
    if (swaps_sides(symmetry)) std::swap(result.width, result.height);
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            const Place from = origin(symmetry, x, y, picture.width, picture.height);
            for (int c = 0; c < picture.channels; ++c) {
                result.at(x, y, c) = picture.at(from.x, from.y, c);
            }
        }
    }
    return result;
}

// All coefficients of a picture, before truncation.
std::unique_ptr<ColorPlanes> coefficients(const Pixels& picture,
                                          const SignatureKind& kind) {
    auto planes = std::make_unique<ColorPlanes>();
    area_average(picture.view(), *planes);
    convert(kind.color_space, *planes);
    for (Plane& plane : *planes) decompose(plane, kSide, kind.decomposition);
    return planes;
}

// The magnitudes at the places of a channel, largest first; -1 where the sign is wrong.
std::vector<float> magnitudes(const ChannelSignature& channel, const Plane& plane) {
    std::vector<float> result;
    for (const int index : channel.largest(kMaxCoefficients)) {
        const float value = plane[std::abs(index)];
        result.push_back((index > 0) == (value > 0) ? std::fabs(value) : -1.0F);
    }
    std::ranges::sort(result, std::greater<>());
    return result;
}

// The standard coefficients of transposed pixels have other roundings: 14 of numbers below 2.
float tolerance(const SignatureKind& kind, Symmetry symmetry) {
    const bool rounds =
        kind.decomposition == Decomposition::kStandard && swaps_sides(symmetry);
    return rounds ? 2e-6F : 0.0F;
}

// `signature` is that of `picture` up to the choice among equal magnitudes: its places are
// distinct, hold the magnitudes of the largest coefficients, and have their signs.
void expect_signature_of(const Pixels& picture,
                         const Signature& signature,
                         float tolerance) {
    const Signature expected = make_signature(picture.view(), signature.kind);
    const auto planes = coefficients(picture, signature.kind);
    for (int c = 0; c < kChannels; ++c) {
        const ChannelSignature& channel = signature.channels[c];
        ASSERT_NEAR(channel.average,
                    expected.channels[c].average,
                    double{tolerance} * double{kAverageOne});
        std::set<int> places;
        for (const int index : channel.largest(kMaxCoefficients)) {
            ASSERT_GE(std::abs(index), 1);
            ASSERT_LT(std::abs(index), kCoefficientCount);
            ASSERT_TRUE(places.insert(std::abs(index)).second);
        }
        const auto kept = magnitudes(channel, (*planes)[c]);
        const auto largest = magnitudes(expected.channels[c], (*planes)[c]);
        ASSERT_EQ(kept.size(), largest.size());
        for (std::size_t i = 0; i < kept.size(); ++i) {
            ASSERT_NEAR(kept[i], largest[i], tolerance) << "rank " << i;
        }
    }
    ASSERT_EQ(signature.low_information, expected.low_information);
}

std::vector<Pixels> many_pictures() {
    std::vector<Pixels> pictures;
    for (unsigned seed = 0; seed < 3; ++seed) {
        pictures.push_back(scene(128, 128, 900 + seed));
        pictures.push_back(scene(
            40 + 37 * static_cast<int>(seed), 150 - 20 * static_cast<int>(seed), seed));
    }
    pictures.push_back(noise(128, 128, 3, 91));
    pictures.push_back(noise(70, 201, 3, 92));
    pictures.push_back(noise(65, 33, 1, 93));
    pictures.push_back(noise(90, 60, 4, 94));
    pictures.push_back(scene(2, 5, 95));
    pictures.push_back(flat(3, 2, {200, 10, 60}));
    return pictures;
}

TEST(Symmetry, OfASignatureIsThatOfTheTurnedPixels) {
    const std::vector<SignatureKind> kinds = {
        {ColorSpace::kYiq, Decomposition::kStandard},
        {ColorSpace::kYiq, Decomposition::kNonstandard},
        {ColorSpace::kLab, Decomposition::kNonstandard}};
    for (const Pixels& picture : many_pictures()) {
        const std::vector<Signature> signatures = make_signatures(picture.view(), kinds);
        for (const Symmetry symmetry : kSymmetries) {
            const Pixels pixels = turned(picture, symmetry);
            for (const Signature& signature : signatures) {
                SCOPED_TRACE(std::string(symmetry_name(symmetry)) + ' ' +
                             kind_name(signature.kind) + ' ' +
                             std::to_string(picture.width) + " x " +
                             std::to_string(picture.height));
                const Signature moved = transformed(signature, symmetry);
                ASSERT_EQ(moved.kind, signature.kind);
                ASSERT_NO_FATAL_FAILURE(expect_signature_of(
                    pixels, moved, tolerance(signature.kind, symmetry)));
            }
        }
    }
}

// Whether the last magnitude that is kept stands clear of the first that is not.
bool last_place_is_clear(const Plane& plane, float tolerance) {
    std::vector<float> sorted;
    for (int i = 1; i < kCoefficientCount; ++i) sorted.push_back(std::fabs(plane[i]));
    std::ranges::nth_element(sorted, sorted.begin() + kMaxCoefficients, std::greater<>());
    const float next = sorted[kMaxCoefficients];
    const float last =
        *std::min_element(sorted.begin(), sorted.begin() + kMaxCoefficients);
    return last - next > tolerance;
}

// Nothing is left to choose there: the same sets.
TEST(Symmetry, OfASignatureWithoutTiesHasTheSameCoefficients) {
    const std::vector<SignatureKind> kinds = all_kinds();
    int compared = 0;
    int clear = 0;
    for (unsigned seed = 100; seed < 102; ++seed) {
        const Pixels picture = noise(128, 128, 3, seed);
        const std::vector<Signature> signatures = make_signatures(picture.view(), kinds);
        for (const Symmetry symmetry : kSymmetries) {
            const Pixels pixels = turned(picture, symmetry);
            const std::vector<Signature> all_expected =
                make_signatures(pixels.view(), kinds);
            for (std::size_t k = 0; k < kinds.size(); ++k) {
                const SignatureKind& kind = kinds[k];
                const Signature moved = transformed(signatures[k], symmetry);
                const Signature& expected = all_expected[k];
                const auto planes = coefficients(pixels, kind);
                for (int c = 0; c < kChannels; ++c) {
                    ++compared;
                    if (!last_place_is_clear((*planes)[c], tolerance(kind, symmetry)))
                        continue;
                    ++clear;
                    const auto a = moved.channels[c].largest(kMaxCoefficients);
                    const auto b = expected.channels[c].largest(kMaxCoefficients);
                    ASSERT_EQ(std::set(a.begin(), a.end()), std::set(b.begin(), b.end()))
                        << symmetry_name(symmetry) << ' ' << kind_name(kind);
                }
            }
        }
    }
    EXPECT_GT(clear, compared * 3 / 4);
}

// A checkerboard has hundreds of equal magnitudes: the mirror image of the smallest indices is
// not the smallest indices of the mirror image.
TEST(Symmetry, IsOnlyExactUpToTiesForTheLastPlace) {
    Pixels picture = flat(kSide, kSide, {0});
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            picture.at(x, y, 0) = static_cast<std::uint8_t>((x + y) % 2 == 0 ? 255 : 0);
        }
    }
    const Signature moved =
        transformed(make_signature(picture.view()), Symmetry::kMirrorX);
    const Pixels mirrored = turned(picture, Symmetry::kMirrorX);
    EXPECT_NE(moved, make_signature(mirrored.view()));
    expect_signature_of(mirrored, moved, 0.0F);
}

std::vector<Signature> random_ones() {
    std::vector<Signature> signatures;
    std::mt19937 random(96);
    for (int i = 0; i < 20; ++i) {
        for (const Decomposition decomposition : kAllDecompositions) {
            Signature signature = random_signature(random, {});
            signature.kind.decomposition = decomposition;
            signatures.push_back(signature);
        }
    }
    return signatures;
}

TEST(Symmetry, IdentityChangesNothing) {
    for (const Signature& signature : random_ones()) {
        EXPECT_EQ(transformed(signature, Symmetry::kIdentity), signature);
    }
}

TEST(Symmetry, InverseUndoesIt) {
    for (const Signature& signature : random_ones()) {
        for (const Symmetry symmetry : kSymmetries) {
            EXPECT_EQ(transformed(transformed(signature, symmetry), inverse(symmetry)),
                      signature)
                << symmetry_name(symmetry);
        }
    }
}

TEST(Symmetry, ComposedIsOneAfterTheOther) {
    for (const Signature& signature : random_ones()) {
        for (const Symmetry first : kSymmetries) {
            for (const Symmetry second : kSymmetries) {
                ASSERT_EQ(transformed(transformed(signature, first), second),
                          transformed(signature, compose(first, second)))
                    << symmetry_name(first) << ", " << symmetry_name(second);
            }
        }
    }
}

TEST(Symmetry, ComposedMovesPixelsAsOneAfterTheOther) {
    const Pixels picture = noise(5, 3, 1, 97);
    for (const Symmetry first : kSymmetries) {
        for (const Symmetry second : kSymmetries) {
            const Pixels twice = turned(turned(picture, first), second);
            const Pixels once = turned(picture, compose(first, second));
            EXPECT_EQ(once.width, twice.width);
            EXPECT_EQ(once.bytes, twice.bytes)
                << symmetry_name(first) << ", " << symmetry_name(second);
        }
    }
}

TEST(Symmetry, IsTheGroupOfTheSquare) {
    for (const Symmetry a : kSymmetries) {
        EXPECT_EQ(compose(a, Symmetry::kIdentity), a);
        EXPECT_EQ(compose(Symmetry::kIdentity, a), a);
        EXPECT_EQ(compose(a, inverse(a)), Symmetry::kIdentity);
        EXPECT_EQ(compose(inverse(a), a), Symmetry::kIdentity);
        for (const Symmetry b : kSymmetries) {
            for (const Symmetry c : kSymmetries) {
                ASSERT_EQ(compose(compose(a, b), c), compose(a, compose(b, c)));
            }
        }
    }
}

TEST(Symmetry, AllButTheQuarterTurnsUndoThemselves) {
    for (const Symmetry symmetry : kSymmetries) {
        const bool quarter =
            symmetry == Symmetry::kTurn90 || symmetry == Symmetry::kTurn270;
        EXPECT_EQ(inverse(symmetry) == symmetry, !quarter) << symmetry_name(symmetry);
    }
    EXPECT_EQ(inverse(Symmetry::kTurn90), Symmetry::kTurn270);
    EXPECT_EQ(compose(Symmetry::kTurn90, Symmetry::kTurn90), Symmetry::kTurn180);
    EXPECT_EQ(compose(Symmetry::kMirrorX, Symmetry::kMirrorY), Symmetry::kTurn180);
    EXPECT_EQ(compose(Symmetry::kTranspose, Symmetry::kMirrorX), Symmetry::kTurn90);
}

TEST(Symmetry, QuarterTurnsAndTransposesSwapTheSides) {
    std::string names;
    for (const Symmetry symmetry : kSymmetries) {
        if (swaps_sides(symmetry)) names += std::string(symmetry_name(symmetry)) + ' ';
    }
    EXPECT_EQ(names, "turn_90 turn_270 transpose anti_transpose ");
}

TEST(Symmetry, HasTheNamesOfTheInterfaceInThisOrder) {
    std::string names;
    for (const Symmetry symmetry : kSymmetries) {
        names += std::string(symmetry_name(symmetry)) + ' ';
        EXPECT_EQ(symmetry_from_name(symmetry_name(symmetry)), symmetry);
    }
    EXPECT_EQ(names,
              "identity mirror_x mirror_y turn_90 turn_180 turn_270 transpose "
              "anti_transpose ");
    for (const char* name : {"", "turn_45", "Identity", "identity "}) {
        EXPECT_EQ(symmetry_from_name(name), std::nullopt) << name;
    }
}

}  // namespace
}  // namespace haarmony::image
