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
    // 0 is empty, else 1 + index of the entry.
    using Slot = std::uint32_t;

    [[nodiscard]] std::size_t first_place(std::uint64_t hash, std::uint32_t kind) const;
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
    std::size_t at = first_place(hash, kind);
    for (std::size_t probe = 0; probe < kMaxProbes; ++probe, at = (at + 1) & mask) {
        const Slot slot = slots_[at];
        if (slot == 0) {
            const Ref made = make();
            if (made == kNoDetailRef) return made;
            entries_.push_back({hash, kind, made});
            slots_[at] = static_cast<Slot>(entries_.size());
            return made;
        }
        const Entry& entry = entries_[slot - 1];
        if (entry.hash == hash && entry.kind == kind && equal(entry.ref)) {
            return entry.ref;
        }
    }
    return make();
}

}  // namespace haarmony::video
