#include "tests/engine/image/random_collection.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>

#include "engine/image/symmetry.h"

namespace haarmony::image {
namespace {

// One collection in so many has several groups of blocks, and takes as long as twenty.
constexpr int kLarge = 200;
constexpr int kMostOfLarge = 5000;
// One in so many has many segments, and takes as long as ten.
constexpr int kScattered = 30;
// A block has 256 pictures: a third of the others has one or two of them full.
constexpr std::array<int, 3> kMost = {12, 90, 600};

}  // namespace

RandomCollection::RandomCollection(unsigned seed) : random_(seed) {
    pictures_ = 1 + below(one_in(kLarge) ? kMostOfLarge : kMost[std::size_t(below(3))]);
    constexpr std::array<int, 6> kUsualM = {60, 40, 20, 100, 41, 1};
    options_.index_m =
        one_in(2) ? kUsualM[std::size_t(below(6))] : 1 + below(kMaxCoefficients);
    scattered_ = one_in(kScattered);
    changes_ = scattered_ ? 17 + below(30) : 1 + below(4);
    options_.tail_capacity = scattered_ || one_in(3) ? 1 : 1 + below(2 * pictures_);
    spread_ = static_cast<Spread>(below(3));
    most_coefficients_ = one_in(4) ? kMaxCoefficients : 1 + below(kMaxCoefficients);
    places_ = 2 + below(150);
    average_steps_ = one_in(2) ? 1 + below(5) : 1 << 16;
    // The widest colour spaces have averages of some 100.
    average_step_ = (one_in(4) ? 100 : 1) * kAverageOne / average_steps_;
    first_id_ = one_in(8) ? (std::int64_t{1} << 40) : 1;
    id_stride_ = one_in(4) ? 1 + below(100) : 1;
    if (one_in(2)) {
        const int kinds = 1 + below(one_in(2) ? 3 : 40);
        for (int i = 0; i < kinds; ++i) kinds_.push_back(any_signature());
    }
}

std::string RandomCollection::text() const {
    std::ostringstream text;
    text << "index_m " << options_.index_m << ", tail " << options_.tail_capacity
         << ", about " << pictures_ << " pictures of " << kinds_.size()
         << " kinds, spread " << int(spread_) << ", now " << live_.size();
    return text.str();
}

Change RandomCollection::change() {
    Change change;
    const bool fill = !scattered_ && (live_.empty() || one_in(3));
    const int upserts = fill         ? pictures_
                        : scattered_ ? 2 + below(6)
                                     : below(pictures_ / 3 + 2);
    for (int i = 0; i < upserts; ++i)
        change.upserts.push_back({any_id(), any_picture(), below(3) * 1000 - 1000});
    // A few, about half, or all.
    const int share = scattered_ ? 60 : one_in(12) ? 1 : one_in(3) ? 2 : 15;
    for (const auto& [id, _] : live_) {
        if (one_in(share)) change.removals.push_back(ImageId{id});
    }
    // Some that came with this change, some that there never were.
    for (int i = below(4); i > 0; --i) change.removals.push_back(any_id());
    std::ranges::shuffle(change.removals, random_);

    for (const Record& record : change.upserts) live_[to_int(record.id)] = record;
    for (const ImageId id : change.removals) live_.erase(to_int(id));
    return change;
}

Question RandomCollection::question() {
    Question question;
    question.signature = asked_signature();
    question.profile = any_profile();
    const int index_m = options_.index_m;
    question.m = one_in(3)   ? index_m
                 : one_in(3) ? std::min(index_m, question.profile.m)
                             : 1 + below(index_m);
    if (one_in(4)) {
        question.log_aspect = below(5) * 700 - 1400;
        question.aspect_weight = 1 + below(one_in(2) ? 200 : kMaxWeight);
    }
    if (one_in(2)) question.only = any_filter();
    question.limit = any_limit();
    return question;
}

ImageId RandomCollection::any_id() {
    return ImageId{first_id_ + id_stride_ * below(pictures_ + pictures_ / 2 + 1)};
}

int RandomCollection::any_index() {
    constexpr int kPlaces = kCoefficientCount - 1;
    if (spread_ == Spread::kFewPlaces) return 1 + below(places_);
    if (spread_ == Spread::kAnywhere || one_in(6)) return 1 + below(kPlaces);
    // The coarser the more popular, in both directions.
    const int finest = 1 << below(7);
    const int place = below(finest + 1) * kSide + below(finest + 1);
    return std::clamp(place, 1, kPlaces);
}

std::int32_t RandomCollection::any_average() {
    const std::int64_t steps = below(average_steps_) - average_steps_ / 2;
    return static_cast<std::int32_t>(steps * average_step_);
}

Signature RandomCollection::any_signature() {
    Signature signature;
    for (ChannelSignature& channel : signature.channels) {
        channel.average = any_average();
        const int wanted = below(most_coefficients_ + 1);
        ++channels_made_;
        for (int tries = 2 * wanted; tries > 0 && channel.count < wanted; --tries) {
            const int index = any_index();
            if (std::exchange(taken_by_[std::size_t(index)], channels_made_) ==
                channels_made_)
                continue;
            channel.indices[channel.count++] =
                static_cast<std::int16_t>(one_in(3) ? -index : index);
        }
    }
    return signature;
}

// One of the kinds, in some places with a small difference.
Signature RandomCollection::any_picture() {
    if (kinds_.empty()) return any_signature();
    Signature signature = kinds_[std::size_t(below(int(kinds_.size())))];
    ChannelSignature& channel = signature.channels[std::size_t(below(kChannels))];
    if (one_in(4)) channel.average += below(3) - 1;
    if (one_in(4)) channel.count = std::uint8_t(below(channel.count + 1));
    if (one_in(4) && channel.count > 0) channel.indices[0] *= -1;
    return signature;
}

// A picture of the collection as it is, turned, painted in part, of another average; or one
// that is not there; or nothing at all.
Signature RandomCollection::asked_signature() {
    if (one_in(20)) return {};
    if (live_.empty() || one_in(4)) return any_picture();
    auto chosen = live_.begin();
    std::advance(chosen, below(int(live_.size())));
    Signature signature = chosen->second.signature;
    if (one_in(4))
        signature =
            transformed(signature, kSymmetries[std::size_t(below(kSymmetries.size()))]);
    if (one_in(4)) {
        for (ChannelSignature& channel : signature.channels)
            channel.count = std::min(channel.count, std::uint8_t(below(9)));
    }
    if (one_in(4)) signature.channels[0].average = any_average();
    return signature;
}

Profile RandomCollection::any_profile() {
    Profile profile = *built_in_profile(one_in(2) ? "painted" : "scanned");
    if (one_in(3)) return profile;
    profile.bin_rule = static_cast<BinRule>(below(3));
    if (one_in(3)) return profile;
    // Few different weights, so that scores tie; or any; or none for colour or for shape.
    const int most = one_in(2) ? 3 : kMaxWeight;
    const bool without_average = one_in(5);
    const bool without_coefficients = one_in(10);
    for (auto& channel : profile.weights) {
        for (std::size_t bin = 0; bin < kBins; ++bin) {
            const bool is_average = bin == 0 && profile.bin_rule != BinRule::kLiteral;
            const bool none = is_average ? without_average : without_coefficients;
            channel[bin] = none ? 0 : below(most + 1);
        }
    }
    return profile;
}

std::set<std::int64_t> RandomCollection::any_filter() {
    std::set<std::int64_t> ids;
    const int share = std::array{1, 2, 10, 60}[std::size_t(below(4))];
    for (const auto& [id, _] : live_) {
        if (one_in(share)) ids.insert(id);
    }
    for (int i = below(3); i > 0; --i) ids.insert(to_int(any_id()));
    if (one_in(15)) ids.clear();
    return ids;
}

int RandomCollection::any_limit() {
    const int count = int(live_.size());
    switch (below(6)) {
        case 0:
            return below(2);
        case 1:
            return count;
        case 2:
            return count + 1 + below(50);
        case 3:
            return below(count + 1);
        default:
            return one_in(2) ? 20 : 1 + below(8);
    }
}

}  // namespace haarmony::image
