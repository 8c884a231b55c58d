// One brick as a mode and what is left of it when its prediction is taken off.
//   brick_prediction.h, row_coder.h -> [brick_coder.h] -> layer_coder.h
//
// Shape   a byte of the stream of modes: reference, whether red and blue follow green, how
//         alpha is known, whether any residuals are there; then the residuals' rows.
// Units   residuals modulo 256; MRV.md has every formula.
// Errors  reading: a mode that is none is kUndecodable; missing rows at the end.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/brick_prediction.h"
#include "engine/video/row_coder.h"

namespace haarmony::video {

enum class AlphaMode : std::uint8_t { kOpaque, kAsPredicted, kCoded };
inline constexpr int kAlphaModes = 3;

// The mode of one brick.
struct BrickMode {
    Reference reference = Reference::kBefore;
    bool follows_green = false;
    AlphaMode alpha = AlphaMode::kOpaque;
    bool exact = false;  // no residuals

    [[nodiscard]] constexpr std::uint8_t symbol() const {
        const int all =
            (static_cast<int>(alpha) * kReferences + static_cast<int>(reference)) * 4 +
            (follows_green ? 2 : 0) + (exact ? 1 : 0);
        return static_cast<std::uint8_t>(all);
    }
};
inline constexpr int kModeSymbols = kAlphaModes * kReferences * 4;

// Whether a symbol is a mode's: alpha that is coded is a residual.
[[nodiscard]] constexpr bool is_mode(int symbol) {
    return symbol < kModeSymbols &&
           (symbol / 4 / kReferences != static_cast<int>(AlphaMode::kCoded) ||
            (symbol & 1) == 0);
}
// Requires: symbol < kModeSymbols.
[[nodiscard]] constexpr BrickMode mode_of(int symbol) {
    return {.reference = static_cast<Reference>(symbol / 4 % kReferences),
            .follows_green = (symbol & 2) != 0,
            .alpha = static_cast<AlphaMode>(symbol / 4 / kReferences),
            .exact = (symbol & 1) != 0};
}

class BrickEncoder {
  public:
    // In the way that leaves least. Requires: canonical() pixels.
    void put(const Brick& brick, const BrickNeighbors& neighbors);
    void finish(std::vector<std::byte>& out) const;

    // How many ways of predicting are compared.
    static constexpr std::size_t kTried = kReferences - 1;

  private:
    Stream modes_;
    RowWriter rows_;
    std::array<PredictionRoom, kTried> rooms_;
    Brick before_ = kGrey;
};

class BrickDecoder {
  public:
    // Reads the streams of `bricks` bricks.
    [[nodiscard]] static Result<BrickDecoder> open(StreamReader& reader,
                                                   std::uint64_t bricks);

    // The mode of the next brick, which need not be one that it can have.
    [[nodiscard]] std::uint8_t next_symbol();
    // The brick whose mode was read, or kUndecodable where it cannot have that mode.
    [[nodiscard]] Result<void> next(std::uint8_t symbol,
                                    const BrickNeighbors& neighbors,
                                    Brick& brick);
    // Whether all was read, and nothing was missing.
    [[nodiscard]] bool at_end() const {
        return next_mode_ == modes_.size() && rows_.at_end();
    }

  private:
    BrickDecoder(Stream modes, RowReader rows)
        : modes_(std::move(modes)), rows_(std::move(rows)) {}

    Stream modes_;
    std::size_t next_mode_ = 0;
    RowReader rows_;
    Residuals residuals_{};
    Brick before_ = kGrey;
    PredictionRoom room_;
};

}  // namespace haarmony::video
