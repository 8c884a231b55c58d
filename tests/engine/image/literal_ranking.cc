#include "tests/engine/image/literal_ranking.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>

namespace haarmony::image {
namespace {

// floor(log2 coarser) by halving, and from there the bin.
int bin_written_out(BinRule rule, int row, int column) {
    const int coarser = std::max(row, column);
    int log2 = 0;
    for (int rest = coarser; rest > 1; rest /= 2) ++log2;
    switch (rule) {
        case BinRule::kLog2Plus1:
            return std::min(log2 + 1, 5);
        case BinRule::kLinear:
            return std::min(coarser, 5);
        case BinRule::kLiteral:
            return std::min(log2, 5);
    }
    std::abort();
}

// -1, 0 or +1 at every place.
using Signs = std::array<std::int8_t, kCoefficientCount>;

Signs signs_of(const ChannelSignature& channel, int m) {
    Signs signs{};
    for (int i = 0; i < std::min<int>(channel.count, m); ++i) {
        const int signed_index = channel.indices[std::size_t(i)];
        signs[std::size_t(std::abs(signed_index))] = signed_index < 0 ? -1 : +1;
    }
    return signs;
}

std::int64_t apart(std::int64_t a, std::int64_t b) { return a < b ? b - a : a - b; }

}  // namespace

std::string Question::text() const {
    std::ostringstream text;
    text << "m " << m << ", limit " << limit << ", bins "
         << bin_rule_name(profile.bin_rule) << ", weights";
    for (const auto& channel : profile.weights) {
        for (const std::int32_t weight : channel) text << ' ' << weight;
    }
    text << ", shape " << log_aspect << " x " << aspect_weight << ", among ";
    if (only) {
        text << only->size();
    } else {
        text << "all";
    }
    text << ", coefficients";
    for (const ChannelSignature& channel : signature.channels)
        text << ' ' << int(channel.count);
    return text.str();
}

Query query_of(const Question& question) {
    Query query = make_query(question.signature, question.profile, question.m);
    query.log_aspect = question.log_aspect;
    query.aspect_weight = question.aspect_weight;
    return query;
}

std::optional<IdSet> id_set_of(const Question& question) {
    if (!question.only) return std::nullopt;
    std::vector<ImageId> ids;
    ids.reserve(question.only->size());
    for (const std::int64_t id : *question.only) ids.push_back(ImageId{id});
    return IdSet(ids);
}

std::vector<Match> rank_literally(const Pictures& pictures, const Question& question) {
    std::vector<Match> ranking;
    for (const auto& [id, record] : pictures) {
        if (question.only && !question.only->contains(id)) continue;
        ranking.push_back(
            {ImageId{id},
             question.aspect_weight * apart(question.log_aspect, record.log_aspect)});
    }
    for (std::size_t c = 0; c < kChannels; ++c) {
        const auto& weights = question.profile.weights[c];
        const ChannelSignature& asked = question.signature.channels[c];
        const Signs signs = signs_of(asked, question.m);
        for (Match& match : ranking) {
            const ChannelSignature& target =
                pictures.at(to_int(match.id)).signature.channels[c];
            match.score += weights[0] * apart(asked.average, target.average);
            for (int i = 0; i < std::min<int>(target.count, question.m); ++i) {
                const int signed_index = target.indices[std::size_t(i)];
                const int place = std::abs(signed_index);
                if (signs[std::size_t(place)] != (signed_index < 0 ? -1 : +1)) continue;
                const int bin = bin_written_out(
                    question.profile.bin_rule, place / kSide, place % kSide);
                match.score -= weights[std::size_t(bin)] * (std::int64_t{1} << 24);
            }
        }
    }
    std::sort(ranking.begin(), ranking.end(), [](const Match& a, const Match& b) {
        return a.score < b.score || (a.score == b.score && a.id < b.id);
    });
    return ranking;
}

Score left_out(const Question& question) {
    Score sum = 0;
    for (std::size_t c = 0; c < kChannels; ++c) {
        const ChannelSignature& asked = question.signature.channels[c];
        for (int i = 0; i < std::min<int>(asked.count, question.m); ++i) {
            const int place = std::abs(int{asked.indices[std::size_t(i)]});
            const int bin =
                bin_written_out(question.profile.bin_rule, place / kSide, place % kSide);
            sum += question.profile.weights[c][std::size_t(bin)];
        }
    }
    return sum * (std::int64_t{1} << 24);
}

}  // namespace haarmony::image
