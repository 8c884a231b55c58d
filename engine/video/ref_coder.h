// Refs as bytes: most of them are what stands at the same place elsewhere, or the next in the
// order of coding.
//   stream_coder.h -> [ref_coder.h] -> layer_coder.h, time_node_coder.h
//
// Shape    a stream of kinds, and one of refs that are spelled out, 5 bytes each; these count
//          time levels upwards from their own.
// Errors   reading: damaged() where a kind or a ref is none of the format's, or missing. That a
//          ref lies within its layer is for the caller to see.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/video/layer.h"
#include "engine/video/stream_coder.h"

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
using Candidates = std::array<Ref, kExplicit>;
inline constexpr std::size_t kExplicitBytes = 5;

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

  private:
    int own_level_;
    std::uint32_t next_ = 0;
};

class PutRefs {
  public:
    void code(Ref& ref, const Candidates& candidates, RefSequence& sequence) {
        std::uint8_t kind = 0;
        while (kind < kExplicit && candidates[kind] != ref) ++kind;
        kinds_.push_back(kind);
        if (kind == kExplicit) {
            const int up = sequence.own_level() - time_level_of(ref);
            std::uint64_t bits = index_of(ref) | static_cast<std::uint64_t>(up) << 32;
            for (std::size_t i = 0; i < kExplicitBytes; ++i, bits >>= 8)
                spelled_.push_back(static_cast<std::uint8_t>(bits));
        }
        sequence.saw(ref);
    }
    void finish(std::vector<std::byte>& out) const {
        put_stream(kinds_, Redundancy::kRepeated, out);
        put_stream(spelled_, Redundancy::kRepeated, out);
    }

  private:
    Stream kinds_;
    Stream spelled_;
};

class TakeRefs {
  public:
    // Reads the streams of so many refs at most.
    [[nodiscard]] static Result<TakeRefs> open(StreamReader& reader, std::uint64_t refs) {
        Result<Stream> kinds = reader.next(refs);
        if (!kinds) return std::move(kinds).error();
        Result<Stream> spelled = reader.next(refs * kExplicitBytes);
        if (!spelled) return std::move(spelled).error();
        return TakeRefs(*std::move(kinds), *std::move(spelled));
    }

    void code(Ref& ref, const Candidates& candidates, RefSequence& sequence) {
        ref = kNoDetailRef;
        const std::uint8_t kind =
            next_kind_ < kinds_.size() ? kinds_[next_kind_++] : kExplicit + 1;
        if (kind > kExplicit) {
            damaged_ = true;
            return;
        }
        ref = kind == kExplicit ? spelled(sequence) : candidates[kind];
        sequence.saw(ref);
    }
    [[nodiscard]] bool damaged() const { return damaged_; }
    [[nodiscard]] bool at_end() const {
        return !damaged_ && next_kind_ == kinds_.size() &&
               next_spelled_ == spelled_.size();
    }

  private:
    TakeRefs(Stream kinds, Stream spelled)
        : kinds_(std::move(kinds)), spelled_(std::move(spelled)) {}

    Ref spelled(const RefSequence& sequence) {
        if (spelled_.size() - next_spelled_ < kExplicitBytes) {
            damaged_ = true;
            return kNoDetailRef;
        }
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < kExplicitBytes; ++i)
            bits |= std::uint64_t{spelled_[next_spelled_ + i]} << 8 * i;
        next_spelled_ += kExplicitBytes;
        const int level = sequence.own_level() - static_cast<int>(bits >> 32);
        if (level < 0 || (bits & 0xFFFF'FFFF) > kMaxRefIndex) {
            damaged_ = true;
            return kNoDetailRef;
        }
        return make_ref(level, static_cast<std::uint32_t>(bits));
    }

    Stream kinds_;
    Stream spelled_;
    std::size_t next_kind_ = 0;
    std::size_t next_spelled_ = 0;
    bool damaged_ = false;
};

}  // namespace haarmony::video
