#include "server/app/cluster_overview.h"

#include <algorithm>
#include <optional>
#include <span>
#include <sstream>
#include <utility>

#include "engine/image/id_set.h"
#include "engine/image/signature_codec.h"
#include "ingest/variant.h"

namespace haarmony::server {
namespace {

constexpr std::size_t kKept = 8;

// All that an answer depends on but the filter.
std::string key_of(const OverviewOptions& options, std::int64_t sequence) {
    const image::Profile& profile = options.profile;
    std::ostringstream key;
    key << sequence << ' ' << options.count << ' ' << options.seed << ' '
        << image::kind_name(profile.kind) << ' ' << profile.m << ' '
        << image::bin_rule_name(profile.bin_rule);
    for (const auto& channel : profile.weights)
        for (const std::int32_t weight : channel) key << ' ' << weight;
    return key.str();
}

std::span<const std::uint8_t> bytes_of(const schema::SearchableImage& image,
                                       const std::string& variant) {
    if (variant == ingest::kMainVariant) return image.signature;
    for (const schema::SignatureVariant& other : image.variants)
        if (other.variant == variant) return other.signature;
    return {};
}

// The pictures that have a signature of that variant; damaged ones are left out, as they
// are out of a search.
Result<std::vector<image::Record>> records_of(schema::ImageStore& images,
                                              const std::string& variant,
                                              const image::IdSet* only) {
    std::vector<image::Record> records;
    const auto read =
        images.for_each_searchable([&](const schema::SearchableImage& image) {
            if (only != nullptr && !only->contains(image.id)) return;
            const auto bytes = bytes_of(image, variant);
            if (bytes.empty()) return;
            Result<image::Signature> signature = image::decode_signature(bytes);
            if (!signature) return;
            records.push_back({image.id, std::move(signature).value(), 0});
        });
    if (!read) return read.error();
    return records;
}

std::vector<ImageId> described_ids(const image::Cluster& cluster, int members) {
    std::vector<ImageId> ids = {cluster.medoid};
    for (const image::ClusterMember& member : cluster.members) {
        if (static_cast<int>(ids.size()) > members) break;
        if (member.id != cluster.medoid) ids.push_back(member.id);
    }
    return ids;
}

}  // namespace

ClusterOverview::ClusterOverview(const std::string& database_path,
                                 const IndexFollower& follower,
                                 int threads)
    : follower_(follower),
      readers_([path = database_path] {
          return Connection::open(path, schema::Database::Mode::kReadOnly);
      }),
      executor_(threads) {}

std::int64_t ClusterOverview::computed() {
    const std::lock_guard lock(mutex_);
    return computed_;
}

Result<std::shared_ptr<const image::Clustering>> ClusterOverview::clustering(
    const OverviewOptions& options,
    schema::ImageStore& images) {
    const bool filtered = !options.filter.text.empty() || !options.filter.tags.empty();
    std::optional<image::IdSet> only;
    if (filtered) {
        const auto ids = images.matching(options.filter);
        if (!ids) return ids.error();
        only.emplace(ids.value());
    }
    const std::lock_guard lock(mutex_);
    // Read before the pictures: what is kept is never older than its key.
    const std::string key = key_of(options, follower_.sequence());
    if (!filtered) {
        const auto found = std::ranges::find(kept_, key, &Kept::key);
        if (found != kept_.end()) return found->clustering;
    }
    const std::string variant =
        ingest::variant_name(options.profile.kind, ingest::Look::kWhole);
    const auto records = records_of(images, variant, only ? &*only : nullptr);
    if (!records) return records.error();
    image::ClusterOptions wanted;
    wanted.count = options.count;
    wanted.seed = options.seed;
    ++computed_;
    auto made = std::make_shared<const image::Clustering>(
        image::find_clusters(records.value(), options.profile, wanted, executor_));
    if (filtered) return made;
    kept_.push_front({key, made});
    if (kept_.size() > kKept) kept_.pop_back();
    return made;
}

Result<Overview> ClusterOverview::make(const OverviewOptions& options) {
    auto connection = readers_.lend();
    if (!connection) return connection.error();
    schema::ImageStore& images = (*connection)->images();
    const auto found = clustering(options, images);
    if (!found) return found.error();

    Overview overview;
    overview.cost = (*found)->cost;
    for (const image::Cluster& cluster : (*found)->clusters) {
        const auto size = static_cast<std::int64_t>(cluster.members.size());
        overview.searched += size;
        auto rows = images.get_many(described_ids(cluster, options.members));
        if (!rows) return rows.error();
        // Deleted since: the nearest that is left stands for it.
        if (rows->empty()) continue;
        schema::Image representative = rows->front();
        rows->resize(std::min(rows->size(), static_cast<std::size_t>(options.members)));
        overview.clusters.push_back({std::move(representative),
                                     cluster.low_information,
                                     size,
                                     std::move(rows).value()});
    }
    return overview;
}

}  // namespace haarmony::server
