// Every colour space, decomposition and kind, for tests that hold for all of them.
#pragma once

#include <array>
#include <vector>

#include "engine/image/signature_kind.h"

namespace haarmony::image {

inline constexpr std::array kAllColorSpaces = {ColorSpace::kYiq,
                                               ColorSpace::kRgb,
                                               ColorSpace::kHsv,
                                               ColorSpace::kLab,
                                               ColorSpace::kLuv};
inline constexpr std::array kAllDecompositions = {Decomposition::kStandard,
                                                  Decomposition::kNonstandard};

[[nodiscard]] inline std::vector<SignatureKind> all_kinds() {
    std::vector<SignatureKind> kinds;
    for (const ColorSpace space : kAllColorSpaces) {
        for (const Decomposition decomposition : kAllDecompositions) {
            kinds.push_back({space, decomposition});
        }
    }
    return kinds;
}

}  // namespace haarmony::image
