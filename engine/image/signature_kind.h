// Which of the choices of section 4.2.2 a signature was made with: pictures are comparable
// only within one kind (image search, between color_space.h and signature.h).
//
// Source  sec. 4.2.2, items 1 and 3; sec. 4.6, "Perceptually-based spaces".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace haarmony::image {

// The values are those of the signature's bytes (FORMATS.md).
enum class ColorSpace : std::uint8_t { kYiq = 1, kRgb = 2, kHsv = 3, kLab = 4, kLuv = 5 };
enum class Decomposition : std::uint8_t { kStandard = 1, kNonstandard = 2 };

struct SignatureKind {
    ColorSpace color_space = ColorSpace::kYiq;
    Decomposition decomposition = Decomposition::kStandard;

    friend auto operator<=>(const SignatureKind&, const SignatureKind&) = default;
};

// "yiq", "rgb", "hsv", "lab" or "luv".
[[nodiscard]] std::string_view color_space_name(ColorSpace space);
[[nodiscard]] std::optional<ColorSpace> color_space_from_name(std::string_view name);

// "standard" or "nonstandard".
[[nodiscard]] std::string_view decomposition_name(Decomposition decomposition);
[[nodiscard]] std::optional<Decomposition> decomposition_from_name(std::string_view name);

// Both names, as "yiq-standard".
[[nodiscard]] std::string kind_name(const SignatureKind& kind);
[[nodiscard]] std::optional<SignatureKind> kind_from_name(std::string_view name);

}  // namespace haarmony::image
