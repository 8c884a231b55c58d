#include "tests/eval/search_options.h"

#include <algorithm>
#include <span>

#include "engine/image/autocrop.h"
#include "engine/image/best_of.h"
#include "engine/image/symmetry.h"
#include "engine/image/window.h"

namespace haarmony::eval {
namespace {

std::vector<image::Query> turned(const ImageView& picture,
                                 const image::Profile& profile,
                                 std::span<const image::Symmetry> symmetries) {
    const image::Signature signature = image::make_signature(picture, profile.kind);
    std::vector<image::Query> queries;
    for (const image::Symmetry symmetry : symmetries) {
        queries.push_back(image::make_query(
            image::transformed(signature, symmetry), profile, profile.m));
    }
    return queries;
}

std::vector<image::Query> mirrored(const ImageView& picture,
                                   const image::Profile& profile) {
    static constexpr image::Symmetry kMirror[] = {image::Symmetry::kIdentity,
                                                  image::Symmetry::kMirrorX};
    return turned(picture, profile, kMirror);
}

std::vector<image::Query> all_orientations(const ImageView& picture,
                                           const image::Profile& profile) {
    return turned(picture, profile, image::kSymmetries);
}

// The picture and, where it has borders, what is within them.
std::vector<image::Query> within_borders(const ImageView& picture,
                                         const image::Profile& profile) {
    const auto query_of = [&](const ImageView& view) {
        return image::make_query(
            image::make_signature(view, profile.kind), profile, profile.m);
    };
    std::vector<image::Query> queries{query_of(picture)};
    if (const auto box = image::content_box(picture))
        queries.push_back(query_of(image::cropped(picture, *box)));
    return queries;
}

std::vector<image::Query> parts_of_more(const ImageView& picture,
                                        const image::Profile& profile) {
    std::vector<image::Query> queries;
    for (const image::WindowSignature& window :
         image::window_signatures(picture, profile.kind)) {
        const image::Query query =
            image::make_query(window.signature, profile, profile.m);
        queries.push_back(
            queries.empty() ? query
                            : image::with_weight_sum(query, queries.front().weight_sum));
    }
    return queries;
}

}  // namespace

const std::vector<SearchOption>& search_options() {
    static const std::vector<SearchOption> options = {
        {"orientations=mirror", {"mirror"}, mirrored},
        {"orientations=all", {"identity", "mirror", "quarter turn"}, all_orientations},
        {"autocrop", {"identity", "white border 10 %", "letterbox"}, within_borders},
        {"partial",
         {"identity",
          "crop 10 % a side",
          "crop 20 % a side",
          "translation 10 %",
          "half painted 8 x 8"},
         parts_of_more},
    };
    return options;
}

std::int64_t rank_with(const SearchOption& option,
                       const WaveletSearch& search,
                       const ImageView& query,
                       const image::Profile& profile,
                       std::size_t target) {
    const std::vector<image::Query> queries = option.ways(query, profile);
    std::vector<image::Way> ways;
    for (const image::Query& way : queries) ways.push_back({&search.snapshot(), &way});
    const auto found = image::search_best(ways, {search.pictures()});
    const auto match =
        std::ranges::find(found.matches, id_of(target), &image::BestMatch::id);
    return match - found.matches.begin() + 1;
}

}  // namespace haarmony::eval
