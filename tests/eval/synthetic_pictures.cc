#include "tests/eval/synthetic_pictures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace haarmony::eval {
namespace {

using gallery::Random;

struct Box {
    int x = 0;
    int y = 0;
    int width = image::kSide;
    int height = image::kSide;
};

Recolouring random_colours(Random& random) {
    Recolouring colours;
    const double brightness = random.between(0.8, 1.2);
    for (double& gain : colours.gain) gain = brightness * random.between(0.93, 1.07);
    colours.gamma = std::exp(random.between(-0.3, 0.3));
    colours.saturation = random.between(0.6, 1.3);
    return colours;
}

Cut random_cut(int first, int end, Random& random) {
    Cut cut;
    cut.photo = first + random.below(end - first);
    cut.width = random.between(0.4, 1.0);
    cut.height = std::clamp(cut.width * std::exp(random.between(-0.25, 0.25)), 0.3, 1.0);
    cut.left = random.between(0, 1 - cut.width);
    cut.top = random.between(0, 1 - cut.height);
    cut.mirrored = random.chance(0.5);
    cut.colours = random_colours(random);
    return cut;
}

// Where one output pixel reads along a side: two neighbours and the second one's share of
// 256.
struct Tap {
    int at = 0;
    int next = 0;
    std::uint32_t share = 0;
};

std::vector<Tap> taps(int side, double first, double length, int count, bool mirrored) {
    std::vector<Tap> result(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const int from = mirrored ? count - 1 - i : i;
        const double centre = (first + (from + 0.5) / count * length) * side - 0.5;
        const double place = std::clamp(centre, 0.0, double(side - 1));
        const int at = static_cast<int>(place);
        result[i] = {at,
                     std::min(at + 1, side - 1),
                     static_cast<std::uint32_t>(std::lround((place - at) * 256))};
    }
    return result;
}

std::array<std::array<std::uint8_t, 256>, 3> tone_tables(const Recolouring& colours) {
    std::array<std::array<std::uint8_t, 256>, 3> tables{};
    for (int v = 0; v < 256; ++v) {
        const double tone = 255 * std::pow(v / 255.0, colours.gamma);
        for (int c = 0; c < 3; ++c) {
            tables[c][v] = static_cast<std::uint8_t>(
                std::lround(std::min(255.0, colours.gain[c] * tone)));
        }
    }
    return tables;
}

// One row of a box, a channel at a time: what follows reading works on whole vectors.
using PlanarRow = std::array<std::array<std::int32_t, image::kSide>, 3>;

// `vivid` is the saturation in 1/256.
void saturate(PlanarRow& row, int vivid) {
    for (int x = 0; x < image::kSide; ++x) {
        const int grey = (77 * row[0][x] + 150 * row[1][x] + 29 * row[2][x]) / 256;
        for (auto& channel : row) {
            channel[x] = std::clamp(grey + (channel[x] - grey) * vivid / 256, 0, 255);
        }
    }
}

// The cut, scaled into a box of the square.
void paint_cut(const RgbPicture& photo, const Cut& cut, const Box& box, RgbPicture& out) {
    const auto columns = taps(photo.width, cut.left, cut.width, box.width, cut.mirrored);
    const auto rows = taps(photo.height, cut.top, cut.height, box.height, false);
    const auto tables = tone_tables(cut.colours);
    const int vivid = static_cast<int>(std::lround(cut.colours.saturation * 256));
    const auto samples = static_cast<std::size_t>(photo.width) * 3;
    std::vector<std::uint16_t> blended(samples);
    PlanarRow planar{};
    for (int y = 0; y < box.height; ++y) {
        const std::uint8_t* upper = photo.rgb.data() + rows[y].at * samples;
        const std::uint8_t* lower = photo.rgb.data() + rows[y].next * samples;
        const std::uint32_t share = rows[y].share;
        for (std::size_t i = 0; i < samples; ++i) {
            blended[i] =
                static_cast<std::uint16_t>(upper[i] * (256 - share) + lower[i] * share);
        }
        for (int x = 0; x < box.width; ++x) {
            const Tap& tap = columns[x];
            for (int c = 0; c < 3; ++c) {
                const std::uint32_t value = blended[tap.at * 3 + c] * (256 - tap.share) +
                                            blended[tap.next * 3 + c] * tap.share;
                planar[c][x] = tables[c][(value + 32768) >> 16];
            }
        }
        saturate(planar, vivid);
        std::uint8_t* const row =
            out.rgb.data() + (std::size_t(box.y + y) * image::kSide + box.x) * 3;
        for (int x = 0; x < box.width; ++x) {
            for (int c = 0; c < 3; ++c)
                row[x * 3 + c] = static_cast<std::uint8_t>(planar[c][x]);
        }
    }
}

std::array<Box, 4> boxes_of(const PictureRecipe& recipe) {
    constexpr int kSide = image::kSide;
    constexpr int kHalf = kSide / 2;
    switch (recipe.composition) {
        case Composition::kSingle:
        case Composition::kBlend:
            return {};
        case Composition::kHalves: {
            const int split = std::clamp(
                static_cast<int>(std::lround(recipe.share * kSide)), 1, kSide - 1);
            if (recipe.upright)
                return {Box{0, 0, kSide, split}, Box{0, split, kSide, kSide - split}};
            return {Box{0, 0, split, kSide}, Box{split, 0, kSide - split, kSide}};
        }
        case Composition::kQuarters:
            break;
    }
    return {Box{0, 0, kHalf, kHalf},
            Box{kHalf, 0, kHalf, kHalf},
            Box{0, kHalf, kHalf, kHalf},
            Box{kHalf, kHalf, kHalf, kHalf}};
}

RgbPicture empty_square() {
    return {image::kSide,
            image::kSide,
            std::vector<std::uint8_t>(std::size_t{image::kCoefficientCount} * 3)};
}

}  // namespace

int cuts_of(Composition composition) {
    switch (composition) {
        case Composition::kSingle:
            return 1;
        case Composition::kBlend:
        case Composition::kHalves:
            return 2;
        case Composition::kQuarters:
            break;
    }
    return 4;
}

PictureRecipe random_recipe(int first, int end, Random& random) {
    assert(first < end);
    PictureRecipe recipe;
    const double kind = random.unit();
    if (kind < 0.7) {
        recipe.composition = Composition::kSingle;
    } else if (kind < 0.9) {
        recipe.composition = Composition::kBlend;
    } else {
        recipe.composition = kind < 0.97 ? Composition::kHalves : Composition::kQuarters;
    }
    for (int i = 0; i < cuts_of(recipe.composition); ++i)
        recipe.cuts[i] = random_cut(first, end, random);
    recipe.share = random.between(0.25, 0.75);
    recipe.upright = random.chance(0.5);
    return recipe;
}

PictureRecipe varied(PictureRecipe recipe, Random& random) {
    const auto nearly = [&](double value) { return value * random.between(0.92, 1.08); };
    for (int i = 0; i < cuts_of(recipe.composition); ++i) {
        Cut& cut = recipe.cuts[i];
        cut.width = std::min(1.0, cut.width * random.between(0.98, 1.02));
        cut.height = std::min(1.0, cut.height * random.between(0.98, 1.02));
        const auto moved = [&](double place, double length) {
            return std::clamp(
                place + random.between(-0.02, 0.02) * length, 0.0, 1.0 - length);
        };
        cut.left = moved(cut.left, cut.width);
        cut.top = moved(cut.top, cut.height);
        for (double& gain : cut.colours.gain) gain = nearly(gain);
        cut.colours.gamma = nearly(cut.colours.gamma);
        cut.colours.saturation = nearly(cut.colours.saturation);
    }
    return recipe;
}

PictureKitchen::PictureKitchen(const std::vector<RgbPicture>& photos) : photos_(photos) {
    assert(!photos.empty());
    for (const RgbPicture& photo : photos) {
        halved_.push_back(
            resize(photo, std::max(1, photo.width / 2), std::max(1, photo.height / 2)));
    }
}

RgbPicture PictureKitchen::render(const PictureRecipe& recipe) const {
    const auto boxes = boxes_of(recipe);
    const auto paint = [&](int i, RgbPicture& square) {
        const Cut& cut = recipe.cuts[i];
        const RgbPicture& photo = photos_[cut.photo];
        const bool far = cut.width * photo.width > 1.5 * boxes[i].width ||
                         cut.height * photo.height > 1.5 * boxes[i].height;
        paint_cut(far ? halved_[cut.photo] : photo, cut, boxes[i], square);
    };
    RgbPicture square = empty_square();
    for (int i = 0; i < cuts_of(recipe.composition); ++i) {
        if (recipe.composition == Composition::kBlend && i == 1) break;
        paint(i, square);
    }
    if (recipe.composition == Composition::kBlend) {
        RgbPicture second = empty_square();
        paint(1, second);
        const auto share = static_cast<std::uint32_t>(std::lround(recipe.share * 256));
        for (std::size_t i = 0; i < square.rgb.size(); ++i) {
            square.rgb[i] = static_cast<std::uint8_t>(
                (square.rgb[i] * share + second.rgb[i] * (256 - share) + 128) / 256);
        }
    }
    return square;
}

}  // namespace haarmony::eval
