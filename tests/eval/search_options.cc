#include "tests/eval/search_options.h"

#include <algorithm>
#include <span>

#include "engine/image/autocrop.h"
#include "engine/image/best_of.h"
#include "engine/image/symmetry.h"
#include "engine/image/window.h"

namespace haarmony::eval {
namespace {

using Signatures = std::vector<image::Signature>;

Signatures turned(const ImageView& picture,
                  const image::SignatureKind& kind,
                  std::span<const image::Symmetry> symmetries) {
    const image::Signature signature = image::make_signature(picture, kind);
    Signatures ways;
    for (const image::Symmetry symmetry : symmetries)
        ways.push_back(image::transformed(signature, symmetry));
    return ways;
}

Signatures mirrored(const ImageView& picture, const image::SignatureKind& kind) {
    static constexpr image::Symmetry kMirror[] = {image::Symmetry::kIdentity,
                                                  image::Symmetry::kMirrorX};
    return turned(picture, kind, kMirror);
}

Signatures all_orientations(const ImageView& picture, const image::SignatureKind& kind) {
    return turned(picture, kind, image::kSymmetries);
}

// The picture and, where it has borders, what is within them.
Signatures within_borders(const ImageView& picture, const image::SignatureKind& kind) {
    Signatures ways{image::make_signature(picture, kind)};
    if (const auto box = image::content_box(picture))
        ways.push_back(image::make_signature(image::cropped(picture, *box), kind));
    return ways;
}

Signatures parts_of_more(const ImageView& picture, const image::SignatureKind& kind) {
    Signatures ways;
    for (const image::WindowSignature& window : image::window_signatures(picture, kind))
        ways.push_back(window.signature);
    return ways;
}

}  // namespace

const std::vector<SearchOption>& search_options() {
    static const std::vector<SearchOption> options = {
        {"orientations=mirror", {"mirror"}, mirrored, false},
        {"orientations=all",
         {"identity", "mirror", "quarter turn"},
         all_orientations,
         false},
        {"autocrop",
         {"identity", "white border 10 %", "letterbox"},
         within_borders,
         false},
        {"partial",
         {"identity",
          "crop 10 % a side",
          "crop 20 % a side",
          "translation 10 %",
          "half painted 8 x 8"},
         parts_of_more,
         true},
    };
    return options;
}

std::int64_t rank_with(const SearchOption& option,
                       const std::vector<image::Signature>& ways,
                       const WaveletSearch& search,
                       const image::Profile& profile,
                       std::size_t target) {
    std::vector<image::Query> queries;
    for (const image::Signature& way : ways) {
        queries.push_back(image::make_query(way, profile, profile.m));
        if (option.equal_weights) {
            queries.back() =
                image::with_weight_sum(queries.back(), queries.front().weight_sum);
        }
    }
    std::vector<image::Way> asked;
    for (const image::Query& query : queries)
        asked.push_back({&search.snapshot(), &query});
    const auto found = image::search_best(asked, {search.pictures()});
    const auto match =
        std::ranges::find(found.matches, id_of(target), &image::BestMatch::id);
    return match - found.matches.begin() + 1;
}

}  // namespace haarmony::eval
