#include "engine/image/picture_source.h"

namespace haarmony::image {
namespace {

// Records in another order than memory's are asked for so many pictures before they are
// wanted: one takes as long as a miss or two.
constexpr std::size_t kAhead = 3;

void fetch(const Record& record) {
    constexpr std::size_t kCacheLine = 64;
    const auto* const bytes = reinterpret_cast<const char*>(&record);
    for (std::size_t at = 0; at < sizeof(Record); at += kCacheLine)
        __builtin_prefetch(bytes + at);
}

}  // namespace

PictureCoefficients RecordPictures::coefficients(std::uint32_t place) const {
    PictureCoefficients coefficients;
    for (int c = 0; c < kChannels; ++c)
        coefficients[c] = records_[place]->signature.channels[c].largest(index_m_);
    return coefficients;
}

void RecordPictures::give_all(const PictureSink& sink) const {
    for (std::uint32_t place = 0; place < records_.size(); ++place)
        sink(place, coefficients(place));
}

void RecordPictures::give(std::span<const std::uint32_t> places,
                          const PictureSink& sink) const {
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i + kAhead < places.size()) fetch(*records_[places[i + kAhead]]);
        sink(places[i], coefficients(places[i]));
    }
}

}  // namespace haarmony::image
