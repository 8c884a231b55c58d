// Any number of pictures from a few photos: cuts, mirrored, recoloured, blended or put side
// by side. What a picture is made of is a recipe of a few numbers, so that it can be made
// again, a little different.
//
// Shape   a rendered picture is kSide x kSide RGB bytes.
// Units   places and lengths in shares of the photo's sides.
// Threads const-safe.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/image/signature.h"
#include "ingest/gallery/random.h"
#include "tests/eval/degrade.h"

namespace haarmony::eval {

// Colours of a cut: byte v becomes gain * 255 * (v / 255)^gamma, then its distance from grey
// times `saturation`.
struct Recolouring {
    std::array<double, 3> gain{1, 1, 1};
    double gamma = 1;
    double saturation = 1;
};

struct Cut {
    int photo = 0;
    double left = 0;
    double top = 0;
    double width = 1;
    double height = 1;
    bool mirrored = false;
    Recolouring colours;
};

enum class Composition : std::uint8_t { kSingle, kBlend, kHalves, kQuarters };

struct PictureRecipe {
    Composition composition = Composition::kSingle;
    std::array<Cut, 4> cuts{};  // the first 1, 2, 2 or 4 of them
    double share = 0.5;         // of the first cut in a blend, or of the first half
    bool upright = false;       // halves side by side, or one above the other
};

[[nodiscard]] int cuts_of(Composition composition);

// Of photos [first, end). Requires: first < end.
[[nodiscard]] PictureRecipe random_recipe(int first, int end, gallery::Random& random);

// Nearly the same picture: edges moved by up to 2 % and colours changed by up to 8 %.
[[nodiscard]] PictureRecipe varied(PictureRecipe recipe, gallery::Random& random);

// Renders recipes. Cost: about 0.1 ms of one core a picture.
class PictureKitchen {
  public:
    // Keeps a reference to the photos. Requires: at least one.
    explicit PictureKitchen(const std::vector<RgbPicture>& photos);

    [[nodiscard]] RgbPicture render(const PictureRecipe& recipe) const;

  private:
    const std::vector<RgbPicture>& photos_;
    std::vector<RgbPicture> halved_;  // for cuts that are shrunk by more than a half
};

}  // namespace haarmony::eval
