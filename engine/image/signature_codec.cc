#include "engine/image/signature_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <bitset>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

#include "engine/image/base64url.h"
#include "engine/image/color_space.h"

namespace haarmony::image {
namespace {

constexpr std::uint8_t kMagic0 = 'H';
constexpr std::uint8_t kMagic1 = 'S';
constexpr std::uint8_t kVersion = 1;
constexpr std::uint8_t kAlgorithm = 1;  // signs and indices of the largest
constexpr std::uint8_t kLowInformationFlag = 1;
constexpr std::size_t kColorSpaceOffset = 4;
constexpr std::size_t kDecompositionOffset = 5;
constexpr std::size_t kAverageOffset = 8;
constexpr std::size_t kCountOffset = 20;

// A mean is the end of 14 additions in float, each rounded by at most 2^-24 of its size, which
// is below 2 in every colour space.
constexpr double kAverageSlack = 32.0 / double{kAverageOne};

Error invalid(std::string message) {
    return Error{ErrorCode::kInvalidArgument, std::move(message), "signature"};
}

// A channel of a colour space, as messages name it.
struct ChannelOf {
    ColorSpace space{};
    int channel = 0;

    [[nodiscard]] std::string text() const {
        return " in channel " + std::string(channel_name(space, channel));
    }
};

// The reason why `average` cannot be the mean of this channel.
std::optional<Error> check_average(const ChannelOf& channel, double average) {
    const auto [lowest, highest] = channel_range(channel.space, channel.channel);
    if (average >= lowest - kAverageSlack && average <= highest + kAverageSlack)
        return std::nullopt;
    return invalid("average " + std::to_string(average) + channel.text() +
                   " is outside [" + std::to_string(lowest) + ", " +
                   std::to_string(highest) + "]");
}

std::optional<Error> check_count(const ChannelOf& channel, std::size_t count) {
    if (count <= std::size_t{kMaxCoefficients}) return std::nullopt;
    return invalid(std::to_string(count) + " coefficients" + channel.text() +
                   ", at most " + std::to_string(kMaxCoefficients));
}

// Appends signed indices to one channel after the other, refusing those that no picture can
// have. Requires: at most kMaxCoefficients for a channel.
class IndexReader {
  public:
    // For all that follow. Only the bits that the channel before has set are cleared.
    void begin(const ChannelOf& channel, ChannelSignature& out) {
        if (out_ != nullptr) {
            for (const std::int16_t index : out_->largest(kMaxCoefficients))
                seen_.reset(std::size_t(std::abs(index)));
        }
        channel_ = channel;
        out_ = &out;
    }

    // Whether it could be appended.
    [[nodiscard]] bool add(int signed_index) {
        const std::int64_t index = std::abs(std::int64_t{signed_index});
        if (index == 0 || index >= kCoefficientCount || seen_[std::size_t(index)])
            return false;
        seen_[std::size_t(index)] = true;
        out_->indices[out_->count++] = static_cast<std::int16_t>(signed_index);
        return true;
    }

    // Why not.
    [[nodiscard]] Error refusal(int signed_index) const {
        const std::int64_t index = std::abs(std::int64_t{signed_index});
        if (index == 0 || index >= kCoefficientCount) {
            return invalid("index " + std::to_string(signed_index) + channel_.text() +
                           " is outside 1.." + std::to_string(kCoefficientCount - 1));
        }
        return invalid("index " + std::to_string(index) + channel_.text() +
                       " is there twice");
    }

  private:
    ChannelOf channel_{};
    ChannelSignature* out_ = nullptr;
    std::bitset<kCoefficientCount> seen_;
};

void put_le(std::uint32_t value, int bytes, std::vector<std::uint8_t>& out) {
    for (int i = 0; i < bytes; ++i) {
        out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }
}

std::int32_t get_le32(const std::uint8_t* bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value |= std::uint32_t{bytes[i]} << (8 * i);
    return static_cast<std::int32_t>(value);
}

std::int16_t get_le16(const std::uint8_t* bytes) {
    return static_cast<std::int16_t>(bytes[0] | bytes[1] << 8);
}

// `bytes` has two for each of `indices`.
void get_indices(const std::uint8_t* bytes, std::span<std::int16_t> indices) {
    if constexpr (std::endian::native == std::endian::little) {
        std::memcpy(indices.data(), bytes, indices.size_bytes());
    } else {
        for (std::size_t i = 0; i < indices.size(); ++i)
            indices[i] = get_le16(bytes + 2 * i);
    }
}

// Whether IndexReader takes lists of indices, without a jump for each: a start reads millions.
class IndexCheck {
  public:
    [[nodiscard]] bool passes(std::span<const std::int16_t> indices) {
        std::array<std::uint16_t, kMaxCoefficients> magnitudes;
        std::uint16_t farthest = 0;
        for (std::size_t i = 0; i < indices.size(); ++i) {
            // In 16 bits alone: eight at a time. That of -32768 stays above all.
            const auto bits = static_cast<std::uint16_t>(indices[i]);
            const auto sign = static_cast<std::uint16_t>(indices[i] >> 15);
            magnitudes[i] = static_cast<std::uint16_t>((bits ^ sign) - sign);
            farthest = std::max(farthest, static_cast<std::uint16_t>(magnitudes[i] - 1));
        }
        // That of 0 is the largest of all.
        if (!indices.empty() && farthest >= kCoefficientCount - 1) return false;
        std::uint64_t twice = 0;
        for (std::size_t i = 0; i < indices.size(); ++i) {
            std::uint64_t& word = seen_[magnitudes[i] / 64];
            const std::uint64_t bit = std::uint64_t{1} << (magnitudes[i] % 64);
            twice |= word & bit;
            word |= bit;
        }
        for (std::size_t i = 0; i < indices.size(); ++i) seen_[magnitudes[i] / 64] = 0;
        return twice == 0;
    }

  private:
    std::array<std::uint64_t, kCoefficientCount / 64> seen_{};
};

// Why IndexCheck does not let them pass.
Error refusal_of(const ChannelOf& place, std::span<const std::int16_t> indices) {
    IndexReader reader;
    ChannelSignature channel;
    reader.begin(place, channel);
    const auto refused = std::ranges::find_if(
        indices, [&](std::int16_t index) { return !reader.add(index); });
    assert(refused != indices.end());
    return reader.refusal(*refused);
}

template <typename Enum>
constexpr std::uint8_t byte(Enum value) {
    return static_cast<std::uint8_t>(value);
}

// Everything before the averages.
std::optional<Error> check_header(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < kSignatureHeaderBytes) {
        return invalid("a signature of " + std::to_string(bytes.size()) +
                       " bytes is shorter than its header of " +
                       std::to_string(kSignatureHeaderBytes));
    }
    if (bytes[0] != kMagic0 || bytes[1] != kMagic1) {
        return invalid("not a signature: it starts with bytes " +
                       std::to_string(bytes[0]) + ", " + std::to_string(bytes[1]));
    }
    if (bytes[2] > kVersion) {
        Error error = invalid("signature version " + std::to_string(bytes[2]) +
                              " is newer than " + std::to_string(kVersion));
        error.code = ErrorCode::kNewerVersion;
        return error;
    }
    struct Field {
        std::size_t offset;
        std::uint8_t lowest;
        std::uint8_t highest;
        const char* name;
    };
    constexpr std::array<Field, 5> kFields = {
        {{2, kVersion, kVersion, "version"},
         {3, kAlgorithm, kAlgorithm, "algorithm"},
         {kColorSpaceOffset,
          byte(ColorSpace::kYiq),
          byte(ColorSpace::kLuv),
          "color space"},
         {kDecompositionOffset,
          byte(Decomposition::kStandard),
          byte(Decomposition::kNonstandard),
          "decomposition"},
         {6, kDecodeRule, kDecodeRule, "decode rule"}}};
    for (const Field& field : kFields) {
        const std::uint8_t found = bytes[field.offset];
        if (found >= field.lowest && found <= field.highest) continue;
        std::string expected = std::to_string(field.lowest);
        if (field.highest > field.lowest) {
            expected += " to " + std::to_string(field.highest);
        }
        return invalid(std::string("signature ") + field.name + " " +
                       std::to_string(found) + ", expected " + expected);
    }
    if (bytes[7] > kLowInformationFlag) {
        return invalid("signature flags " + std::to_string(bytes[7]) + " are unknown");
    }
    if (bytes[23] != 0) {
        return invalid("signature byte 23 is " + std::to_string(bytes[23]) +
                       ", expected 0");
    }
    return std::nullopt;
}

}  // namespace

std::vector<std::uint8_t> encode_signature(const Signature& signature) {
    std::vector<std::uint8_t> bytes = {
        kMagic0,
        kMagic1,
        kVersion,
        kAlgorithm,
        byte(signature.kind.color_space),
        byte(signature.kind.decomposition),
        kDecodeRule,
        signature.low_information ? kLowInformationFlag : std::uint8_t{0}};
    bytes.reserve(kMaxSignatureBytes);
    for (const ChannelSignature& channel : signature.channels) {
        put_le(static_cast<std::uint32_t>(channel.average), 4, bytes);
    }
    for (const ChannelSignature& channel : signature.channels) {
        bytes.push_back(channel.count);
    }
    bytes.push_back(0);
    for (const ChannelSignature& channel : signature.channels) {
        for (const std::int16_t index : channel.largest(kMaxCoefficients)) {
            put_le(static_cast<std::uint16_t>(index), 2, bytes);
        }
    }
    return bytes;
}

Result<Signature> decode_signature(std::span<const std::uint8_t> bytes) {
    if (auto error = check_header(bytes)) return *std::move(error);
    Signature signature;
    signature.kind = {static_cast<ColorSpace>(bytes[kColorSpaceOffset]),
                      static_cast<Decomposition>(bytes[kDecompositionOffset])};
    signature.low_information = bytes[7] == kLowInformationFlag;

    std::size_t expected = kSignatureHeaderBytes;
    for (int c = 0; c < kChannels; ++c) {
        const std::size_t count = bytes[kCountOffset + c];
        if (auto error = check_count({signature.kind.color_space, c}, count))
            return *std::move(error);
        expected += 2 * count;
    }
    if (bytes.size() != expected) {
        return invalid("a signature of " + std::to_string(bytes.size()) +
                       " bytes, its counts ask for " + std::to_string(expected));
    }

    const std::uint8_t* next = bytes.data() + kSignatureHeaderBytes;
    IndexCheck check;
    for (int c = 0; c < kChannels; ++c) {
        const ChannelOf place{signature.kind.color_space, c};
        ChannelSignature& channel = signature.channels[c];
        channel.average = get_le32(bytes.data() + kAverageOffset + 4 * std::size_t(c));
        const double average = channel.average / double{kAverageOne};
        if (auto error = check_average(place, average)) return *std::move(error);
        channel.count = bytes[kCountOffset + c];
        const auto indices = std::span(channel.indices).first(channel.count);
        get_indices(next, indices);
        if (!check.passes(indices)) return refusal_of(place, indices);
        next += 2 * indices.size();
    }
    return signature;
}

std::string signature_to_text(const Signature& signature) {
    return base64url_encode(encode_signature(signature));
}

Result<Signature> signature_from_text(std::string_view text) {
    constexpr std::size_t kMaxText = base64url_length(kMaxSignatureBytes);
    if (text.size() > kMaxText) {
        return invalid("a signature of " + std::to_string(text.size()) +
                       " characters, at most " + std::to_string(kMaxText));
    }
    const auto bytes = base64url_decode(text);
    if (!bytes) return invalid("a signature that " + bytes.error().message);
    return decode_signature(bytes.value());
}

OpenSignature to_open(const Signature& signature) {
    OpenSignature open;
    open.kind = signature.kind;
    for (int c = 0; c < kChannels; ++c) {
        const ChannelSignature& channel = signature.channels[c];
        open.average[c] = channel.average / double{kAverageOne};
        const auto indices = channel.largest(kMaxCoefficients);
        open.coefficients[c].assign(indices.begin(), indices.end());
    }
    return open;
}

Result<Signature> from_open(const OpenSignature& open) {
    Signature signature;
    signature.kind = open.kind;
    bool any = false;
    IndexReader reader;
    for (int c = 0; c < kChannels; ++c) {
        const ChannelOf place{open.kind.color_space, c};
        ChannelSignature& channel = signature.channels[c];
        if (auto error = check_average(place, open.average[c])) return *std::move(error);
        channel.average =
            static_cast<std::int32_t>(std::lround(open.average[c] * kAverageOne));
        const std::vector<int>& indices = open.coefficients[c];
        if (auto error = check_count(place, indices.size())) return *std::move(error);
        reader.begin(place, channel);
        for (const int index : indices) {
            if (!reader.add(index)) return reader.refusal(index);
        }
        any = any || !indices.empty();
    }
    signature.low_information = !any;
    return signature;
}

}  // namespace haarmony::image
