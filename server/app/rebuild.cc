#include "server/app/rebuild.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <optional>

#include "engine/image/segment.h"
#include "server/app/lending_pool.h"
#include "server/app/stored_signatures.h"

namespace haarmony::server {
namespace {

// Fewer pictures are not worth another segment: its directory alone has 192 KB.
constexpr std::int64_t kFewPictures = 8192;

std::int64_t ceil_divide(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

Error stopped() {
    return {ErrorCode::kUnavailable, "loading the signatures was stopped"};
}

using PicturesPool = LendingPool<StoredPictures>;

Result<Rebuilt> rebuild_range(ReadConnections& connections,
                              PicturesPool& pool,
                              const schema::IdRange& range,
                              int most,
                              const RebuildOptions& options) {
    const auto connection = connections.lend();
    if (!connection) return connection.error();
    const PicturesPool::Loan pictures = pool.lend().value();  // to make one cannot fail
    StoredPictures& stored = *pictures;
    if (Result<void> read =
            stored.read((*connection)->images(), range, std::size_t(most), options.go_on);
        !read)
        return std::move(read).error();
    Rebuilt part;
    part.sequence = stored.sequence();
    part.images = stored.images();
    part.damaged = stored.damaged();
    for (const auto& [variant, pieces] : stored.variants()) {
        if (!options.go_on()) return stopped();
        std::vector<image::LiveSegment>& segments = part.segments[variant];
        for (const image::PackedPictures& piece : pieces) {
            if (piece.size() != 0)
                segments.push_back({image::Segment::from_pictures(piece), nullptr});
        }
    }
    return part;
}

}  // namespace

Result<void> StoredPictures::read(schema::ImageStore& images,
                                  const schema::IdRange& range,
                                  std::size_t most,
                                  const std::function<bool()>& go_on) {
    begin(most);
    bool interrupted = false;
    const auto sequence =
        images.for_each_searchable(range, [&](const schema::SearchableImage& image) {
            ++images_;
            decode_signatures(
                image,
                [&](const std::string& variant, const image::Signature& signature) {
                    add(variant, image, signature);
                },
                [&](std::string reason) {
                    damaged_.push_back({image.id, std::move(reason)});
                });
            interrupted = !go_on();
            return !interrupted;
        });
    if (!sequence) return sequence.error();
    if (interrupted) return stopped();
    sequence_ = sequence.value();
    return {};
}

void StoredPictures::begin(std::size_t most) {
    images_ = 0;
    damaged_.clear();
    for (auto& [variant, pieces] : variants_) {
        while (pieces.size() > 1) pieces.pop_back();
        pieces.front().clear();
    }
    Pieces& main = variants_[ingest::kMainVariant];
    if (main.empty()) main.emplace_back(index_m_);
    main.front().reserve(most);
}

void StoredPictures::add(const std::string& variant,
                         const schema::SearchableImage& image,
                         const image::Signature& signature) {
    Pieces& pieces = variants_[variant];
    // Pictures that came meanwhile may make it more than one.
    if (pieces.empty() || pieces.back().size() == most_in_piece_)
        pieces.emplace_back(index_m_);
    pieces.back().add(image.id, signature, log_aspect_of(image));
}

int pictures_per_segment(std::int64_t images, int threads) {
    assert(images >= 0 && threads >= 1);
    const std::int64_t fewest = ceil_divide(images, image::kMaxSegmentSlots);
    const std::int64_t useful = std::min<std::int64_t>(threads, images / kFewPictures);
    const std::int64_t segments = std::max({std::int64_t{1}, fewest, useful});
    return static_cast<int>(std::max<std::int64_t>(1, ceil_divide(images, segments)));
}

Result<Rebuilt> rebuild(ReadConnections& connections,
                        const RebuildOptions& options,
                        Executor& executor) {
    Rebuilt all;
    int size = 0;
    std::vector<schema::IdRange> ranges;
    {
        const auto connection = connections.lend();
        if (!connection) return connection.error();
        schema::ImageStore& images = (*connection)->images();
        const auto counts = images.counts();
        if (!counts) return counts.error();
        size = pictures_per_segment(counts->indexed, options.threads);
        auto found = images.searchable_ranges(size);
        if (!found) return std::move(found).error();
        ranges = std::move(found).value();
    }
    PicturesPool pool([&]() -> Result<std::unique_ptr<StoredPictures>> {
        return std::make_unique<StoredPictures>(options.index_m,
                                                std::size_t{image::kMaxSegmentSlots});
    });
    std::vector<std::optional<Result<Rebuilt>>> parts(ranges.size());
    executor.parallel_for(ranges.size(), [&](std::size_t i) {
        parts[i].emplace(rebuild_range(connections, pool, ranges[i], size, options));
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
        Result<Rebuilt>& part = *parts[i];
        if (!part) return std::move(part).error();
        all.sequence = i == 0 ? part->sequence : std::min(all.sequence, part->sequence);
        all.images += part->images;
        std::ranges::move(part->damaged, std::back_inserter(all.damaged));
        for (auto& [variant, segments] : part->segments)
            std::ranges::move(segments, std::back_inserter(all.segments[variant]));
    }
    return all;
}

}  // namespace haarmony::server
