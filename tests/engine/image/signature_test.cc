#include "engine/image/signature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "engine/image/color_space.h"
#include "engine/image/haar.h"
#include "engine/image/mask.h"
#include "engine/image/metric.h"
#include "engine/image/profile.h"
#include "engine/image/resample.h"
#include "engine/image/truncation.h"
#include "tests/engine/image/all_kinds.h"
#include "tests/engine/image/pictures.h"

namespace haarmony::image {
namespace {

// One channel of YIQ over a 128 x 128 picture, from the matrix, in double precision.
std::vector<double> channel_of(const Pixels& picture, int channel) {
    constexpr double kMatrix[3][3] = {{0.299, 0.587, 0.114},
                                      {0.595716, -0.274453, -0.321263},
                                      {0.211456, -0.522591, 0.311135}};
    std::vector<double> plane;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            double value = 0;
            for (int c = 0; c < 3; ++c) {
                value += kMatrix[channel][c] * picture.at(x, y, c) / 255.0;
            }
            plane.push_back(value);
        }
    }
    return plane;
}

// The orthonormal decomposition, rows and then columns, unscaled means apart.
void decompose_rows(std::vector<double>& plane) {
    for (int y = 0; y < kSide; ++y) {
        double* row = plane.data() + y * kSide;
        for (int h = kSide / 2; h > 0; h /= 2) {
            std::vector<double> next(row, row + 2 * h);
            for (int i = 0; i < h; ++i) {
                next[i] = (row[2 * i] + row[2 * i + 1]) / std::sqrt(2.0);
                next[h + i] = (row[2 * i] - row[2 * i + 1]) / std::sqrt(2.0);
            }
            std::copy(next.begin(), next.end(), row);
        }
    }
}

std::vector<double> transposed(const std::vector<double>& plane) {
    std::vector<double> result(plane.size());
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) result[x * kSide + y] = plane[y * kSide + x];
    }
    return result;
}

TEST(Signature, AgreesWithTheDefinitionInDoublePrecision) {
    const Pixels picture = scene(kSide, kSide, 41);
    const Signature signature = make_signature(picture.view());
    for (int c = 0; c < kChannels; ++c) {
        std::vector<double> coefficients = channel_of(picture, c);
        decompose_rows(coefficients);
        coefficients = transposed(coefficients);
        decompose_rows(coefficients);
        coefficients = transposed(coefficients);
        for (double& value : coefficients) value /= kSide;

        const ChannelSignature& channel = signature.channels[c];
        // A mean of 14 additions in float.
        EXPECT_NEAR(channel.average / double(kAverageOne), coefficients[0], 1e-6);
        ASSERT_EQ(channel.count, kMaxCoefficients);
        std::vector<double> magnitudes;
        for (int i = 1; i < kCoefficientCount; ++i) {
            magnitudes.push_back(std::fabs(coefficients[i]));
        }
        std::ranges::sort(magnitudes, std::greater<>());
        for (int rank = 0; rank < channel.count; ++rank) {
            const int index = channel.indices[rank];
            const double value = coefficients[std::abs(index)];
            // Ranks may differ from the oracle's only where magnitudes are equal in float.
            ASSERT_NEAR(std::fabs(value), magnitudes[rank], 1e-6) << "rank " << rank;
            ASSERT_EQ(index > 0, value > 0) << "rank " << rank;
        }
    }
}

TEST(Signature, OfAFlatPictureOfAnySizeIsItsColorAlone) {
    const Signature expected = make_signature(flat(1, 1, {10, 200, 90}).view());
    for (const auto& [width, height] :
         {std::pair(3, 1), {128, 128}, {131, 77}, {640, 2}}) {
        const Signature signature =
            make_signature(flat(width, height, {10, 200, 90}).view());
        EXPECT_EQ(signature, expected) << width << " x " << height;
        EXPECT_TRUE(signature.low_information);
        for (const ChannelSignature& channel : signature.channels) {
            EXPECT_EQ(channel.count, 0);
        }
    }
}

TEST(Signature, OfGreyHasNoChroma) {
    for (const int channels : {1, 3}) {
        Pixels picture = noise(200, 150, channels, 42);
        if (channels == 3) {
            for (std::size_t i = 0; i < picture.bytes.size(); i += 3) {
                picture.bytes[i + 1] = picture.bytes[i + 2] = picture.bytes[i];
            }
        }
        const Signature signature = make_signature(picture.view());
        EXPECT_EQ(signature.channels[0].count, kMaxCoefficients);
        for (const int chroma : {1, 2}) {
            EXPECT_EQ(signature.channels[chroma].count, 0);
            EXPECT_EQ(signature.channels[chroma].average, 0);
        }
    }
}

TEST(Signature, OfAMagnifiedPictureIsTheSame) {
    const Pixels picture = scene(128, 128, 43);
    Pixels magnified = flat(384, 256, {0, 0, 0});
    for (int y = 0; y < magnified.height; ++y) {
        for (int x = 0; x < magnified.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                magnified.at(x, y, c) = picture.at(x / 3, y / 2, c);
            }
        }
    }
    EXPECT_EQ(make_signature(magnified.view()), make_signature(picture.view()));
}

TEST(Signature, BlackIsAPictureLikeAnyOther) {
    const Signature black = make_signature(flat(4, 4, {0, 0, 0}).view());
    EXPECT_EQ(black, make_signature(flat(4, 4, {9, 9, 9, 0}).view()));
    for (const ChannelSignature& channel : black.channels) EXPECT_EQ(channel.average, 0);
}

// Half of the cells one level above the other half deviate by half a level; a checkerboard
// of 0 and 3 levels by one and a half.
TEST(Signature, LowInformationIsADeviationBelowOneLevel) {
    Pixels picture = flat(kSide, kSide, {100});
    for (const int step : {1, 3}) {
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                picture.at(x, y, 0) =
                    static_cast<std::uint8_t>(100 + ((x + y) % 2 == 0 ? step : 0));
            }
        }
        const Signature signature = make_signature(picture.view());
        EXPECT_EQ(signature.low_information, step == 1) << step;
        EXPECT_GT(signature.channels[0].count, 0);
    }
}

// The same steps, one after the other, for every kind.
TEST(Signature, OfAKindIsItsSpaceItsDecompositionAndTruncation) {
    const Pixels picture = scene(200, 150, 44);
    for (const SignatureKind& kind : all_kinds()) {
        const Signature signature = make_signature(picture.view(), kind);
        const auto planes = std::make_unique<ColorPlanes>();
        area_average(picture.view(), *planes);
        convert(kind.color_space, *planes);
        EXPECT_EQ(signature.kind, kind);
        for (int c = 0; c < kChannels; ++c) {
            decompose((*planes)[c], kSide, kind.decomposition);
            EXPECT_EQ(signature.channels[c], truncate((*planes)[c]))
                << kind_name(kind) << " channel " << c;
        }
    }
}

// Painted left of `edge`, shaded over `shade` columns, with anything at all beyond.
Pixels painted_left(const Pixels& rgb, int edge, int shade, unsigned seed) {
    Pixels picture = noise(rgb.width, rgb.height, 4, seed);
    for (int y = 0; y < rgb.height; ++y) {
        for (int x = 0; x < rgb.width; ++x) {
            const int alpha = std::clamp((edge - x) * 255 / shade, 0, 255);
            picture.at(x, y, 3) = static_cast<std::uint8_t>(alpha);
            for (int c = 0; c < 3 && alpha > 0; ++c)
                picture.at(x, y, c) = rgb.at(x, y, c);
        }
    }
    return picture;
}

// The steps of mask.h, one after the other.
TEST(Signature, OfWhatIsPaintedInPartKeepsTheFewBestSupportedCoefficients) {
    const Pixels picture = painted_left(scene(200, 150, 50), 120, 9, 51);
    for (const SignatureKind& kind : all_kinds()) {
        const Signature signature = make_signature(picture.view(), kind);
        const auto planes = std::make_unique<ColorPlanes>();
        const auto cover = area_average(picture.view(), *planes);
        ASSERT_NE(cover, nullptr);
        convert(kind.color_space, *planes);
        for (int c = 0; c < kChannels; ++c) {
            decompose((*planes)[c], kSide, kind.decomposition);
            weigh_by_cover(*cover, kind.decomposition, (*planes)[c]);
            const ChannelSignature all = truncate((*planes)[c]);
            const ChannelSignature& kept = signature.channels[c];
            EXPECT_EQ(kept.average, all.average) << kind_name(kind);
            EXPECT_TRUE(std::ranges::equal(kept.largest(kMaxCoefficients),
                                           all.largest(kept_coefficients(*cover))))
                << kind_name(kind);
        }
    }
}

TEST(Signature, DoesNotSeeWhatIsTransparent) {
    const Pixels rgb = scene(200, 150, 52);
    EXPECT_EQ(make_signature(painted_left(rgb, 90, 1, 53).view()),
              make_signature(painted_left(rgb, 90, 1, 54).view()));
}

TEST(Signature, OfAnOpaquePictureIsThatWithoutAlpha) {
    const Pixels rgb = scene(200, 150, 55);
    const Pixels opaque = painted_left(rgb, 2 * rgb.width, 1, 56);
    for (const SignatureKind& kind : all_kinds()) {
        EXPECT_EQ(make_signature(opaque.view(), kind), make_signature(rgb.view(), kind));
    }
}

// The scenes are alike: all have the same ramps. One of 40 may be mistaken for another.
TEST(Signature, OfHalfAPictureIsNearestToThatPicture) {
    const Profile profile = *built_in_profile("painted");
    std::vector<Signature> whole;
    for (unsigned seed = 0; seed < 40; ++seed) {
        whole.push_back(make_signature(scene(128, 128, 100 + seed).view()));
    }
    int found = 0;
    for (unsigned seed = 0; seed < whole.size(); ++seed) {
        const Signature half =
            make_signature(painted_left(scene(128, 128, 100 + seed), 64, 1, seed).view());
        std::vector<std::int64_t> distances;
        for (const Signature& target : whole) {
            distances.push_back(metric(half, target, profile, profile.m));
        }
        found += std::ranges::min_element(distances) - distances.begin() == seed ? 1 : 0;
    }
    EXPECT_GE(found, 39);
}

TEST(Signature, IsYiqStandardUnlessAKindIsAskedFor) {
    const Pixels picture = scene(70, 90, 45);
    EXPECT_EQ(
        make_signature(picture.view()),
        make_signature(picture.view(), {ColorSpace::kYiq, Decomposition::kStandard}));
}

TEST(Signature, OfManyKindsAreThoseOfEachAlone) {
    const Pixels picture = scene(200, 150, 46);
    std::vector<SignatureKind> kinds = all_kinds();
    std::mt19937 random(47);
    for (int round = 0; round < 5; ++round) {
        const std::vector<Signature> signatures = make_signatures(picture.view(), kinds);
        ASSERT_EQ(signatures.size(), kinds.size());
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            EXPECT_EQ(signatures[i], make_signature(picture.view(), kinds[i]))
                << kind_name(kinds[i]);
        }
        std::ranges::shuffle(kinds, random);
        kinds.push_back(kinds.front());  // a kind twice is made twice
    }
    EXPECT_TRUE(make_signatures(picture.view(), {}).empty());
}

TEST(Signature, OfGreyHasNoChromaInAnySpaceThatHasOne) {
    const Pixels picture = noise(200, 150, 1, 48);
    for (const SignatureKind& kind : all_kinds()) {
        if (kind.color_space == ColorSpace::kRgb) continue;
        const Signature signature = make_signature(picture.view(), kind);
        EXPECT_EQ(signature.channels[0].count, kMaxCoefficients) << kind_name(kind);
        for (const int chroma : {1, 2}) {
            EXPECT_EQ(signature.channels[chroma].count, 0) << kind_name(kind);
            EXPECT_EQ(signature.channels[chroma].average, 0) << kind_name(kind);
        }
    }
}

// Checkerboards of more and more levels: Lab and Luv would see more in the dark ones and HSV
// in the reddish ones than YIQ does.
TEST(Signature, LowInformationIsTheSameInEveryKind) {
    int low = 0;
    int high = 0;
    const std::vector<SignatureKind> kinds = all_kinds();
    for (const int base : {0, 3, 120, 250}) {
        for (int step = 0; step <= 4; ++step) {
            Pixels picture = flat(kSide, kSide, {0, 0, 0});
            for (int y = 0; y < kSide; ++y) {
                for (int x = 0; x < kSide; ++x) {
                    const int value = base + ((x + y) % 2 == 0 ? step : 0);
                    picture.at(x, y, 0) = static_cast<std::uint8_t>(value);
                }
            }
            const bool expected = make_signature(picture.view()).low_information;
            ++(expected ? low : high);
            for (const Signature& signature : make_signatures(picture.view(), kinds)) {
                EXPECT_EQ(signature.low_information, expected)
                    << kind_name(signature.kind) << " at " << base << " + " << step;
            }
            const auto alone = make_signature(
                picture.view(), {ColorSpace::kLab, Decomposition::kNonstandard});
            EXPECT_EQ(alone.low_information, expected);
        }
    }
    EXPECT_GT(low, 0);
    EXPECT_GT(high, 0);
}

TEST(Signature, OfOtherKindsIsNeverEqual) {
    const Pixels picture = flat(4, 4, {0, 0, 0});
    const std::vector<Signature> signatures =
        make_signatures(picture.view(), all_kinds());
    for (std::size_t i = 0; i < signatures.size(); ++i) {
        for (std::size_t j = 0; j < signatures.size(); ++j) {
            EXPECT_EQ(signatures[i].channels, signatures[j].channels);
            EXPECT_EQ(signatures[i] == signatures[j], i == j);
        }
    }
}

TEST(Signature, ChannelsAreEqualWhateverLiesBeyondTheCount) {
    ChannelSignature a;
    ChannelSignature b;
    a.count = b.count = 1;
    a.indices[0] = b.indices[0] = 5;
    b.indices[1] = 9;
    EXPECT_EQ(a, b);
    b.indices[0] = -5;
    EXPECT_NE(a, b);
    b.indices[0] = 5;
    b.count = 2;
    EXPECT_NE(a, b);
    a.count = 2;
    a.indices[1] = 9;
    EXPECT_EQ(a, b);
    a.average = 1;
    EXPECT_NE(a, b);
}

TEST(Signature, LargestGivesNoMoreThanThereAre) {
    ChannelSignature channel;
    channel.count = 3;
    EXPECT_EQ(channel.largest(0).size(), 0U);
    EXPECT_EQ(channel.largest(2).size(), 2U);
    EXPECT_EQ(channel.largest(100).size(), 3U);
}

}  // namespace
}  // namespace haarmony::image
