// Which nodes and bricks a time node and its ancestors have already, by content.
//   layer.h -> [content_table.h] -> up_links.h
//
// Shape    open addressing over entries in the order of their arrival; what came last can be
//          taken back, which is all that a walk through the time tree needs.
// Errors   none. A key is a hash and a kind; the caller compares what two hashes can confuse.
//          No more than kMaxProbes places are looked at: content made to collide is found
//          less often, and costs no more.
// Threads  one caller.
// Source   sec. 5.2.2 [up-links]; DESIGN of the project, "Video": sharing by content hash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/video/layer.h"

namespace haarmony::video {

class ContentTable {
  public:
    static constexpr std::size_t kMaxProbes = 64;

    ContentTable();

    // The ref under (hash, kind) for which equal(ref) holds, else make() and remember it.
    // make() may return kNoDetailRef, which is handed on and not remembered.
    template <typename Equal, typename Make>
    Ref find_or_make(std::uint64_t hash, std::uint32_t kind, Equal equal, Make make);

    [[nodiscard]] std::size_t size() const { return entries_.size(); }
    // Takes back what came after size() was `size`.
    void shrink(std::size_t size);

  private:
    struct Entry {
        std::uint64_t hash = 0;
        std::uint32_t kind = 0;
        Ref ref = kNoDetailRef;
    };
    // A part of the hash stands beside the index: most slots of others are passed without
    // a look at their entries, each of which would be fetched from memory.
    struct Slot {
        std::uint32_t tag = 0;
        std::uint32_t entry = 0;  // 1 + index, 0 where there is none
    };

    // Its upper half says where to look first, its lower half is the tag.
    [[nodiscard]] static std::uint64_t mix(std::uint64_t hash, std::uint32_t kind) {
        const std::uint64_t mixed = (hash + kind) * 0x9E37'79B9'7F4A'7C15;
        return mixed ^ mixed >> 32;
    }
    [[nodiscard]] std::size_t first_place(std::uint64_t mixed) const {
        return static_cast<std::size_t>(mixed >> 32) & (slots_.size() - 1);
    }
    void place(std::size_t entry);
    void grow();

    std::vector<Entry> entries_;
    std::vector<Slot> slots_;  // a power of two
};

template <typename Equal, typename Make>
Ref ContentTable::find_or_make(std::uint64_t hash,
                               std::uint32_t kind,
                               Equal equal,
                               Make make) {
    if (2 * (entries_.size() + 1) > slots_.size()) grow();
    const std::size_t mask = slots_.size() - 1;
    const std::uint64_t mixed = mix(hash, kind);
    const auto tag = static_cast<std::uint32_t>(mixed);
    std::size_t at = first_place(mixed);
    for (std::size_t probe = 0; probe < kMaxProbes; ++probe, at = (at + 1) & mask) {
        const Slot slot = slots_[at];
        if (slot.entry == 0) {
            const Ref made = make();
            if (made == kNoDetailRef) return made;
            entries_.push_back({hash, kind, made});
            slots_[at] = {tag, static_cast<std::uint32_t>(entries_.size())};
            return made;
        }
        if (slot.tag != tag) continue;
        const Entry& entry = entries_[slot.entry - 1];
        if (entry.hash == hash && entry.kind == kind && equal(entry.ref)) {
            return entry.ref;
        }
    }
    return make();
}

}  // namespace haarmony::video
