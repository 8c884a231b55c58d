// What the signatures of one picture are called in the database: by their kind, and by the
// part of the picture that they look at.
//
//   The first signature of a picture, kMainVariant, is a column of its row; every other one
//   is a row of image_signatures under its variant's name (schema/README.md).
#pragma once

#include <string>

#include "engine/image/signature_kind.h"

namespace haarmony::ingest {

enum class Look {
    kWhole,    // the picture as it is
    kContent,  // without the near-uniform borders that it has
};

// "lab-standard", "yiq-standard-content".
[[nodiscard]] std::string variant_name(const image::SignatureKind& kind, Look look);

inline constexpr const char* kMainVariant = "yiq-standard";

}  // namespace haarmony::ingest
