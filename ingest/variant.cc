#include "ingest/variant.h"

namespace haarmony::ingest {

std::string variant_name(const image::SignatureKind& kind, Look look) {
    return image::kind_name(kind) + (look == Look::kContent ? "-content" : "");
}

}  // namespace haarmony::ingest
