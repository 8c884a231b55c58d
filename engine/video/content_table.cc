#include "engine/video/content_table.h"

#include <cassert>
#include <limits>

namespace haarmony::video {
namespace {

constexpr std::size_t kFirstSlots = 256;

}  // namespace

ContentTable::ContentTable() : slots_(kFirstSlots) {}

void ContentTable::place(std::size_t entry) {
    const std::size_t mask = slots_.size() - 1;
    const std::uint64_t mixed = mix(entries_[entry].hash, entries_[entry].kind);
    std::size_t at = first_place(mixed);
    for (std::size_t probe = 0; probe < kMaxProbes; ++probe, at = (at + 1) & mask) {
        if (slots_[at].entry != 0) continue;
        slots_[at] = {static_cast<std::uint32_t>(mixed),
                      static_cast<std::uint32_t>(entry + 1)};
        return;
    }
}

void ContentTable::grow() {
    assert(entries_.size() < std::numeric_limits<std::uint32_t>::max() / 2);
    slots_.assign(2 * slots_.size(), Slot{});
    for (std::size_t entry = 0; entry < entries_.size(); ++entry) place(entry);
}

void ContentTable::shrink(std::size_t size) {
    assert(size <= entries_.size());
    const std::size_t mask = slots_.size() - 1;
    // Last come, first gone: no entry that stays was probed past one that goes.
    while (entries_.size() > size) {
        const Entry& last = entries_.back();
        std::size_t at = first_place(mix(last.hash, last.kind));
        for (std::size_t probe = 0; probe < kMaxProbes; ++probe, at = (at + 1) & mask) {
            if (slots_[at].entry != entries_.size()) continue;
            slots_[at] = Slot{};
            break;
        }
        entries_.pop_back();
    }
}

}  // namespace haarmony::video
