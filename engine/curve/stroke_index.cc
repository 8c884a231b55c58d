#include "engine/curve/stroke_index.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <optional>

namespace haarmony::curve {
namespace {

// A coarser detail spans so much of a word that the row beside it is another shape.
constexpr int kLeastMovingLevel = 3;

// Row `row` of D^level, an axis and a sign.
struct Term {
    int level = 0;
    int row = 0;
    int axis = 0;
    bool negative = false;

    explicit Term(std::int16_t term) : negative(term < 0) {
        const int index = std::abs(term) - 1;
        axis = index % 2;
        int place = index / 2 + 1;
        while (place >> (level + 1) != 0) ++level;
        row = place - (1 << level);
    }
    // The same one `by` rows on, if the level has it and its details move along the curve.
    [[nodiscard]] std::optional<std::int16_t> beside(int by) const {
        const int k = row + by;
        if (level < kLeastMovingLevel) return std::nullopt;
        if (k < 0 || k >= 1 << level) return std::nullopt;
        const int key = 1 + 2 * ((1 << level) - 1 + k) + axis;
        return static_cast<std::int16_t>(negative ? -key : key);
    }
    // Of a match at the very row; coarse details tell words apart better than fine ones, which
    // move along the curve. Even, so that a half is whole.
    [[nodiscard]] int weight() const {
        constexpr std::array<int, kSignatureLevel> kWeights = {16, 16, 12, 8, 6, 4, 2};
        return kWeights[std::size_t(level)];
    }
};

std::size_t list_of(std::int16_t term) {
    return 2 * std::size_t(std::abs(term) - 1) + (term < 0 ? 1 : 0);
}

std::int64_t own_score(const StrokeSignature& signature) {
    std::int64_t sum = 0;
    for (const std::int16_t term : signature.terms) sum += Term(term).weight();
    return sum;
}

}  // namespace

std::int64_t stroke_score(const StrokeSignature& query, const StrokeSignature& stored) {
    const auto has = [&](std::optional<std::int16_t> term) {
        return term && std::ranges::find(stored.terms, *term) != stored.terms.end();
    };
    std::int64_t score = 0;
    for (const std::int16_t value : query.terms) {
        const Term term(value);
        if (has(value))
            score += term.weight();
        else if (has(term.beside(-1)) || has(term.beside(1)))
            score += term.weight() / 2;
    }
    return score;
}

void StrokeIndex::add(const std::string& name, const StrokeSignature& signature) {
    remove(name);
    Slot slot = static_cast<Slot>(names_.size());
    if (free_.empty()) {
        names_.emplace_back();
        signatures_.emplace_back();
    } else {
        slot = free_.back();
        free_.pop_back();
    }
    names_[slot] = name;
    signatures_[slot] = signature;
    slots_[name] = slot;
    for (const std::int16_t term : signature.terms) {
        assert(term != 0 && std::size_t(std::abs(term)) <= kSignatureKeys);
        lists_[list_of(term)].push_back(slot);
    }
}

bool StrokeIndex::remove(const std::string& name) {
    const auto found = slots_.find(name);
    if (found == slots_.end()) return false;
    const Slot slot = found->second;
    for (const std::int16_t term : signatures_[slot].terms) {
        std::vector<Slot>& list = lists_[list_of(term)];
        *std::ranges::find(list, slot) = list.back();
        list.pop_back();
    }
    signatures_[slot].terms.clear();
    free_.push_back(slot);
    slots_.erase(found);
    return true;
}

std::vector<StrokeMatch> StrokeIndex::query(const StrokeSignature& signature,
                                            std::size_t limit) const {
    std::vector<std::int64_t> scores(names_.size());
    std::vector<std::int16_t> counted(names_.size());  // the last term that counted
    for (const std::int16_t value : signature.terms) {
        const Term term(value);
        const auto count = [&](std::optional<std::int16_t> stored, int weight) {
            if (!stored) return;
            for (const Slot slot : lists_[list_of(*stored)]) {
                if (counted[slot] == value) continue;
                counted[slot] = value;
                scores[slot] += weight;
            }
        };
        count(value, term.weight());
        count(term.beside(-1), term.weight() / 2);
        count(term.beside(1), term.weight() / 2);
    }
    std::vector<Slot> order;
    for (Slot slot = 0; slot < scores.size(); ++slot)
        if (scores[slot] > 0) order.push_back(slot);
    const auto better = [&](Slot a, Slot b) {
        return scores[a] != scores[b] ? scores[a] > scores[b] : names_[a] < names_[b];
    };
    const std::size_t kept = std::min(limit, order.size());
    std::ranges::partial_sort(order, order.begin() + std::ptrdiff_t(kept), better);
    std::vector<StrokeMatch> matches;
    const double own = double(own_score(signature));
    for (std::size_t i = 0; i < kept; ++i) {
        const Slot slot = order[i];
        matches.push_back({names_[slot], scores[slot], double(scores[slot]) / own});
    }
    return matches;
}

}  // namespace haarmony::curve
