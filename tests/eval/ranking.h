// Where the intended target stands in the list that each metric makes of the database.
//
// Units   ranks start at 1: one more than the pictures that are strictly closer plus the
//         equally close ones that stand before the target (smaller id). Ties are thus broken
//         as the service breaks them, neither for nor against the target.
// Threads const-safe.
// Source  sec. 4.5.2.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/image/index.h"
#include "engine/image/profile.h"
#include "engine/image/query.h"
#include "tests/eval/database.h"

namespace haarmony::eval {

// Requires: target < distances.size().
[[nodiscard]] std::int64_t rank_of(std::span<const std::uint64_t> distances,
                                   std::size_t target);

// The place of the target in a list of matches, or one beyond its end.
[[nodiscard]] std::int64_t rank_in(const std::vector<image::Match>& matches,
                                   std::size_t target);

// All pictures of the database in the order of one rival metric.
[[nodiscard]] std::int64_t rival_rank(Rival rival,
                                      const Database& database,
                                      const RivalFeatures& query,
                                      std::size_t target);

// The service's own search over a database, for profiles of one signature kind.
class WaveletSearch {
  public:
    // Requires: the database has signatures of that kind.
    WaveletSearch(const Database& database, const image::SignatureKind& kind);

    [[nodiscard]] const image::SignatureKind& kind() const { return kind_; }
    [[nodiscard]] const image::IndexSnapshot& snapshot() const { return *snapshot_; }
    [[nodiscard]] int pictures() const { return pictures_; }

    // Every picture of the database, best first. Requires: profile.kind == kind().
    [[nodiscard]] std::vector<image::Match> order(const image::Signature& query,
                                                  const image::Profile& profile) const;
    [[nodiscard]] std::int64_t rank(const image::Signature& query,
                                    const image::Profile& profile,
                                    std::size_t target) const;

  private:
    image::SignatureKind kind_;
    int pictures_;
    std::unique_ptr<image::Index> index_;
    std::shared_ptr<const image::IndexSnapshot> snapshot_;
};

// "L^q", "m=40": how tables name a profile's metric.
[[nodiscard]] MetricName wavelet_name(const image::Profile& profile);

// Both built-in profiles and every rival, over one database.
class MetricPanel {
  public:
    explicit MetricPanel(const Database& database);

    struct Column {
        MetricName name;
        std::string profile;  // of L^q; empty for the rivals
    };
    [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
    [[nodiscard]] const WaveletSearch& search() const { return search_; }
    [[nodiscard]] const std::vector<image::Profile>& profiles() const {
        return profiles_;
    }

    // The target's rank, one a column.
    [[nodiscard]] std::vector<std::int64_t> ranks(const ImageView& query,
                                                  std::size_t target) const;

  private:
    const Database& database_;
    WaveletSearch search_;
    std::vector<image::Profile> profiles_;
    std::vector<Column> columns_;
};

}  // namespace haarmony::eval
