#include "engine/image/best_of.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace haarmony::image {
namespace {

void append(std::span<const Match> matches,
            const Way& way,
            std::size_t number,
            std::vector<BestMatch>& out) {
    for (const Match& match : matches) {
        out.push_back(
            {match.id, full_distance(*way.query, match.score), number, match.score});
    }
}

// In rising order of id, each at its smallest distance.
void keep_best(std::vector<BestMatch>& matches) {
    std::ranges::sort(matches, {}, [](const BestMatch& match) {
        return std::tuple(match.id, match.distance, match.way);
    });
    // clang 14, which fuzzes, cannot compile the subrange of std::ranges::unique.
    const auto repeated = std::unique(
        matches.begin(), matches.end(), [](const BestMatch& a, const BestMatch& b) {
            return a.id == b.id;
        });
    matches.erase(repeated, matches.end());
}

}  // namespace

BestResult search_best(std::span<const Way> ways, const SearchScope& scope) {
    assert(!ways.empty());
    BestResult best;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const SearchResult found = ways[i].snapshot->search(*ways[i].query, scope);
        append(found.matches, ways[i], i, best.matches);
        if (i == 0) best.searched = found.searched;
    }
    keep_best(best.matches);
    std::ranges::sort(best.matches, {}, [](const BestMatch& match) {
        return std::tuple(match.distance, match.id);
    });
    if (best.matches.size() > std::size_t(scope.limit))
        best.matches.resize(std::size_t(scope.limit));
    return best;
}

std::vector<BestMatch> score_all_best(std::span<const Way> ways, const IdSet* only) {
    assert(!ways.empty());
    std::vector<BestMatch> matches;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        append(ways[i].snapshot->score_all(*ways[i].query, only), ways[i], i, matches);
    }
    keep_best(matches);
    return matches;
}

}  // namespace haarmony::image
