#include "server/app/variant_indexes.h"

#include <utility>

#include "ingest/variant.h"

namespace haarmony::server {

VariantIndexes::VariantIndexes(const image::IndexOptions& options) : options_(options) {
    indexes_[ingest::kMainVariant] = std::make_unique<image::Index>(options_);
}

std::vector<std::pair<std::string, image::Index*>> VariantIndexes::indexes() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::pair<std::string, image::Index*>> all;
    for (const auto& [variant, index] : indexes_) all.emplace_back(variant, index.get());
    return all;
}

void VariantIndexes::apply(std::span<const SearchablePicture> pictures,
                           std::span<const ImageId> removals) {
    {
        const std::lock_guard lock(mutex_);
        for (const SearchablePicture& picture : pictures) {
            for (const auto& [variant, signature] : picture.signatures) {
                std::unique_ptr<image::Index>& index = indexes_[variant];
                if (index == nullptr) index = std::make_unique<image::Index>(options_);
            }
        }
    }
    for (const auto& [variant, index] : indexes()) {
        std::vector<image::Record> upserts;
        std::vector<ImageId> gone(removals.begin(), removals.end());
        for (const SearchablePicture& picture : pictures) {
            const auto found = picture.signatures.find(variant);
            if (found == picture.signatures.end()) {
                gone.push_back(picture.id);
            } else {
                upserts.push_back({picture.id, found->second, picture.log_aspect});
            }
        }
        index->apply(upserts, gone);
    }
}

void VariantIndexes::reset(SegmentsByVariant segments, image::SegmentOrigin origin) {
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [variant, _] : segments) {
            std::unique_ptr<image::Index>& index = indexes_[variant];
            if (index == nullptr) index = std::make_unique<image::Index>(options_);
        }
    }
    for (const auto& [variant, index] : indexes())
        index->reset(std::move(segments[variant]), origin);
}

bool VariantIndexes::merge_once() {
    bool merged = false;
    for (const auto& [variant, index] : indexes()) merged |= index->merge_once();
    return merged;
}

Snapshots VariantIndexes::snapshots() const {
    Snapshots snapshots;
    for (const auto& [variant, index] : indexes()) snapshots[variant] = index->snapshot();
    return snapshots;
}

SegmentsByVariant sealed(const Snapshots& snapshots) {
    SegmentsByVariant segments;
    for (const auto& [variant, snapshot] : snapshots)
        segments[variant] = snapshot->sealed();
    return segments;
}

image::IndexStats total_stats(const Snapshots& snapshots) {
    image::IndexStats total;
    for (const auto& [variant, snapshot] : snapshots) {
        const image::IndexStats stats = snapshot->stats();
        if (variant == ingest::kMainVariant) total.images = stats.images;
        total.tombstones += stats.tombstones;
        total.segments += stats.segments;
        total.tail += stats.tail;
        total.bytes += stats.bytes;
    }
    return total;
}

}  // namespace haarmony::server
