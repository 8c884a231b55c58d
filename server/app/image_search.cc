#include "server/app/image_search.h"

#include <utility>

namespace haarmony::server {
namespace {

// Both lists are in the order of rank; `rows` lacks those that are gone.
std::vector<FoundImage> join(const std::vector<Candidate>& candidates,
                             std::vector<schema::Image> rows,
                             int limit) {
    std::vector<FoundImage> found;
    auto candidate = candidates.begin();
    for (schema::Image& row : rows) {
        if (static_cast<int>(found.size()) == limit) break;
        while (candidate->id != row.id) ++candidate;
        found.push_back({std::move(row), *candidate});
    }
    return found;
}

}  // namespace

Result<Found> search_images(const SearchPlan& plan,
                            int limit,
                            const image::IdSet* only,
                            Executor* executor,
                            ReadConnections& connections) {
    // Each round asks for as many more as the last one lacked; the rounds end because the
    // snapshots do.
    std::chrono::nanoseconds ranking{};
    for (int wanted = limit;;) {
        const auto start = std::chrono::steady_clock::now();
        const Candidates candidates = plan.best(wanted, only, executor);
        ranking += std::chrono::steady_clock::now() - start;
        std::vector<ImageId> ids;
        for (const Candidate& candidate : candidates.best) ids.push_back(candidate.id);
        auto connection = connections.lend();
        if (!connection) return connection.error();
        auto rows = (*connection)->images().get_many(ids);
        if (!rows) return std::move(rows).error();
        const int missing = static_cast<int>(ids.size() - rows->size());
        if (candidates.exhausted || static_cast<int>(rows->size()) >= limit)
            return Found{join(candidates.best, std::move(rows).value(), limit),
                         candidates.searched,
                         ranking};
        wanted = limit + missing;
    }
}

}  // namespace haarmony::server
