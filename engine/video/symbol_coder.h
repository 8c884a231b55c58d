// Bytes in contexts, entropy-coded: range variant of asymmetric numeral systems (rANS) with
// tables of frequencies that stand in front of the coded words.
//   symbol_context.h -> [symbol_coder.h] -> brick_coder.h, layer_coder.h
//
// Shape   three independent states (lanes), so that the three planes of a pixel decode at the
//         same time; one stream of 16-bit words. A table has 2048 parts. Contexts with similar
//         statistics share a table: small chunks pay for one or two tables only.
// Errors  reading: kUndecodable where tables or words are damaged. Reading past the end gives
//         zeros, and finish() says so: a reader checks once, behind the last symbol.
// Source  J. Duda, "Asymmetric numeral systems", arXiv:1311.2540; the sharing of tables as in
//         JPEG XL (ISO/IEC 18181-1, C.2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/symbol_context.h"

namespace haarmony::video {

inline constexpr int kTableBits = 11;
inline constexpr std::uint32_t kTableParts = 1U << kTableBits;
inline constexpr std::uint32_t kLowestState = 1U << 16;
inline constexpr int kLanes = 3;
inline constexpr int kMaxTables = 64;
inline constexpr int kSymbols = 256;

// What symbols cost in each context, in 1/256 bit: estimates for whoever chooses between ways
// to say the same.
using SymbolCosts = std::array<std::array<std::uint16_t, kSymbols>, kContexts>;

class SymbolWriter {
  public:
    void put(int lane, int context, std::uint8_t symbol) {
        symbols_.push_back({static_cast<std::uint8_t>(lane),
                            static_cast<std::uint8_t>(context),
                            symbol});
    }
    [[nodiscard]] std::size_t size() const { return symbols_.size(); }
    // Appends tables and words, and brings `costs` to what these symbols did cost.
    void finish(std::vector<std::byte>& out, SymbolCosts& costs);

  private:
    struct Symbol {
        std::uint8_t lane;
        std::uint8_t context;
        std::uint8_t symbol;
    };
    static_assert(kContexts <= 256);
    std::vector<Symbol> symbols_;
};

// Tables, and where in the words reading is. Cheap to copy: where much is read, a copy stays
// in registers.
class SymbolCursor {
  public:
    template <int kLane>
    [[nodiscard, gnu::always_inline]] std::uint8_t next(int context) {
        std::uint32_t& state = states_[kLane];
        const std::uint32_t part = (*tables_)[context][state & (kTableParts - 1)];
        state = (part & 0xFFF) * (state >> kTableBits) + (part >> 12 & 0xFFF);
        if (state < kLowestState) [[unlikely]]
            refill(state);
        return static_cast<std::uint8_t>(part >> 24);
    }

  private:
    friend class SymbolReader;

    void refill(std::uint32_t& state) {
        std::uint16_t word = 0;
        if (end_ - at_ >= 2) {
            std::memcpy(&word, at_, sizeof word);
            at_ += 2;
        } else {
            overrun_ = true;
        }
        state = state << 16 | word;
    }

    // Each part of a table: symbol << 24 | part's number within the symbol << 12 | frequency.
    const std::array<const std::uint32_t*, kContexts>* tables_ = nullptr;
    std::array<std::uint32_t, kLanes> states_{};
    const std::byte* at_ = nullptr;
    const std::byte* end_ = nullptr;
    bool overrun_ = false;
};

class SymbolReader {
  public:
    // Reads the tables. `bytes` must outlive the reader.
    [[nodiscard]] static Result<SymbolReader> open(std::span<const std::byte> bytes);

    [[nodiscard]] SymbolCursor& cursor() { return cursor_; }
    // Whether the symbols read were all that there are, and nothing was missing.
    [[nodiscard]] bool at_end() const;

  private:
    struct Tables {
        std::array<const std::uint32_t*, kContexts> of_context{};
        std::vector<std::uint32_t> parts;
    };
    SymbolReader() = default;

    std::unique_ptr<Tables> tables_ = std::make_unique<Tables>();
    SymbolCursor cursor_;
};

}  // namespace haarmony::video
