#include "engine/image/base64url.h"

namespace haarmony::image {
namespace {

constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

Error refused(std::string message) {
    return Error{ErrorCode::kInvalidArgument, std::move(message)};
}

}  // namespace

std::string base64url_encode(std::span<const std::uint8_t> bytes) {
    std::string text;
    text.reserve(base64url_length(bytes.size()));
    std::uint32_t bits = 0;
    int count = 0;
    for (const std::uint8_t byte : bytes) {
        bits = (bits << 8 | byte) & 0xFFFFU;
        for (count += 8; count >= 6; count -= 6) {
            text += kAlphabet[bits >> (count - 6) & 63U];
        }
    }
    if (count > 0) text += kAlphabet[bits << (6 - count) & 63U];
    return text;
}

Result<std::vector<std::uint8_t>> base64url_decode(std::string_view text) {
    if (text.size() % 4 == 1) {
        return refused("has " + std::to_string(text.size()) +
                       " characters, which base64url cannot");
    }
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() * 3 / 4);
    std::uint32_t bits = 0;
    int count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::size_t digit = kAlphabet.find(text[i]);
        if (digit == std::string_view::npos) {
            return refused("has byte " + std::to_string(std::uint8_t(text[i])) +
                           " at position " + std::to_string(i) +
                           ", which is not base64url");
        }
        bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0x3FFFU;
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<std::uint8_t>(bits >> count));
        }
    }
    if ((bits & ((1U << count) - 1U)) != 0) {
        return refused("ends in bits that belong to no byte");
    }
    return bytes;
}

}  // namespace haarmony::image
