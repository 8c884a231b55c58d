#include "server/app/find_duplicates_job.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/image/duplicates.h"
#include "engine/image/query.h"
#include "engine/image/signature_codec.h"
#include "engine/image/symmetric_metric.h"
#include "ingest/variant.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr int kFirstNeighbours = 32;
constexpr std::size_t kBatch = 256;  // pairs that are written together
constexpr std::chrono::milliseconds kLoadingPoll{20};

Result<double> read_least(const std::string& text) {
    const json request = json::parse(text, nullptr, false);
    const bool given = request.is_object() && request.contains("min_similarity");
    if (!request.is_object() || (given && !request["min_similarity"].is_number()))
        return Error{ErrorCode::kInvalidArgument,
                     "the request " + text + " is not understood"};
    const double least = given ? request["min_similarity"].get<double>() : 0.0;
    return std::max(least, image::kSimilarSimilarity);
}

class DuplicateSearch {
  public:
    DuplicateSearch(JobContext& job,
                    std::shared_ptr<const image::IndexSnapshot> snapshot,
                    int index_m,
                    double least)
        : job_(job),
          store_(job.connection().duplicates()),
          images_(job.connection().images()),
          snapshot_(std::move(snapshot)),
          profile_(image::duplicate_profile()),
          m_(std::min(profile_.m, index_m)),
          least_(least) {}

    // Fills a generation; true when it is whole.
    Result<bool> run(std::int64_t generation);

  private:
    Result<void> read_contents();
    Result<void> look_at(ImageId id);
    Result<std::optional<image::Signature>> signature(ImageId id);
    std::vector<ImageId> neighbours(const image::Query& query);
    Result<void> compare(ImageId id, const image::Signature& own, ImageId other);
    Result<void> write();

    JobContext& job_;
    schema::DuplicateStore& store_;
    schema::ImageStore& images_;
    const std::shared_ptr<const image::IndexSnapshot> snapshot_;
    const image::Profile profile_;
    const int m_;
    const double least_;
    std::int64_t generation_ = 0;
    std::unordered_map<std::int64_t, std::size_t> content_;  // id -> group of equal files
    std::set<std::pair<ImageId, ImageId>> compared_;  // as near as that from one side
    std::vector<schema::DuplicatePair> batch_;
};

Result<bool> DuplicateSearch::run(std::int64_t generation) {
    generation_ = generation;
    if (Result<void> read = read_contents(); !read) return read.error();
    const Result<std::vector<ImageId>> ids = images_.matching({});
    if (!ids) return ids.error();
    job_.set_total(static_cast<std::int64_t>(ids->size()));
    for (const ImageId id : ids.value()) {
        if (job_.cancelled()) return false;
        if (Result<void> looked = look_at(id); !looked) return looked.error();
        ++job_.counts().seen;
        job_.progress();
    }
    if (Result<void> written = write(); !written) return written.error();
    return true;
}

Result<void> DuplicateSearch::read_contents() {
    const auto groups = store_.same_content();
    if (!groups) return groups.error();
    for (std::size_t group = 0; group < groups->size(); ++group)
        for (const ImageId id : (*groups)[group]) content_.emplace(to_int(id), group);
    return {};
}

// Nothing where the picture is gone or its signature is damaged.
Result<std::optional<image::Signature>> DuplicateSearch::signature(ImageId id) {
    const auto bytes = images_.signature(id);
    if (!bytes && bytes.error().code == ErrorCode::kNotFound)
        return std::optional<image::Signature>();
    if (!bytes) return bytes.error();
    Result<image::Signature> signature = image::decode_signature(bytes.value());
    if (!signature) return std::optional<image::Signature>();
    return std::optional<image::Signature>(std::move(signature).value());
}

Result<void> DuplicateSearch::look_at(ImageId id) {
    const auto bytes = images_.signature(id);
    if (!bytes && bytes.error().code != ErrorCode::kNotFound) return bytes.error();
    if (!bytes) {
        ++job_.counts().skipped;
        return {};
    }
    const Result<image::Signature> own = image::decode_signature(bytes.value());
    if (!own) {
        job_.fail("image " + std::to_string(to_int(id)) +
                  ": the stored signature is damaged: " + own.error().message);
        return {};
    }
    if (own->low_information) {
        ++job_.counts().skipped;
        return {};
    }
    for (const ImageId other : neighbours(image::make_query(own.value(), profile_, m_))) {
        if (other == id) continue;
        if (Result<void> compared = compare(id, own.value(), other); !compared)
            return compared;
    }
    return batch_.size() < kBatch ? Result<void>() : write();
}

// All that the query finds similar enough, or the nearest of them.
std::vector<ImageId> DuplicateSearch::neighbours(const image::Query& query) {
    for (int wanted = kFirstNeighbours;; wanted *= 4) {
        const image::SearchResult found =
            snapshot_->search(query, {std::min(wanted, kMaxNeighbours), nullptr});
        std::vector<ImageId> near;
        for (const image::Match& match : found.matches) {
            if (image::similarity(query, match.score) < least_) return near;
            near.push_back(match.id);
        }
        if (static_cast<int>(found.matches.size()) < wanted || wanted >= kMaxNeighbours)
            return near;
    }
}

Result<void> DuplicateSearch::compare(ImageId id,
                                      const image::Signature& own,
                                      ImageId other) {
    const auto content = content_.find(to_int(id));
    const auto other_content = content_.find(to_int(other));
    const bool same_bytes = content != content_.end() &&
                            other_content != content_.end() &&
                            content->second == other_content->second;
    if (same_bytes) return {};
    const std::pair pair{std::min(id, other), std::max(id, other)};
    if (!compared_.insert(pair).second) return {};
    const auto theirs = signature(other);
    if (!theirs) return theirs.error();
    if (!*theirs) return {};
    image::Resemblance resemblance;
    resemblance.similarity = image::mutual_similarity(own, **theirs, profile_, m_);
    resemblance.low_information = (*theirs)->low_information;
    const auto level = image::level_of(resemblance);
    if (!level || resemblance.similarity < least_) return {};
    batch_.push_back({pair.first,
                      pair.second,
                      std::string(image::duplicate_level_name(*level)),
                      resemblance.similarity});
    ++job_.counts().added;
    return {};
}

Result<void> DuplicateSearch::write() {
    if (Result<void> added = store_.add(generation_, batch_); !added) return added;
    batch_.clear();
    return {};
}

// A generation that an earlier run left behind when it died.
void discard_left_over(JobContext& job) {
    const std::string& position = job.position();
    std::int64_t generation = 0;
    std::from_chars(position.data(), position.data() + position.size(), generation);
    // Published or replaced meanwhile, it is not there to be discarded.
    if (generation > 0) (void)job.connection().duplicates().discard(generation);
}

Result<void> find_duplicates(JobContext& job, const IndexFollower& follower) {
    discard_left_over(job);
    const Result<double> least = read_least(job.request());
    if (!least) return least.error();
    while (!follower.ready()) {
        if (job.cancelled()) return {};
        std::this_thread::sleep_for(kLoadingPoll);
    }
    schema::DuplicateStore& store = job.connection().duplicates();
    const Result<std::int64_t> generation = store.begin_generation();
    if (!generation) return generation.error();
    job.set_position(std::to_string(*generation));
    if (Result<void> written = job.write(); !written) return written;
    Result<bool> whole =
        DuplicateSearch(job, follower.snapshot(), follower.index_m(), *least)
            .run(*generation);
    if (whole && *whole) {
        job.note("pairs", job.counts().added);
        return store.publish(*generation);
    }
    Result<void> discarded = store.discard(*generation);
    if (!whole) return std::move(whole).error();
    return discarded;
}

}  // namespace

JobType find_duplicates_job(const IndexFollower& follower) {
    return {[&follower](JobContext& job) { return find_duplicates(job, follower); }};
}

}  // namespace haarmony::server
