#include "server/api/base64.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace haarmony::server {
namespace {

constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::int8_t kNoDigit = -1;

constexpr std::array<std::int8_t, 256> digits() {
    std::array<std::int8_t, 256> table{};
    table.fill(kNoDigit);
    for (std::size_t i = 0; i < kAlphabet.size(); ++i)
        table[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::int8_t>(i);
    return table;
}

constexpr std::array<std::int8_t, 256> kDigits = digits();

Error wrong_at(std::size_t position) {
    return {ErrorCode::kInvalidArgument,
            "not base64 at position " + std::to_string(position)};
}

}  // namespace

Result<std::string> decode_base64(std::string_view text) {
    if (text.size() % 4 != 0)
        return Error{ErrorCode::kInvalidArgument,
                     "not base64: its length " + std::to_string(text.size()) +
                         " is not a multiple of 4"};
    std::size_t padding = 0;
    while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=')
        ++padding;
    const std::string_view digits = text.substr(0, text.size() - padding);

    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        const std::int8_t digit = kDigits[static_cast<unsigned char>(digits[i])];
        if (digit == kNoDigit) return wrong_at(i);
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        bit_count += 6;
        if (bit_count < 8) continue;
        bit_count -= 8;
        bytes.push_back(static_cast<char>(bits >> bit_count & 0xff));
        bits &= (1U << bit_count) - 1;
    }
    if (bits != 0) return wrong_at(digits.size() - 1);
    return bytes;
}

std::string encode_base64(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits =
                bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text.push_back(k <= count ? kAlphabet[bits >> (18 - 6 * k) & 63] : '=');
    }
    return text;
}

}  // namespace haarmony::server
