#include "server/app/image_search.h"

#include <algorithm>
#include <utility>

namespace haarmony::server {
namespace {

// Similarity falls as the score grows, so what is too far off is the tail of the list.
void cut_below(double min_similarity,
               const image::Query& query,
               std::vector<image::Match>& matches) {
    const auto first_below =
        std::find_if(matches.begin(), matches.end(), [&](const image::Match& match) {
            return image::similarity(query, match.score) < min_similarity;
        });
    matches.erase(first_below, matches.end());
}

// Both lists are in the order of rank; `rows` lacks those that are gone.
std::vector<FoundImage> join(const image::Query& query,
                             const std::vector<image::Match>& matches,
                             std::vector<schema::Image> rows,
                             int limit) {
    std::vector<FoundImage> found;
    auto match = matches.begin();
    for (schema::Image& row : rows) {
        if (static_cast<int>(found.size()) == limit) break;
        while (match->id != row.id) ++match;
        found.push_back({std::move(row),
                         image::distance(query, match->score),
                         image::similarity(query, match->score)});
    }
    return found;
}

}  // namespace

Result<Found> search_images(const image::IndexSnapshot& snapshot,
                            const image::Query& query,
                            int limit,
                            std::optional<double> min_similarity,
                            ReadConnections& connections) {
    // Each round asks for as many more as the last one lacked; the rounds end because the
    // snapshot does.
    for (int wanted = limit;;) {
        image::SearchResult result = snapshot.search(query, {wanted});
        const bool exhausted = static_cast<int>(result.matches.size()) < wanted;
        const std::size_t ranked = result.matches.size();
        if (min_similarity) cut_below(*min_similarity, query, result.matches);
        const bool complete = exhausted || result.matches.size() < ranked;

        std::vector<ImageId> ids;
        for (const image::Match& match : result.matches) ids.push_back(match.id);
        auto connection = connections.lend();
        if (!connection) return connection.error();
        auto rows = (*connection)->images().get_many(ids);
        if (!rows) return std::move(rows).error();
        const int missing = static_cast<int>(ids.size() - rows->size());
        if (complete || static_cast<int>(rows->size()) >= limit)
            return Found{join(query, result.matches, std::move(rows).value(), limit),
                         result.searched};
        wanted = limit + missing;
    }
}

}  // namespace haarmony::server
