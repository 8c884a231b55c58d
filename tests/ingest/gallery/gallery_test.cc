#include "ingest/gallery/gallery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace haarmony::gallery {
namespace {

constexpr int kSmall = 64;

// Four by four means of each channel: the layout that a painted query can tell apart.
std::array<double, 48> layout(const Painting& painting) {
    std::array<double, 48> sums{};
    std::array<double, 16> counts{};
    for (int y = 0; y < painting.height; ++y) {
        for (int x = 0; x < painting.width; ++x) {
            const auto cell = static_cast<std::size_t>(y * 4 / painting.height * 4 +
                                                       x * 4 / painting.width);
            const auto at = static_cast<std::size_t>(y * painting.width + x) * 3;
            for (std::size_t c = 0; c < 3; ++c)
                sums[cell * 3 + c] += painting.rgb[at + c];
            counts[cell] += 1;
        }
    }
    for (std::size_t i = 0; i < 48; ++i) sums[i] /= counts[i / 3];
    return sums;
}

double distance(const std::array<double, 48>& a, const std::array<double, 48>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 48; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / 48);
}

TEST(Gallery, EqualRequestsGiveEqualPictures) {
    for (int number = 0; number < 2 * kKinds; ++number) {
        const Painting a = paint(5, number, kSmall);
        const Painting b = paint(5, number, kSmall);
        EXPECT_EQ(a.rgb, b.rgb) << a.title;
        EXPECT_EQ(a.title, b.title);
        EXPECT_EQ(a.tags, b.tags);
    }
}

TEST(Gallery, PicturesDoNotDependOnTheThreadThatPaintsThem) {
    std::vector<Painting> aside(kKinds);
    std::vector<std::thread> threads;
    threads.reserve(2);
    for (int start : {0, 1}) {
        threads.emplace_back([&aside, start] {
            for (int i = start; i < kKinds; i += 2)
                aside[static_cast<std::size_t>(i)] = paint(6, i, kSmall);
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (int i = 0; i < kKinds; ++i)
        EXPECT_EQ(aside[static_cast<std::size_t>(i)].rgb, paint(6, i, kSmall).rgb) << i;
}

TEST(Gallery, APictureHasTheSizeThatItSays) {
    for (int number = 0; number < 3 * kKinds; ++number) {
        for (const int side : {kLeastSide, 57, 160}) {
            const Painting painting = paint(7, number, side);
            EXPECT_EQ(std::max(painting.width, painting.height), side) << painting.title;
            EXPECT_GE(2 * std::min(painting.width, painting.height) + 1, side);
            EXPECT_EQ(painting.rgb.size(),
                      static_cast<std::size_t>(painting.width) * painting.height * 3);
        }
    }
}

TEST(Gallery, EveryPrefixHasAsManyKindsAsItCan) {
    std::set<std::string> kinds;
    for (int number = 0; number < 2 * kKinds; ++number) {
        const Painting painting = paint(1, number, kLeastSide);
        kinds.insert(painting.kind);
        EXPECT_EQ(kinds.size(), static_cast<std::size_t>(std::min(number + 1, kKinds)))
            << "after " << number + 1 << " pictures";
        ASSERT_FALSE(painting.tags.empty());
        EXPECT_EQ(painting.tags.front(), painting.kind);
        EXPECT_FALSE(painting.title.empty());
    }
}

// FNV-1a.
std::uint64_t fingerprint(const Painting& painting) {
    std::uint64_t hash = 0xCBF29CE484222325ULL;
    for (const std::uint8_t byte : painting.rgb) hash = (hash ^ byte) * 0x100000001B3ULL;
    return hash;
}

TEST(Gallery, PicturesAreTheSameOnEveryMachineAndCompiler) {
    // Lists of results made on generated pictures hold only as long as these do. Whoever
    // changes a painter on purpose takes the new value from the message.
    static constexpr std::array<std::uint64_t, kKinds> kFingerprints = {
        0x765675778B7A2968ULL,
        0x71014CCD3120AD2AULL,
        0xDE35BFD6367CEF23ULL,
        0xC898D515FF442BD7ULL,
        0x09526AA92ACC82E9ULL,
        0x14F48CED425A4DC0ULL,
        0xD327CF5B431F83EAULL,
        0x3A217C659260F5ABULL,
        0x280C146AA445BA8EULL,
        0xFB59B8E53EE8B0B3ULL,
    };
    for (int number = 0; number < kKinds; ++number) {
        const Painting painting = paint(1, number, 72);
        EXPECT_EQ(fingerprint(painting), kFingerprints[static_cast<std::size_t>(number)])
            << painting.title << ", number " << number;
    }
}

TEST(Gallery, AnotherSeedMakesOtherPictures) {
    for (int number = 0; number < kKinds; ++number)
        EXPECT_NE(paint(1, number, kSmall).rgb, paint(2, number, kSmall).rgb) << number;
}

TEST(Gallery, ASmallPictureShowsWhatTheLargeOneDoes) {
    // The composition must not depend on the size in pixels. Flames are made of chance
    // hits whose number follows the size, so they are held to the same bound only.
    for (int number = 0; number < 3 * kKinds; ++number) {
        const Painting small = paint(3, number, 96);
        const Painting large = paint(3, number, 192);
        EXPECT_LT(distance(layout(small), layout(large)), 16)
            << small.title << ", number " << number;
    }
}

TEST(Gallery, PicturesAreDifferentEnoughToBeToldApart) {
    constexpr int kCount = 120;
    std::vector<std::array<double, 48>> layouts;
    std::vector<std::string> titles;
    for (int number = 0; number < kCount; ++number) {
        const Painting painting = paint(1, number, 48);
        layouts.push_back(layout(painting));
        titles.push_back(painting.title);
    }
    for (std::size_t i = 0; i < layouts.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GT(distance(layouts[i], layouts[j]), 5)
                << titles[i] << " (" << i << ") and " << titles[j] << " (" << j << ")";
}

TEST(Gallery, NoPictureIsFlatOrNearlyBlack) {
    for (int number = 0; number < 120; ++number) {
        const Painting painting = paint(1, number, 48);
        double sum = 0;
        double squares = 0;
        for (const std::uint8_t value : painting.rgb) {
            sum += value;
            squares += static_cast<double>(value) * value;
        }
        const auto n = static_cast<double>(painting.rgb.size());
        EXPECT_GT(sum / n, 8) << painting.title << ", number " << number;
        EXPECT_GT(std::sqrt(squares / n - sum / n * (sum / n)), 10)
            << painting.title << ", number " << number;
    }
}

TEST(Gallery, SidesLieInTheGallerysRange) {
    std::set<int> sides;
    for (int number = 0; number < 300; ++number) {
        const int side = gallery_side(1, number);
        EXPECT_GE(side, 640);
        EXPECT_LE(side, 800);
        EXPECT_EQ(side, gallery_side(1, number));
        sides.insert(side);
    }
    EXPECT_GT(sides.size(), 15U);
}

}  // namespace
}  // namespace haarmony::gallery
