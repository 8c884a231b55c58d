// The search indexes of the daemon: one for each variant of signature that the collection
// has (ingest/variant.h), made when the first picture with it appears.
//
// Threads  apply() by one thread at a time; the rest from any thread at any time. Each index
//          shows one step of changes at once; two indexes may be a moment apart.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "engine/core/ids.h"
#include "engine/image/index.h"
#include "engine/image/segment.h"
#include "engine/image/signature.h"

namespace haarmony::server {

// All signatures of one picture, by variant.
struct SearchablePicture {
    ImageId id{};
    std::int32_t log_aspect = 0;
    std::map<std::string, image::Signature, std::less<>> signatures;
};

using Snapshots =
    std::map<std::string, std::shared_ptr<const image::IndexSnapshot>, std::less<>>;

using SegmentsByVariant =
    std::map<std::string, std::vector<image::LiveSegment>, std::less<>>;

class VariantIndexes {
  public:
    // The index of kMainVariant is there from the start.
    explicit VariantIndexes(const image::IndexOptions& options);

    // Puts each picture into the indexes of its variants and out of all others, then takes
    // `removals` out of all.
    void apply(std::span<const SearchablePicture> pictures,
               std::span<const ImageId> removals);

    // Holds what the segments hold, and nothing else. No apply() at the same time.
    void reset(SegmentsByVariant segments, image::SegmentOrigin origin);

    // As Index::merge_once(), of all indexes.
    bool merge_once();

    [[nodiscard]] Snapshots snapshots() const;
    [[nodiscard]] int index_m() const { return options_.index_m; }

  private:
    [[nodiscard]] std::vector<std::pair<std::string, image::Index*>> indexes() const;

    const image::IndexOptions options_;
    mutable std::mutex mutex_;  // guards the map, not the indexes
    std::map<std::string, std::unique_ptr<image::Index>> indexes_;
};

// All pictures of all of them, as segments. Cost: a segment for each tail.
[[nodiscard]] SegmentsByVariant sealed(const Snapshots& snapshots);

// All of them together.
[[nodiscard]] image::IndexStats total_stats(const Snapshots& snapshots);

}  // namespace haarmony::server
