#include "engine/image/signature_kind.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace haarmony::image {
namespace {

template <typename T>
struct Named {
    T value;
    std::string_view name;
};

constexpr std::array<Named<ColorSpace>, 5> kColorSpaces = {{{ColorSpace::kYiq, "yiq"},
                                                            {ColorSpace::kRgb, "rgb"},
                                                            {ColorSpace::kHsv, "hsv"},
                                                            {ColorSpace::kLab, "lab"},
                                                            {ColorSpace::kLuv, "luv"}}};

constexpr std::array<Named<Decomposition>, 2> kDecompositions = {
    {{Decomposition::kStandard, "standard"},
     {Decomposition::kNonstandard, "nonstandard"}}};

template <typename Table, typename T>
std::string_view name_of(const Table& table, T value) {
    const auto* const found =
        std::ranges::find(table, value, [](const auto& entry) { return entry.value; });
    assert(found != table.end());
    return found->name;
}

template <typename Table>
auto value_of(const Table& table, std::string_view name)
    -> std::optional<decltype(table[0].value)> {
    for (const auto& entry : table) {
        if (entry.name == name) return entry.value;
    }
    return std::nullopt;
}

}  // namespace

std::string_view color_space_name(ColorSpace space) {
    return name_of(kColorSpaces, space);
}

std::optional<ColorSpace> color_space_from_name(std::string_view name) {
    return value_of(kColorSpaces, name);
}

std::string_view decomposition_name(Decomposition decomposition) {
    return name_of(kDecompositions, decomposition);
}

std::optional<Decomposition> decomposition_from_name(std::string_view name) {
    return value_of(kDecompositions, name);
}

std::string kind_name(const SignatureKind& kind) {
    return std::string(color_space_name(kind.color_space)) + '-' +
           std::string(decomposition_name(kind.decomposition));
}

std::optional<SignatureKind> kind_from_name(std::string_view name) {
    const std::size_t dash = name.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    const auto space = color_space_from_name(name.substr(0, dash));
    const auto decomposition = decomposition_from_name(name.substr(dash + 1));
    if (!space || !decomposition) return std::nullopt;
    return SignatureKind{*space, *decomposition};
}

}  // namespace haarmony::image
