// Numbers as bytes of a .mrv file, written and read.
//
// Shape   fixed numbers little-endian; a varint has 7 bits a byte, the low ones first, the top
//         bit saying that more follow, at most 10 bytes.
// Errors  reading past the end, or a varint of more than 64 bits, gives 0 and overrun().
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace haarmony::video {

static_assert(std::endian::native == std::endian::little);

template <std::integral T>
void put_fixed(std::vector<std::byte>& out, T value) {
    const std::size_t at = out.size();
    out.resize(at + sizeof value);
    std::memcpy(out.data() + at, &value, sizeof value);
}

inline void put_varint(std::vector<std::byte>& out, std::uint64_t value) {
    for (; value >= 128; value >>= 7) out.push_back(static_cast<std::byte>(value | 128));
    out.push_back(static_cast<std::byte>(value));
}

class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

    template <std::integral T>
    [[nodiscard]] T fixed() {
        T value = 0;
        if (rest_.size() < sizeof value) {
            fail();
            return 0;
        }
        std::memcpy(&value, rest_.data(), sizeof value);
        rest_ = rest_.subspan(sizeof value);
        return value;
    }
    [[nodiscard]] std::uint64_t varint() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            if (rest_.empty()) break;
            const auto byte = std::to_integer<std::uint64_t>(rest_.front());
            rest_ = rest_.subspan(1);
            if (shift == 63 && byte > 1) break;
            value |= (byte & 127) << shift;
            if (byte < 128) return value;
        }
        fail();
        return 0;
    }
    // Requires: no more than rest() has.
    [[nodiscard]] std::span<const std::byte> take(std::size_t bytes) {
        const std::span<const std::byte> taken = rest_.first(bytes);
        rest_ = rest_.subspan(bytes);
        return taken;
    }
    [[nodiscard]] bool overrun() const { return overrun_; }
    [[nodiscard]] std::span<const std::byte> rest() const { return rest_; }

  private:
    void fail() {
        overrun_ = true;
        rest_ = {};
    }

    std::span<const std::byte> rest_;
    bool overrun_ = false;
};

}  // namespace haarmony::video
