#include "server/app/search_plan.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

#include "engine/image/window.h"
#include "ingest/variant.h"

namespace haarmony::server {
namespace {

using image::Symmetry;

// Smaller collections are searched before another thread would have woken up.
constexpr std::int64_t kWorthSharing = 65536;

std::span<const Symmetry> symmetries_of(Orientations orientations) {
    const std::span<const Symmetry> all(image::kSymmetries);
    switch (orientations) {
        case Orientations::kNone:
            return all.first(1);
        case Orientations::kMirror:
            return all.first(2);
        case Orientations::kAll:
            break;
    }
    return all;
}

// All ways to ask for the picture under one profile. Windows have different numbers of
// coefficients; their weights are made to add up to those of the first.
std::vector<PlannedWay> ways_of(std::span<const image::Signature> windows,
                                const QueryPicture& picture,
                                const PlanOptions& options,
                                const image::Profile& profile,
                                int m,
                                const Snapshots& snapshots) {
    std::vector<std::string> variants = {
        ingest::variant_name(profile.kind, ingest::Look::kWhole)};
    const std::string content =
        ingest::variant_name(profile.kind, ingest::Look::kContent);
    if (options.content && snapshots.contains(content)) variants.push_back(content);

    std::vector<PlannedWay> ways;
    for (const Symmetry symmetry : symmetries_of(options.orientations)) {
        for (std::size_t i = 0; i < windows.size(); ++i) {
            PlannedWay way;
            way.symmetry = symmetry;
            way.signature = image::transformed(windows[i], symmetry);
            way.query = image::make_query(way.signature, profile, m);
            if (i > 0)
                way.query =
                    image::with_weight_sum(way.query, ways.front().query.weight_sum);
            if (options.aspect_weight > 0) {
                const std::int32_t upright = *picture.log_aspect;
                way.query.log_aspect = image::swaps_sides(symmetry) ? -upright : upright;
                way.query.aspect_weight = options.aspect_weight;
            }
            for (const std::string& variant : variants) {
                way.variant = variant;
                ways.push_back(way);
            }
        }
    }
    return ways;
}

}  // namespace

Result<SearchPlan> SearchPlan::make(const QueryPicture& picture,
                                    const PlanOptions& options,
                                    const Snapshots& snapshots,
                                    int index_m) {
    assert(!options.profiles.empty());
    if (options.aspect_weight > 0 && !picture.log_aspect)
        return Error{ErrorCode::kInvalidArgument,
                     "an aspect_weight above 0 needs a picture: a signature has no shape",
                     "aspect_weight"};
    SearchPlan plan;
    plan.snapshots_ = snapshots;
    plan.combine_ = options.combine || options.profiles.size() > 1;
    plan.combine_by_ = options.combine_by;
    plan.min_similarity_ = options.min_similarity;
    for (const image::Profile& profile : options.profiles) {
        const std::string kind = image::kind_name(profile.kind);
        if (!snapshots.contains(ingest::variant_name(profile.kind, ingest::Look::kWhole)))
            return Error{ErrorCode::kConflict,
                         "no picture has a signature of the kind " + kind +
                             " that the profile '" + profile.name +
                             "' compares: a job of the type 'reindex' makes them",
                         "profile"};
        const auto windows = picture.signatures.find(profile.kind);
        if (windows == picture.signatures.end())
            return Error{ErrorCode::kInvalidArgument,
                         "the query has no signature of the kind " + kind +
                             " that the profile '" + profile.name + "' compares",
                         "profile"};
        const int m = std::min(options.m.value_or(profile.m), index_m);
        plan.metrics_.push_back(
            ways_of(windows->second, picture, options, profile, m, snapshots));
    }
    return plan;
}

Candidates SearchPlan::best(int limit,
                            const image::IdSet* only,
                            Executor* executor) const {
    assert(limit >= 1);
    return combine_ ? best_of_ranks(limit, only, executor)
                    : best_of_one(limit, only, executor);
}

std::vector<image::Way> SearchPlan::asked(const Metric& metric) const {
    std::vector<image::Way> ways;
    for (const PlannedWay& way : metric)
        ways.push_back({snapshots_.find(way.variant)->second.get(), &way.query});
    return ways;
}

Candidate SearchPlan::candidate(const image::BestMatch& match) const {
    const image::Query& query = ways()[match.way].query;
    return {match.id,
            image::distance(query, match.score),
            image::similarity(query, match.score),
            match.way,
            std::nullopt};
}

bool SearchPlan::similar_enough(const Candidate& candidate) const {
    return !min_similarity_ || candidate.similarity >= *min_similarity_;
}

Candidates SearchPlan::best_of_one(int limit,
                                   const image::IdSet* only,
                                   Executor* executor) const {
    const std::vector<image::Way> asked_ways = asked(metrics_[0]);
    if (asked_ways[0].snapshot->stats().images < kWorthSharing) executor = nullptr;
    // Beyond this distance no way calls a picture similar enough.
    std::int64_t heaviest = 0;
    for (const PlannedWay& way : ways())
        heaviest = std::max(heaviest, way.query.weight_sum);
    // A little further, for the rounding of both sides.
    const double too_far = static_cast<double>(heaviest) / 100.0 *
                           (1.0 - min_similarity_.value_or(0.0) + 1e-9);

    for (int wanted = limit;;) {
        const image::BestResult found =
            image::search_best(asked_ways, {wanted, only, executor});
        Candidates candidates;
        candidates.searched = found.searched;
        candidates.exhausted = static_cast<int>(found.matches.size()) < wanted;
        for (const image::BestMatch& match : found.matches) {
            const Candidate next = candidate(match);
            if (similar_enough(next)) candidates.best.push_back(next);
            if (min_similarity_ && next.distance > too_far) candidates.exhausted = true;
        }
        if (static_cast<int>(candidates.best.size()) >= limit) {
            candidates.exhausted =
                candidates.exhausted && static_cast<int>(candidates.best.size()) == limit;
            candidates.best.resize(static_cast<std::size_t>(limit));
            return candidates;
        }
        if (candidates.exhausted) return candidates;
        wanted *= 2;
    }
}

Candidates SearchPlan::best_of_ranks(int limit,
                                     const image::IdSet* only,
                                     Executor* executor) const {
    std::vector<std::vector<image::BestMatch>> all(metrics_.size());
    InlineExecutor alone;
    Executor& threads = executor != nullptr ? *executor : alone;
    threads.parallel_for(metrics_.size(), [&](std::size_t i) {
        all[i] = image::score_all_best(asked(metrics_[i]), only);
    });
    Candidates candidates;
    candidates.searched = static_cast<std::int64_t>(all[0].size());
    const auto count = static_cast<double>(metrics_.size());
    for (const image::CombinedMatch& match :
         image::combine_ranks(all, combine_by_, static_cast<int>(all[0].size()))) {
        Candidate next = candidate(match.first);
        if (!similar_enough(next)) continue;
        if (static_cast<int>(candidates.best.size()) == limit) return candidates;
        const auto rank = static_cast<double>(match.rank);
        next.combined_rank = combine_by_ == image::CombineBy::kMean ? rank / count : rank;
        candidates.best.push_back(next);
    }
    candidates.exhausted = true;
    return candidates;
}

}  // namespace haarmony::server
