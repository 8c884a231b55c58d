#include "engine/image/search_arrays.h"

namespace haarmony::image {

void SearchArrays::add_matches(const Query& query,
                               std::span<std::int32_t> matched) const {
    const bool cut = query.m < index_m_;
    for (const QueryTerm& term : query.terms) {
        const std::uint32_t end = begin_[term.key + 1];
        if (cut) {
            for (std::uint32_t i = begin_[term.key]; i < end; ++i) {
                // A mask: ranks are too random for a branch to be foreseen.
                const std::int32_t within =
                    -static_cast<std::int32_t>(ranks_[i] < query.m);
                matched[slots_[i]] += term.weight & within;
            }
        } else {
            for (std::uint32_t i = begin_[term.key]; i < end; ++i) {
                matched[slots_[i]] += term.weight;
            }
        }
    }
}

std::int64_t SearchArrays::bytes() const {
    return std::int64_t(begin_.size() * sizeof(begin_[0]) +
                        slots_.size() * sizeof(slots_[0]) +
                        ranks_.size() * sizeof(ranks_[0]));
}

}  // namespace haarmony::image
