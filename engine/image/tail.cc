#include "engine/image/tail.h"

#include <cassert>

#include "engine/image/term_weights.h"

namespace haarmony::image {

Tail::Tail(int capacity)
    : capacity_(capacity), records_(std::make_unique<Record[]>(std::size_t(capacity))) {
    assert(capacity >= 1);
}

void Tail::score_all(const Query& query,
                     int m,
                     int count,
                     const TombstonesPtr& removed,
                     const IdSet* only,
                     std::vector<Match>& out) const {
    if (count == 0) return;
    TermWeights weights;
    for (const QueryTerm& term : query.terms) weights.add(term.key, term.weight);
    for (int slot = 0; slot < count; ++slot) {
        if (is_removed(removed, slot)) continue;
        const Record& record = records_[slot];
        if (only != nullptr && !only->contains(record.id)) continue;
        std::array<std::int32_t, kChannels> average{};
        std::int64_t matched = 0;
        for (int c = 0; c < kChannels; ++c) {
            const ChannelSignature& channel = record.signature.channels[c];
            average[c] = channel.average;
            matched += weights.sum(c, channel.largest(m));
        }
        out.push_back({record.id, score(query, average, record.log_aspect, matched)});
    }
}

std::int64_t Tail::bytes() const {
    return std::int64_t{capacity_} * std::int64_t{sizeof(Record)};
}

}  // namespace haarmony::image
