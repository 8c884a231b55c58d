// Numbers out of bytes that nobody has checked yet: every read beyond the end is an empty
// answer, never a fault.
//
// Shape   offsets count from the start of the span; a reader is a view and owns nothing.
// Threads const-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

namespace haarmony::ingest {

enum class ByteOrder { kBig, kLittle };

class ByteReader {
  public:
    ByteReader(std::span<const std::uint8_t> bytes, ByteOrder order)
        : bytes_(bytes), order_(order) {}

    [[nodiscard]] std::size_t size() const { return bytes_.size(); }

    // `count` bytes (1..8) at `offset` as one unsigned number.
    [[nodiscard]] std::optional<std::uint64_t> number(std::uint64_t offset,
                                                      int count) const {
        const std::uint64_t width = static_cast<std::uint64_t>(count);
        if (offset > bytes_.size() || bytes_.size() - offset < width) return std::nullopt;
        std::uint64_t value = 0;
        for (std::uint64_t i = 0; i < width; ++i) {
            const std::uint64_t at = order_ == ByteOrder::kBig ? i : width - 1 - i;
            value = value << 8 | bytes_[offset + at];
        }
        return value;
    }
    [[nodiscard]] std::optional<std::uint64_t> u8(std::uint64_t at) const {
        return number(at, 1);
    }
    [[nodiscard]] std::optional<std::uint64_t> u16(std::uint64_t at) const {
        return number(at, 2);
    }
    [[nodiscard]] std::optional<std::uint64_t> u24(std::uint64_t at) const {
        return number(at, 3);
    }
    [[nodiscard]] std::optional<std::uint64_t> u32(std::uint64_t at) const {
        return number(at, 4);
    }
    [[nodiscard]] std::optional<std::uint64_t> u64(std::uint64_t at) const {
        return number(at, 8);
    }

    // Whether exactly these bytes stand at `offset`.
    [[nodiscard]] bool has(std::uint64_t offset, std::string_view expected) const {
        return offset <= bytes_.size() && bytes_.size() - offset >= expected.size() &&
               std::memcmp(bytes_.data() + offset, expected.data(), expected.size()) == 0;
    }

    // The bytes of [offset, offset + count), or as many of them as there are.
    [[nodiscard]] std::span<const std::uint8_t> slice(std::uint64_t offset,
                                                      std::uint64_t count) const {
        if (offset >= bytes_.size()) return {};
        const std::uint64_t left = bytes_.size() - offset;
        return bytes_.subspan(offset, count < left ? count : left);
    }

  private:
    std::span<const std::uint8_t> bytes_;
    ByteOrder order_;
};

}  // namespace haarmony::ingest
