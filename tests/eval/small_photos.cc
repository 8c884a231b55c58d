#include "tests/eval/small_photos.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "ingest/gallery/gallery.h"

namespace haarmony::eval {
namespace {

constexpr std::uint64_t kGallerySeed = 1;

RgbPicture small(const RgbPicture& picture) {
    const int longest = std::max(picture.width, picture.height);
    if (longest <= kSmallSide) return picture;
    const auto scaled = [&](int length) {
        return std::max(
            1, static_cast<int>(std::lround(double(length) * kSmallSide / longest)));
    };
    return resize(picture, scaled(picture.width), scaled(picture.height));
}

// FNV-1a.
std::uint64_t digest_of(const std::vector<RgbPicture>& pictures) {
    std::uint64_t hash = 14695981039346656037U;
    const auto add = [&](std::uint64_t value) { hash = (hash ^ value) * 1099511628211U; };
    for (const RgbPicture& picture : pictures) {
        add(static_cast<std::uint64_t>(picture.width));
        add(static_cast<std::uint64_t>(picture.height));
        for (const std::uint8_t value : picture.rgb) add(value);
    }
    return hash;
}

SmallPhotos finished(std::vector<std::optional<RgbPicture>> found) {
    SmallPhotos photos;
    for (auto& picture : found) {
        if (picture) {
            photos.pictures.push_back(std::move(*picture));
        } else {
            ++photos.unreadable;
        }
    }
    photos.digest = digest_of(photos.pictures);
    return photos;
}

}  // namespace

Result<SmallPhotos> load_small_photos(const PictureSource& source, Executor& executor) {
    std::vector<std::optional<RgbPicture>> found(source.names.size());
    executor.parallel_for(found.size(), [&](std::size_t i) {
        const Result<RgbPicture> picture = source.load(i);
        if (picture) found[i] = small(*picture);
    });
    SmallPhotos photos = finished(std::move(found));
    if (photos.pictures.empty()) {
        return Error{ErrorCode::kNotFound,
                     "none of " + std::to_string(source.names.size()) +
                         " files is a picture that can be read"};
    }
    return photos;
}

SmallPhotos paint_small_photos(int count, Executor& executor) {
    assert(count >= 1);
    std::vector<std::optional<RgbPicture>> found(static_cast<std::size_t>(count));
    executor.parallel_for(found.size(), [&](std::size_t i) {
        gallery::Painting painting =
            gallery::paint(kGallerySeed, static_cast<int>(i), kSmallSide);
        found[i] = RgbPicture{painting.width, painting.height, std::move(painting.rgb)};
    });
    return finished(std::move(found));
}

}  // namespace haarmony::eval
