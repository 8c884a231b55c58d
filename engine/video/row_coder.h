// The residuals of bricks as streams: a row of eight goes to the stream of its class, so that
// what is in one stream is of one size and compresses well by counting alone.
//   brick_kernel.h, stream_coder.h -> [row_coder.h] -> brick_coder.h
//
// Shape   for each of 8 rows of pixels a byte with three classes (green + 6 red + 36 blue), and
//         for each row of alpha a byte with one; then the rows' bytes, by class: the planes
//         one after the other, each from the top.
// Errors  opening: kUndecodable where there are more rows than bricks have. Reading past the
//         end gives any residuals, and at_end() says so: a reader checks once, behind the last
//         brick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/brick_kernel.h"
#include "engine/video/stream_coder.h"

namespace haarmony::video {

class RowWriter {
  public:
    void put(const PackedRows& rows, bool alpha);
    void finish(std::vector<std::byte>& out) const;

  private:
    // More than a brick can add is always there.
    struct Bytes {
        Stream bytes;
        std::size_t used = 0;
        std::uint8_t* room();
    };
    static constexpr std::size_t kColorClasses = 0;  // class 0 has no bytes of its own
    std::array<Bytes, kRowClasses> rows_;
    Bytes alpha_classes_;
};

class RowReader {
  public:
    // Reads the streams of `bricks` bricks at most.
    [[nodiscard]] static Result<RowReader> open(StreamReader& reader,
                                                std::uint64_t bricks);

    // `residuals` of alpha are left alone without `alpha`.
    void next(bool alpha, Residuals& residuals);
    // Whether all was read, nothing was missing, and every class was one.
    [[nodiscard]] bool at_end() const;

  private:
    // A stream of packed rows, of which the next ones are unpacked.
    struct Rows {
        Stream packed;
        std::size_t next = 0;  // to unpack
        std::vector<std::uint8_t> unpacked;
        std::size_t begin = 0;
        std::size_t end = 0;
    };
    RowReader() = default;

    void refill(std::size_t row_class);
    void take_classes(std::size_t stream, std::array<std::uint8_t, kBrickSide>& classes);

    std::array<Stream, 2> classes_;  // of colours, of alpha
    std::array<std::size_t, 2> next_class_{};
    std::array<Rows, kRowClasses> rows_;
    bool damaged_ = false;
};

}  // namespace haarmony::video
