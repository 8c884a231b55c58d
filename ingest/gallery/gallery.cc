#include "ingest/gallery/gallery.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <span>
#include <utility>

#include "ingest/gallery/canvas.h"
#include "ingest/gallery/painters.h"
#include "ingest/gallery/random.h"
#include "ingest/gallery/varnish.h"

namespace haarmony::gallery {
namespace {

// Width and height.
struct Format {
    int width;
    int height;
};

constexpr Format kBroad[] = {{3, 2}, {4, 3}, {16, 9}, {3, 2}, {1, 1}, {4, 5}};
constexpr Format kTall[] = {{3, 4}, {2, 3}, {4, 5}, {1, 1}, {4, 3}};
constexpr Format kAny[] = {{4, 3}, {1, 1}, {3, 4}, {3, 2}, {5, 4}};
constexpr Format kFlagFormats[] = {{3, 2}, {5, 3}, {2, 1}, {4, 3}, {1, 1}};

struct Kind {
    Label (*painter)(Canvas&, Commission&);
    std::span<const Format> formats;
    Varnish varnish;
};

// In an order in which neighbours differ most.
const std::array<Kind, kKinds>& kinds() {
    static const std::array<Kind, kKinds> kTable = {{
        {paint_landscape, kBroad, {}},
        {paint_flag, kFlagFormats, {.bloom = 0.05, .vignette = 0.08}},
        {paint_flower, kTall, {}},
        {paint_fractal, kAny, {.bloom = 0.1, .vignette = 0.06, .grain = 0.003}},
        {paint_still_life, kAny, {.bloom = 0.1, .vignette = 0.2}},
        {paint_seascape, kBroad, {}},
        {paint_tree, kTall, {}},
        {paint_flame, kAny, {.bloom = 0.25, .vignette = 0.05}},
        {paint_abstract, kAny, {.bloom = 0, .vignette = 0.04}},
        {paint_planet, kAny, {.bloom = 0.25, .vignette = 0.1}},
    }};
    return kTable;
}

constexpr double kGoldenRatio = 0.61803398874989485;
constexpr std::uint64_t kKindStream = 0x6B696E64;  // apart from the numbers of pictures
constexpr std::uint64_t kSideStream = 0x73696465;

}  // namespace

Painting paint(std::uint64_t seed, int number, int longest_side) {
    assert(number >= 0);
    assert(longest_side >= kLeastSide && longest_side <= kLargestSide);
    const int kind_index = number % kKinds;
    const Kind& kind = kinds()[static_cast<std::size_t>(kind_index)];

    // Another seed begins elsewhere in the cycle of scenes and of hues.
    Random of_kind(mix_seeds(seed, kKindStream + static_cast<std::uint64_t>(kind_index)));
    const int turn = number / kKinds + of_kind.below(64);
    const double first_hue = of_kind.unit();

    Commission commission{Random(mix_seeds(seed, static_cast<std::uint64_t>(number))),
                          turn,
                          fraction(first_hue + fraction(turn * kGoldenRatio))};
    const Format format = commission.random.pick(kind.formats);
    const int longer = std::max(format.width, format.height);
    const auto side = [&](int share) {
        return std::max(1, (longest_side * share + longer / 2) / longer);
    };
    Canvas canvas(side(format.width), side(format.height));
    Label label = kind.painter(canvas, commission);

    Varnish varnish = kind.varnish;
    varnish.seed = commission.random.noise_seed();
    apply(varnish, canvas);
    Painting painting{.title = std::move(label.title),
                      .kind = label.tags.front(),
                      .tags = std::move(label.tags),
                      .width = canvas.width(),
                      .height = canvas.height(),
                      .rgb = to_bytes(varnish, canvas)};
    return painting;
}

int gallery_side(std::uint64_t seed, int number) {
    Random random(
        mix_seeds(mix_seeds(seed, kSideStream), static_cast<std::uint64_t>(number)));
    return 640 + 8 * random.below(21);
}

}  // namespace haarmony::gallery
