#include "tests/eval/synthetic_signatures.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include "tests/eval/experiment.h"
#include "tests/eval/simulated_queries.h"
#include "tests/eval/synthetic_pictures.h"

namespace haarmony::eval {
namespace {

// Streams of random numbers; a picture's own is kPictures + its number.
enum Stream : std::uint64_t { kOrder, kNearQueries, kNovelQueries, kSketches, kPictures };

// Work is handed out in pieces: large enough for little ado, small enough for even ends.
constexpr std::size_t kPiece = 256;

std::vector<RgbPicture> in_random_order(std::vector<RgbPicture> photos, Random random) {
    const std::vector<std::size_t> order = shuffled(photos.size(), random);
    std::vector<RgbPicture> result;
    result.reserve(photos.size());
    for (const std::size_t place : order) result.push_back(std::move(photos[place]));
    return result;
}

class Maker {
  public:
    Maker(const SmallPhotos& photos, std::uint64_t seed)
        : seed_(seed),
          photos_(in_random_order(photos.pictures, stream(kOrder))),
          held_out_(std::max(1, static_cast<int>(photos_.size()) / 10)),
          kitchen_(photos_) {}

    [[nodiscard]] RgbPicture picture(std::uint64_t number) const {
        return kitchen_.render(recipe(number));
    }

    [[nodiscard]] RgbPicture query(SyntheticKind kind, std::uint64_t number) const {
        switch (kind) {
            case SyntheticKind::kNear: {
                Random random = stream(kNearQueries, number);
                return kitchen_.render(varied(recipe(number), random));
            }
            case SyntheticKind::kNovel: {
                Random random = stream(kNovelQueries, number);
                return kitchen_.render(random_recipe(first_held_out(), end(), random));
            }
            case SyntheticKind::kSketch:
                break;
        }
        Random random = stream(kSketches, number);
        return simulate_painting(picture(number), random);
    }

  private:
    [[nodiscard]] Random stream(std::uint64_t which, std::uint64_t number = 0) const {
        return Random(gallery::mix_seeds(gallery::mix_seeds(seed_, which), number));
    }
    [[nodiscard]] int end() const { return static_cast<int>(photos_.size()); }
    [[nodiscard]] int first_held_out() const { return end() - held_out_; }
    [[nodiscard]] PictureRecipe recipe(std::uint64_t number) const {
        Random random = stream(kPictures, number);
        return random_recipe(0, first_held_out(), random);
    }

    std::uint64_t seed_;
    std::vector<RgbPicture> photos_;
    int held_out_;
    PictureKitchen kitchen_;
};

}  // namespace

std::string synthetic_kind_name(SyntheticKind kind) {
    switch (kind) {
        case SyntheticKind::kNear:
            return "near";
        case SyntheticKind::kNovel:
            return "novel";
        case SyntheticKind::kSketch:
            break;
    }
    return "sketch";
}

SyntheticCollection make_synthetic_collection(const SmallPhotos& photos,
                                              const SyntheticSize& size,
                                              Executor& executor) {
    assert(photos.pictures.size() >= 2);
    assert(1 <= size.queries && size.queries <= size.images);
    const Maker maker(photos, size.seed);
    SyntheticCollection collection;
    collection.seed = size.seed;
    collection.source_digest = photos.digest;
    const auto count = static_cast<std::size_t>(size.images);
    collection.signatures.resize(count);
    collection.cells.resize(count);
    collection.histograms.resize(count);
    executor.parallel_for((count + kPiece - 1) / kPiece, [&](std::size_t piece) {
        const std::size_t end = std::min(count, (piece + 1) * kPiece);
        for (std::size_t i = piece * kPiece; i < end; ++i) {
            const RgbPicture picture = maker.picture(i);
            collection.signatures[i] = pack(image::make_signature(picture.view()));
            const CompactFeatures features = compact_features(picture);
            collection.cells[i] = features.cells;
            collection.histograms[i] = features.histogram;
        }
    });
    for (const SyntheticKind kind : kSyntheticKinds) {
        std::vector<SyntheticQuery>& queries =
            collection.queries[static_cast<std::size_t>(kind)];
        queries.resize(static_cast<std::size_t>(size.queries));
        executor.parallel_for(queries.size(), [&](std::size_t i) {
            const RgbPicture picture = maker.query(kind, i);
            queries[i] = {pack(image::make_signature(picture.view())),
                          compact_features(resize(picture, image::kSide, image::kSide))};
        });
    }
    return collection;
}

}  // namespace haarmony::eval
