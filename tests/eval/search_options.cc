#include "tests/eval/search_options.h"

#include <algorithm>
#include <span>

#include "engine/image/best_of.h"
#include "engine/image/symmetry.h"

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

}  // namespace

const std::vector<SearchOption>& search_options() {
    static const std::vector<SearchOption> options = {
        {"orientations=mirror", {"mirror"}, mirrored},
        {"orientations=all", {"identity", "mirror", "quarter turn"}, all_orientations},
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
