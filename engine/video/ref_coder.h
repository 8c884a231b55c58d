// Refs as symbols: most of them are what stands at the same place elsewhere, or the next in
// the order of coding.
//   symbol_coder.h -> [ref_coder.h] -> layer_coder.h, time_node_coder.h
//
// Shape    a ref that is spelled out counts time levels upwards from its own.
// Errors   reading: damaged() where a kind or a ref is none of the format's. That a ref lies
//          within its layer is for the caller to see.
#pragma once

#include <array>
#include <cstdint>

#include "engine/video/layer.h"
#include "engine/video/symbol_coder.h"

namespace haarmony::video {

// What a ref is likely to be: none, the next of its own layer, what is at the same place in
// the time-parent, in the first half, in the tree of the other edge rule. Anything else is
// spelled out.
enum RefKind : std::uint8_t {
    kNoRef,
    kNext,
    kOfParent,
    kOfFirst,
    kOfOtherEdge,
    kExplicit
};
static_assert(kExplicit + 1 == kRefKinds);
using Candidates = std::array<Ref, kExplicit>;

inline constexpr Candidates kNoCandidates = {kNoDetailRef,
                                             kNoDetailRef,
                                             kNoDetailRef,
                                             kNoDetailRef,
                                             kNoDetailRef};

// Refs into one layer, in the order of coding.
class RefSequence {
  public:
    explicit RefSequence(int own_level) : own_level_(own_level) {}

    [[nodiscard]] int own_level() const { return own_level_; }
    [[nodiscard]] Ref next() const { return make_ref(own_level_, next_); }
    void saw(Ref ref) {
        if (time_level_of(ref) == own_level_ && index_of(ref) >= next_)
            next_ = index_of(ref) + 1;
    }
    int last_kind = 0;

  private:
    int own_level_;
    std::uint32_t next_ = 0;
};

class PutRefs {
  public:
    explicit PutRefs(SymbolWriter& symbols) : symbols_(symbols) {}
    void code(Ref& ref,
              const Candidates& candidates,
              int context,
              RefSequence& sequence) {
        std::uint8_t kind = 0;
        while (kind < kExplicit && candidates[kind] != ref) ++kind;
        symbols_.put(0, context + sequence.last_kind, kind);
        sequence.last_kind = kind;
        if (kind == kExplicit) {
            const int up = sequence.own_level() - time_level_of(ref);
            std::uint64_t bits = index_of(ref) | static_cast<std::uint64_t>(up) << 32;
            for (int i = 0; i < kExplicitBytes; ++i, bits >>= 8)
                symbols_.put(0, kExplicitContext + i, static_cast<std::uint8_t>(bits));
        }
        sequence.saw(ref);
    }

  private:
    SymbolWriter& symbols_;
};

class TakeRefs {
  public:
    explicit TakeRefs(SymbolCursor& symbols) : symbols_(symbols) {}
    void code(Ref& ref,
              const Candidates& candidates,
              int context,
              RefSequence& sequence) {
        const std::uint8_t kind = symbols_.next<0>(context + sequence.last_kind);
        ref = kNoDetailRef;
        if (kind > kExplicit) {
            damaged_ = true;
            return;
        }
        sequence.last_kind = kind;
        if (kind == kExplicit) {
            std::uint64_t bits = 0;
            for (int i = 0; i < kExplicitBytes; ++i) {
                bits |= std::uint64_t{symbols_.next<0>(kExplicitContext + i)} << 8 * i;
            }
            const int level = sequence.own_level() - static_cast<int>(bits >> 32);
            if (level < 0 || (bits & 0xFFFF'FFFF) > kMaxRefIndex) {
                damaged_ = true;
                return;
            }
            ref = make_ref(level, static_cast<std::uint32_t>(bits));
        } else {
            ref = candidates[kind];
        }
        sequence.saw(ref);
    }
    [[nodiscard]] bool damaged() const { return damaged_; }

  private:
    SymbolCursor& symbols_;
    bool damaged_ = false;
};

}  // namespace haarmony::video
