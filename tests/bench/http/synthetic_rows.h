// Rows for a database as large as a measurement needs, without the pictures.
//
// Shape   every signature of synthetic_signature() is full: 100 coefficients in each channel, drawn without
//         repetition from the positions of the 128 x 128 square with the probability that
//         falls as 1 / ((row + 1) * (column + 1)), as the large coefficients of photographs
//         crowd around the coarse wavelets; so the lists of the coarse ones are long.
//         Averages are uniform over what the channels can have. No two pictures are alike
//         but by chance: the worst case of a search.
// Scale   a seed and a number name one row; the same ones, the same row.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "engine/core/result.h"
#include "engine/image/signature.h"
#include "schema/image_store.h"

namespace haarmony::bench {

[[nodiscard]] image::Signature synthetic_signature(unsigned seed, std::int64_t number);

// The signature of the row with that number.
using SignatureOf = std::function<image::Signature(std::int64_t number)>;

// Without a thumbnail.
[[nodiscard]] schema::NewImage synthetic_row(std::int64_t number,
                                             const image::Signature& signature);

// Adds rows 1 to `images` to the database, which is created where it is absent.
[[nodiscard]] Result<void> write_rows(const std::string& database,
                                      std::int64_t images,
                                      const SignatureOf& signature_of);

}  // namespace haarmony::bench
