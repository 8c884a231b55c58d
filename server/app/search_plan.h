// From what is asked for to the searches that answer it (sections 4.2 and 4.6):
//   query_picture, profiles -> [search_plan] -> image_search
//
// For each profile the picture is asked for in one or more ways: as it is, mirrored, turned;
// as a part of something larger; among whole pictures and, with `content`, among what is
// within their borders. Several profiles combine their ranks.
//
// Errors   see make().
// Threads  const-safe once made.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/executor.h"
#include "engine/core/result.h"
#include "engine/image/best_of.h"
#include "engine/image/combined_rank.h"
#include "engine/image/id_set.h"
#include "engine/image/profile.h"
#include "engine/image/symmetry.h"
#include "server/app/query_picture.h"
#include "server/app/variant_indexes.h"

namespace haarmony::server {

enum class Orientations { kNone, kMirror, kAll };

struct PlanOptions {
    std::vector<image::Profile> profiles;  // at least one; more: their ranks are combined
    bool combine = false;                  // say the rank under one profile, too
    image::CombineBy combine_by = image::CombineBy::kMean;
    std::optional<int> m;  // the profile's where absent
    Orientations orientations = Orientations::kNone;
    bool content = false;            // also what is within the borders of a picture
    std::int32_t aspect_weight = 0;  // in 1/100
    std::optional<double> min_similarity;
};

// One way to ask.
struct PlannedWay {
    image::Symmetry symmetry{};
    std::string variant;         // the index that is asked
    image::Signature signature;  // the query's, so turned
    image::Query query;
};

struct Candidate {
    ImageId id{};
    double distance = 0;    // equation (4.3) under the first profile, at its best way
    double similarity = 0;  // 0..1
    std::size_t way = 0;    // of the first profile
    std::optional<double> combined_rank;
};

struct Candidates {
    std::vector<Candidate> best;  // best first
    std::int64_t searched = 0;
    bool exhausted = false;  // there are no others, however many are asked for
};

class SearchPlan {
  public:
    // kConflict where no picture has a signature of a profile's kind; kInvalidArgument where
    // the query has none, or no shape for an aspect weight; each naming what is missing.
    // Requires: no profile's m is above 100.
    [[nodiscard]] static Result<SearchPlan> make(const QueryPicture& picture,
                                                 const PlanOptions& options,
                                                 const Snapshots& snapshots,
                                                 int index_m);

    // The `limit` best that are similar enough, exactly; with an executor, sooner where it
    // has threads to spare. Requires: limit >= 1.
    [[nodiscard]] Candidates best(int limit,
                                  const image::IdSet* only,
                                  Executor* executor) const;

    // Of the first profile; Candidate::way counts them.
    [[nodiscard]] const std::vector<PlannedWay>& ways() const { return metrics_[0]; }
    // That was used under the first profile: never above the index's.
    [[nodiscard]] int m() const { return ways().front().query.m; }

  private:
    using Metric = std::vector<PlannedWay>;

    SearchPlan() = default;
    [[nodiscard]] std::vector<image::Way> asked(const Metric& metric) const;
    [[nodiscard]] Candidates best_of_one(int limit,
                                         const image::IdSet* only,
                                         Executor* executor) const;
    [[nodiscard]] Candidates best_of_ranks(int limit,
                                           const image::IdSet* only,
                                           Executor* executor) const;
    [[nodiscard]] Candidate candidate(const image::BestMatch& match) const;
    [[nodiscard]] bool similar_enough(const Candidate& candidate) const;

    Snapshots snapshots_;
    std::vector<Metric> metrics_;
    bool combine_ = false;
    image::CombineBy combine_by_ = image::CombineBy::kMean;
    std::optional<double> min_similarity_;
};

}  // namespace haarmony::server
