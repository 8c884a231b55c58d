// How long the lists of the search arrays are that queries read: what makes a collection
// realistic to time a search on.
//
// Units   densities and shares in [0, 1]: a list of density 0.1 names every tenth picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tests/eval/packed_signature.h"

namespace haarmony::eval {

struct ListPopularity {
    int m = 0;
    std::int64_t non_empty_lists = 0;  // of image::kKeyCount
    double hits_per_picture = 0;       // postings that a query reads / pictures, the mean
    double median_density = 0;         // of the lists that queries read
    double p90_density = 0;
    double largest_density = 0;
    std::int64_t popular_lists = 0;  // of more than 1 % of the pictures
    double popular_share = 0;        // of all postings
};

class ListLengths {
  public:
    // Requires: signatures not empty; 1 <= m <= kPackedCoefficients.
    ListLengths(std::span<const PackedSignature> signatures, int m);

    // Requires: queries not empty.
    [[nodiscard]] ListPopularity read_by(std::span<const PackedSignature> queries) const;

  private:
    int m_;
    double pictures_;
    std::vector<std::int64_t> lengths_;  // by image::coefficient_key()
};

}  // namespace haarmony::eval
