#include "engine/image/packed_pictures.h"

#include <algorithm>
#include <cassert>

namespace haarmony::image {
namespace {

constexpr std::size_t kCacheLine = 64;
// So many pictures ahead of the one that is given, those that follow are on their way from
// memory: they stand in another order than they are asked for.
constexpr std::size_t kAhead = 4;

}  // namespace

PackedPictures::PackedPictures(int index_m) : index_m_(index_m) {
    assert(index_m >= 1 && index_m <= kMaxCoefficients);
}

void PackedPictures::reserve(std::size_t pictures) {
    columns_.ids.reserve(pictures);
    columns_.terms.reserve(pictures);
    counts_.reserve(pictures);
    indices_.reserve(pictures * stride());
}

void PackedPictures::add(ImageId id,
                         const Signature& signature,
                         std::int32_t log_aspect) {
    assert(columns_.ids.empty() || to_int(columns_.ids.back()) < to_int(id));
    PictureTerms terms;
    terms.log_aspect = log_aspect;
    std::array<std::uint8_t, kChannels> counts{};
    const std::size_t begin = indices_.size();
    indices_.resize(begin + stride());
    for (std::size_t c = 0; c < kChannels; ++c) {
        const ChannelSignature& channel = signature.channels[c];
        terms.average[c] = channel.average;
        const auto largest = channel.largest(index_m_);
        counts[c] = static_cast<std::uint8_t>(largest.size());
        std::ranges::copy(largest, &indices_[begin + c * std::size_t(index_m_)]);
    }
    columns_.ids.push_back(id);
    columns_.terms.push_back(terms);
    counts_.push_back(counts);
}

void PackedPictures::clear() {
    columns_.ids.clear();
    columns_.terms.clear();
    counts_.clear();
    indices_.clear();
}

PictureCoefficients PackedPictures::coefficients(std::uint32_t place) const {
    PictureCoefficients coefficients;
    const auto all = std::span(indices_).subspan(place * stride(), stride());
    for (std::size_t c = 0; c < kChannels; ++c)
        coefficients[c] =
            all.subspan(c * std::size_t(index_m_), std::size_t{counts_[place][c]});
    return coefficients;
}

void PackedPictures::fetch(std::uint32_t place) const {
    const auto* const bytes =
        reinterpret_cast<const char*>(indices_.data() + place * stride());
    for (std::size_t at = 0; at < stride() * sizeof(std::int16_t); at += kCacheLine)
        __builtin_prefetch(bytes + at);
    __builtin_prefetch(&counts_[place]);
}

void PackedPictures::give_all(const PictureSink& sink) const {
    for (std::uint32_t place = 0; place < size(); ++place)
        sink(place, coefficients(place));
}

void PackedPictures::give(std::span<const std::uint32_t> places,
                          const PictureSink& sink) const {
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i + kAhead < places.size()) fetch(places[i + kAhead]);
        sink(places[i], coefficients(places[i]));
    }
}

}  // namespace haarmony::image
