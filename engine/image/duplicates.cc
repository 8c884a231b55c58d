#include "engine/image/duplicates.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace haarmony::image {
namespace {

struct NamedLevel {
    DuplicateLevel level;
    std::string_view name;
};

constexpr std::array<NamedLevel, 3> kLevels = {{{DuplicateLevel::kExact, "exact"},
                                                {DuplicateLevel::kNear, "near"},
                                                {DuplicateLevel::kSimilar, "similar"}}};

using IdPair = std::pair<ImageId, ImageId>;

IdPair in_order(ImageId a, ImageId b) { return std::minmax(a, b); }

// Disjoint sets of numbers (union by size, path halving).
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : parent_(count), size_(count, 1) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }

    [[nodiscard]] std::size_t root(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    // Whether they were apart.
    bool unite(std::size_t a, std::size_t b) {
        a = root(a);
        b = root(b);
        if (a == b) return false;
        if (size_[a] < size_[b]) std::swap(a, b);
        parent_[b] = a;
        size_[a] += size_[b];
        return true;
    }

  private:
    std::vector<std::size_t> parent_;
    std::vector<std::size_t> size_;
};

}  // namespace

std::string_view duplicate_level_name(DuplicateLevel level) {
    const auto* const found = std::ranges::find(kLevels, level, &NamedLevel::level);
    assert(found != kLevels.end());
    return found->name;
}

std::optional<DuplicateLevel> duplicate_level_from_name(std::string_view name) {
    const auto* const found = std::ranges::find(kLevels, name, &NamedLevel::name);
    if (found == kLevels.end()) return std::nullopt;
    return found->level;
}

Profile duplicate_profile() {
    Profile profile = *built_in_profile("scanned");
    profile.name = "duplicates";
    profile.m = 60;
    return profile;
}

std::optional<DuplicateLevel> level_of(const Resemblance& resemblance) {
    if (resemblance.same_bytes) return DuplicateLevel::kExact;
    if (resemblance.low_information) return std::nullopt;
    if (resemblance.similarity >= kNearSimilarity) return DuplicateLevel::kNear;
    if (resemblance.similarity >= kSimilarSimilarity) return DuplicateLevel::kSimilar;
    return std::nullopt;
}

std::vector<DuplicateGroup> group_duplicates(std::span<const DuplicatePair> pairs,
                                             std::span<const IdPair> ignored,
                                             const DuplicateOptions& options) {
    std::set<IdPair> apart;
    for (const auto& [a, b] : ignored) apart.insert(in_order(a, b));
    std::vector<DuplicatePair> kept;
    std::map<ImageId, std::size_t> places;
    for (const DuplicatePair& pair : pairs) {
        assert(pair.a != pair.b);
        if (pair.similarity < options.min_similarity || pair.level < options.min_level ||
            apart.contains(in_order(pair.a, pair.b))) {
            continue;
        }
        kept.push_back(pair);
        places.emplace(pair.a, 0);
        places.emplace(pair.b, 0);
    }
    std::vector<ImageId> ids;
    for (auto& [id, place] : places) {
        place = ids.size();
        ids.push_back(id);
    }

    // Strongest first: those that unite are a maximum spanning forest, whose weakest pair
    // is the strongest possible.
    std::ranges::sort(kept, std::greater<>(), [](const DuplicatePair& pair) {
        return std::tuple(pair.level, pair.similarity);
    });
    DisjointSets sets(ids.size());
    std::vector<const DuplicatePair*> needed;
    for (const DuplicatePair& pair : kept) {
        if (sets.unite(places.at(pair.a), places.at(pair.b))) needed.push_back(&pair);
    }

    std::vector<DuplicateGroup> groups;
    std::vector<std::size_t> group_of(ids.size(), ids.size());  // by root
    for (std::size_t i = 0; i < ids.size(); ++i) {
        std::size_t& group = group_of[sets.root(i)];
        if (group == ids.size()) {
            group = groups.size();
            groups.push_back({{}, DuplicateLevel::kExact, 1.0});
        }
        groups[group].ids.push_back(ids[i]);
    }
    for (const DuplicatePair* pair : needed) {
        DuplicateGroup& group = groups[group_of[sets.root(places.at(pair->a))]];
        group.level = std::min(group.level, pair->level);
        group.similarity = std::min(group.similarity, pair->similarity);
    }
    return groups;
}

}  // namespace haarmony::image
