#include "engine/video/content_table.h"

#include <cassert>
#include <limits>

namespace haarmony::video {
namespace {

constexpr std::size_t kFirstSlots = 256;

}  // namespace

ContentTable::ContentTable() : slots_(kFirstSlots, 0) {}

std::size_t ContentTable::first_place(std::uint64_t hash, std::uint32_t kind) const {
    const std::uint64_t mixed = (hash + kind) * 0x9E37'79B9'7F4A'7C15;
    return static_cast<std::size_t>(mixed >> 32) & (slots_.size() - 1);
}

void ContentTable::place(std::size_t entry) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = first_place(entries_[entry].hash, entries_[entry].kind);
    for (std::size_t probe = 0; probe < kMaxProbes; ++probe, at = (at + 1) & mask) {
        if (slots_[at] != 0) continue;
        slots_[at] = static_cast<Slot>(entry + 1);
        return;
    }
}

void ContentTable::grow() {
    assert(entries_.size() < std::numeric_limits<Slot>::max() / 2);
    slots_.assign(2 * slots_.size(), 0);
    for (std::size_t entry = 0; entry < entries_.size(); ++entry) place(entry);
}

void ContentTable::shrink(std::size_t size) {
    assert(size <= entries_.size());
    const std::size_t mask = slots_.size() - 1;
    // Last come, first gone: no entry that stays was probed past one that goes.
    while (entries_.size() > size) {
        const Entry& last = entries_.back();
        std::size_t at = first_place(last.hash, last.kind);
        for (std::size_t probe = 0; probe < kMaxProbes; ++probe, at = (at + 1) & mask) {
            if (slots_[at] != entries_.size()) continue;
            slots_[at] = 0;
            break;
        }
        entries_.pop_back();
    }
}

}  // namespace haarmony::video
