#include "engine/image/symmetry.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>

namespace haarmony::image {
namespace {

// Every symmetry is a transposition or none, and then mirrors.
struct Steps {
    bool transpose = false;
    bool mirror_x = false;
    bool mirror_y = false;
    friend bool operator==(const Steps&, const Steps&) = default;
};

struct Entry {
    Symmetry symmetry;
    std::string_view name;
    Steps steps;
};

constexpr std::array<Entry, 8> kTable = {{
    {Symmetry::kIdentity, "identity", {false, false, false}},
    {Symmetry::kMirrorX, "mirror_x", {false, true, false}},
    {Symmetry::kMirrorY, "mirror_y", {false, false, true}},
    {Symmetry::kTurn90, "turn_90", {true, true, false}},
    {Symmetry::kTurn180, "turn_180", {false, true, true}},
    {Symmetry::kTurn270, "turn_270", {true, false, true}},
    {Symmetry::kTranspose, "transpose", {true, false, false}},
    {Symmetry::kAntiTranspose, "anti_transpose", {true, true, true}},
}};

const Entry& entry_of(Symmetry symmetry) {
    return kTable[static_cast<std::size_t>(symmetry)];
}

Symmetry symmetry_of(const Steps& steps) {
    return std::ranges::find(kTable, steps, &Entry::steps)->symmetry;
}

// The largest power of two that is not above `index`; 1 for 0.
int level_size(int index) {
    return static_cast<int>(std::bit_floor(static_cast<unsigned>(std::max(index, 1))));
}

// One coordinate of a coefficient, mirrored along its axis. `level` is the number of places
// that the basis functions of this size have side by side: coordinates below it are means of
// such a place, those from it on are differences, whose sign a mirror changes.
struct Mirrored {
    int index;
    bool negates;
};
Mirrored mirrored(int index, int level) {
    if (index < level) return {level - 1 - index, false};
    return {level + (2 * level - 1 - index), true};
}

// In the standard decomposition each axis has its own level, and the mean of all lies in the
// only place of its kind.
Mirrored mirrored_alone(int index) {
    return index == 0 ? Mirrored{0, false} : mirrored(index, level_size(index));
}

std::int16_t moved(int signed_index, const Steps& steps, Decomposition decomposition) {
    const int index = std::abs(signed_index);
    int row = index / kSide;
    int column = index % kSide;
    if (steps.transpose) std::swap(row, column);
    const bool standard = decomposition == Decomposition::kStandard;
    const int level = level_size(std::max(row, column));
    bool negative = signed_index < 0;
    if (steps.mirror_x) {
        const Mirrored place =
            standard ? mirrored_alone(column) : mirrored(column, level);
        column = place.index;
        negative = negative != place.negates;
    }
    if (steps.mirror_y) {
        const Mirrored place = standard ? mirrored_alone(row) : mirrored(row, level);
        row = place.index;
        negative = negative != place.negates;
    }
    const int result = row * kSide + column;
    return static_cast<std::int16_t>(negative ? -result : result);
}

}  // namespace

std::string_view symmetry_name(Symmetry symmetry) { return entry_of(symmetry).name; }

std::optional<Symmetry> symmetry_from_name(std::string_view name) {
    const auto* const found = std::ranges::find(kTable, name, &Entry::name);
    if (found == kTable.end()) return std::nullopt;
    return found->symmetry;
}

Symmetry inverse(Symmetry symmetry) {
    Steps steps = entry_of(symmetry).steps;
    if (steps.transpose) std::swap(steps.mirror_x, steps.mirror_y);
    return symmetry_of(steps);
}

// A mirror before a transposition is the other mirror after it.
Symmetry compose(Symmetry first, Symmetry second) {
    Steps steps = entry_of(first).steps;
    const Steps& more = entry_of(second).steps;
    if (more.transpose) std::swap(steps.mirror_x, steps.mirror_y);
    return symmetry_of({steps.transpose != more.transpose,
                        steps.mirror_x != more.mirror_x,
                        steps.mirror_y != more.mirror_y});
}

bool swaps_sides(Symmetry symmetry) { return entry_of(symmetry).steps.transpose; }

Signature transformed(const Signature& signature, Symmetry symmetry) {
    const Steps& steps = entry_of(symmetry).steps;
    Signature result = signature;
    for (ChannelSignature& channel : result.channels) {
        for (int i = 0; i < channel.count; ++i) {
            channel.indices[i] =
                moved(channel.indices[i], steps, signature.kind.decomposition);
        }
    }
    return result;
}

}  // namespace haarmony::image
