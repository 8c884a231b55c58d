#include "engine/image/medoids.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <optional>
#include <random>

#include "engine/image/random_order.h"

namespace haarmony::image {
namespace {

// Large enough that building a block's lists is paid for, small enough that 20,000 pictures
// keep several cores busy.
constexpr std::size_t kBlockSize = 4096;

// How many pictures are tried for each seed, the best of which is kept.
constexpr int kSeedTrials = 4;

// How many pictures of a cluster are tried as its medoid: half of them the nearest to the
// present one, half drawn from the others.
constexpr std::size_t kCandidates = 64;

static_assert(kMaxRelativeDistance <
              std::numeric_limits<std::int64_t>::max() / kMaxSlots);

std::int64_t sum_of(std::span<const std::int64_t> distances) {
    return std::accumulate(distances.begin(), distances.end(), std::int64_t{0});
}

class MedoidSearch {
  public:
    MedoidSearch(const SignatureBlocks& pictures,
                 const Profile& profile,
                 std::uint64_t seed,
                 Executor& executor)
        : pictures_(pictures),
          profile_(profile),
          seed_(seed),
          random_(seed),
          executor_(executor) {}

    // Each picture is drawn with a probability in proportion to its distance from the
    // nearest medoid so far; of a few that are drawn, the one that leaves the least cost.
    [[nodiscard]] std::vector<std::size_t> seeds(int count) {
        std::vector<std::size_t> chosen;
        std::vector<std::int64_t> left(pictures_.size(), kUnseeded);
        while (chosen.size() < std::size_t(count) && sum_of(left) > 0) {
            std::optional<std::size_t> best;
            std::int64_t best_cost = 0;
            std::vector<std::int64_t> best_left;
            for (int trial = 0; trial < kSeedTrials; ++trial) {
                const std::size_t drawn = draw(left);
                std::vector<std::int64_t> after = nearest({&drawn, 1}).distance;
                for (std::size_t i = 0; i < after.size(); ++i) {
                    after[i] = std::min(after[i], left[i]);
                }
                const std::int64_t cost = sum_of(after);
                if (!best || cost < best_cost || (cost == best_cost && drawn < *best)) {
                    best = drawn;
                    best_cost = cost;
                    best_left = std::move(after);
                }
            }
            chosen.push_back(*best);
            left = std::move(best_left);
        }
        std::ranges::sort(chosen);
        return chosen;
    }

    [[nodiscard]] Nearest nearest(std::span<const std::size_t> centers) const {
        std::vector<Query> queries;
        for (const std::size_t center : centers) queries.push_back(query(center));
        return pictures_.nearest(queries, executor_);
    }

    // The best candidate of each cluster.
    [[nodiscard]] std::vector<std::size_t> moved(const Nearest& nearest,
                                                 std::size_t clusters,
                                                 int iteration) const {
        std::vector<std::vector<std::size_t>> members(clusters);
        for (std::size_t i = 0; i < pictures_.size(); ++i) {
            members[nearest.center[i]].push_back(i);
        }
        // Pictures that differ by less than the distance can tell may both have become
        // medoids; the later one is left with nothing.
        std::erase_if(members, [](const auto& each) { return each.empty(); });
        std::vector<std::size_t> medoids(members.size());
        executor_.parallel_for(members.size(), [&](std::size_t cluster) {
            // A generator for each, so that no cluster depends on what others have drawn.
            std::seed_seq numbers{static_cast<std::uint32_t>(seed_),
                                  static_cast<std::uint32_t>(seed_ >> 32),
                                  static_cast<std::uint32_t>(iteration),
                                  static_cast<std::uint32_t>(cluster)};
            std::mt19937_64 random(numbers);
            std::ranges::sort(members[cluster], {}, [&](std::size_t i) {
                return std::pair(nearest.distance[i], i);
            });
            medoids[cluster] = best_of(members[cluster], random);
        });
        std::ranges::sort(medoids);
        return medoids;
    }

  private:
    // The first seed is drawn from all alike, and leaves every distance as it is.
    static constexpr std::int64_t kUnseeded = kMaxRelativeDistance;

    [[nodiscard]] Query query(std::size_t i) const {
        return make_query(pictures_[i], profile_, profile_.m);
    }

    [[nodiscard]] std::size_t draw(const std::vector<std::int64_t>& left) {
        const auto total = static_cast<std::uint64_t>(sum_of(left));
        auto rest = static_cast<std::int64_t>(random_below(random_, total));
        std::size_t i = 0;
        while (rest >= left[i]) rest -= left[i++];
        return i;
    }

    // Requires: the members are sorted by their distance from the present medoid.
    [[nodiscard]] std::size_t best_of(std::span<const std::size_t> members,
                                      std::mt19937_64& random) const {
        std::vector<std::size_t> candidates(members.begin(), members.end());
        if (candidates.size() > kCandidates) {
            const auto others = std::span(candidates).subspan(kCandidates / 2);
            draw_to_front(random, others, kCandidates / 2);
            candidates.resize(kCandidates);
        }
        std::vector<const Signature*> signatures;
        for (const std::size_t i : members) signatures.push_back(&pictures_[i]);
        const SignatureBlock block(signatures, profile_);
        std::vector<std::int64_t> distances(members.size());
        std::pair<std::int64_t, std::size_t> best{-1, 0};
        for (const std::size_t candidate : candidates) {
            block.relative_distances(query(candidate), distances);
            const std::pair tried(sum_of(distances), candidate);
            if (best.first < 0 || tried < best) best = tried;
        }
        return best.second;
    }

    const SignatureBlocks& pictures_;
    const Profile& profile_;
    std::uint64_t seed_;
    std::mt19937_64 random_;
    Executor& executor_;
};

}  // namespace

std::int64_t Nearest::cost() const { return sum_of(distance); }

SignatureBlocks::SignatureBlocks(std::vector<const Signature*> signatures,
                                 const Profile& profile,
                                 Executor& executor)
    : signatures_(std::move(signatures)) {
    const std::size_t count = (signatures_.size() + kBlockSize - 1) / kBlockSize;
    std::vector<std::optional<SignatureBlock>> built(count);
    executor.parallel_for(count, [&](std::size_t b) {
        const std::size_t begin = b * kBlockSize;
        const std::size_t size = std::min(kBlockSize, signatures_.size() - begin);
        built[b].emplace(
            std::span<const Signature* const>(signatures_).subspan(begin, size), profile);
    });
    for (auto& block : built) blocks_.push_back(*std::move(block));
}

Nearest SignatureBlocks::nearest(std::span<const Query> centers,
                                 Executor& executor) const {
    assert(!centers.empty());
    Nearest nearest{std::vector<std::size_t>(size(), 0),
                    std::vector<std::int64_t>(size(), 0)};
    executor.parallel_for(blocks_.size(), [&](std::size_t b) {
        const SignatureBlock& block = blocks_[b];
        const auto size = std::size_t(block.size());
        const auto best = std::span(nearest.distance).subspan(b * kBlockSize, size);
        const auto center = std::span(nearest.center).subspan(b * kBlockSize, size);
        block.relative_distances(centers[0], best);
        std::vector<std::int64_t> distances(size);
        for (std::size_t c = 1; c < centers.size(); ++c) {
            block.relative_distances(centers[c], distances);
            for (std::size_t i = 0; i < size; ++i) {
                if (distances[i] >= best[i]) continue;
                best[i] = distances[i];
                center[i] = c;
            }
        }
    });
    return nearest;
}

Medoids find_medoids(const SignatureBlocks& pictures,
                     const Profile& profile,
                     int count,
                     std::uint64_t seed,
                     int iterations,
                     Executor& executor) {
    assert(count >= 1 && iterations >= 0);
    assert(pictures.size() >= 1 && pictures.size() <= std::size_t{kMaxSlots});
    MedoidSearch search(pictures, profile, seed, executor);
    Medoids medoids{search.seeds(count), {}};
    Nearest nearest = search.nearest(medoids.pictures);
    medoids.costs.push_back(nearest.cost());
    for (int i = 0; i < iterations; ++i) {
        std::vector<std::size_t> moved =
            search.moved(nearest, medoids.pictures.size(), i);
        if (moved == medoids.pictures) break;
        medoids.pictures = std::move(moved);
        nearest = search.nearest(medoids.pictures);
        medoids.costs.push_back(nearest.cost());
    }
    return medoids;
}

}  // namespace haarmony::image
