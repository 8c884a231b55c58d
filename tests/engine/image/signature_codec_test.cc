#include "engine/image/signature_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/image/color_space.h"
#include "tests/engine/image/all_kinds.h"
#include "tests/engine/image/pictures.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

Signature example() { return make_signature(scene(90, 60, 61).view()); }

// A small one, so that every byte can be put to every test.
Signature small_example() {
    Signature signature;
    signature.channels[0].average = kAverageOne / 2;
    signature.channels[1].average = -kAverageOne / 3;
    signature.channels[0].count = 2;
    signature.channels[0].indices = {1, -16383};
    signature.channels[2].count = 1;
    signature.channels[2].indices = {-300};
    return signature;
}

void expect_refused(const Result<Signature>& result, std::string_view reason) {
    ASSERT_FALSE(result) << "expected: " << reason;
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(result.error().param, "signature");
    EXPECT_NE(result.error().message.find(reason), std::string::npos)
        << result.error().message;
}

TEST(SignatureCodec, BytesAreThoseOfTheDocument) {
    const std::vector<std::uint8_t> expected = {
        'H',  'S',  1,    1,    1, 1, kDecodeRule, 0,  // header
        0x00, 0x00, 0x80, 0x00,                        // 2^23
        0xAB, 0xAA, 0xAA, 0xFF,                        // -5592405
        0x00, 0x00, 0x00, 0x00,                        // 0
        2,    0,    1,    0,                           // counts, reserved
        0x01, 0x00, 0x01, 0xC0,                        // 1, -16383
        0xD4, 0xFE};                                   // -300
    EXPECT_EQ(encode_signature(small_example()), expected);
}

// scene(90, 60, 61) as version 1 wrote it when YIQ, standard, was the only kind.
constexpr std::string_view kFirstWritten =
    "SFMBAQEBAQDxBmwA7FAJAOXw__9kZGQAgP8A____-f-DAID-gPz9_3__fv-HAAD6__mDAYD9ggPy"
    "_44BjgAA_YUBdP4A_n_8jwL9_nv__P-CAfH_dPz7-YcCgwIPAXr-gOd_5_j_dv_-_IoDhQMHAXr8"
    "BQCWAQD0iwGDBo4G9vx4_v_zgQYIBv_8dP8OA4D6_f2IAAoAefnq-Xvnev_0_ID4gPvR_wD8AwPz"
    "_oUG8P9f_nb5-_5x9HD-__0CPADEBAbl_vr8DAHf_4EC6f_--ZYGHf57_X75FgBX__r_AOKAAP3_"
    "f_-AAYMA_v8AAYIB__zy_44AdP75_4cAhQGBA3T8jgF6_v_5AwH8_3r8jgb4_3_5__8OA4cBggB9"
    "_IsD9v92_H78AAKAA3P_eP6HBgIDlgGKAQcDf_6IAIUD8_xp_xsBAwb0_oIGDQFl__335fwd_AAE"
    "lwOAAvP5igCyAJYDAAjw_wAcjQH7-QMDARyBAl_-Hf4CHOX5iwFX_HD-f-ff_07-E_-A5__3AA6D"
    "AYMb-_4yAwD6hQabAfr-gwwCDQEOoQD9-___gAD-_33_AAGCAIABgAJ__4AD-_9-_IEDAgN9_fb_"
    "_f-CAXb8cf2KAH_5hQD6_4sD8f6CBvT_AQb9_goDAAZ__XT-f_4PAGX_yf8HAAINSf-PAJcDV_yK"
    "Bs7_af_X__z_qQBz_wwBjQEBAZYDAAL__BcAev-HAYAF__IDAgUGhQGbAXr-Tv6CGuz_6fzn_4oB"
    "BwspAwoNbPz5_ur_BwOFAwDz_sOvA4AYjwF5_XL-jwuBGA8DlABR_wECMgGWAH_lAwRtAPX8";

TEST(SignatureCodec, ReadsWhatWasWrittenBeforeThereWereKinds) {
    const auto decoded = signature_from_text(kFirstWritten);
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(decoded->kind, SignatureKind{});
    EXPECT_EQ(signature_to_text(*decoded), kFirstWritten);
    EXPECT_EQ(*decoded, example());
}

TEST(SignatureCodec, KindIsInBytes4And5) {
    for (const SignatureKind& kind : all_kinds()) {
        Signature signature;
        signature.kind = kind;
        const auto bytes = encode_signature(signature);
        EXPECT_EQ(bytes[4], static_cast<int>(kind.color_space));
        EXPECT_EQ(bytes[5], static_cast<int>(kind.decomposition));
        EXPECT_EQ(decode_signature(bytes)->kind, kind) << kind_name(kind);
    }
}

TEST(SignatureCodec, RoundTripsBytesTextAndOpenForm) {
    std::mt19937 random(62);
    std::vector<Signature> signatures = {Signature{}, small_example(), example()};
    // The corners of the cube: where the channels' ranges end.
    for (int corner = 0; corner < 8; ++corner) {
        std::vector<std::uint8_t> color;
        for (int c = 0; c < 3; ++c) {
            color.push_back(static_cast<std::uint8_t>((corner >> c) % 2 * 255));
        }
        const auto kinds = all_kinds();
        const auto made = make_signatures(flat(5, 5, color).view(), kinds);
        signatures.insert(signatures.end(), made.begin(), made.end());
    }
    for (const SignatureKind& kind : all_kinds()) {
        signatures.push_back(make_signature(scene(90, 60, 63).view(), kind));
    }
    for (int i = 0; i < 50; ++i) signatures.push_back(random_signature(random, {}));
    for (const Signature& signature : signatures) {
        const auto bytes = encode_signature(signature);
        EXPECT_LE(bytes.size(), kMaxSignatureBytes);
        const auto from_bytes = decode_signature(bytes);
        ASSERT_TRUE(from_bytes) << from_bytes.error().message;
        EXPECT_EQ(*from_bytes, signature);
        const auto from_text = signature_from_text(signature_to_text(signature));
        ASSERT_TRUE(from_text) << from_text.error().message;
        EXPECT_EQ(*from_text, signature);
        const auto opened = from_open(to_open(signature));
        ASSERT_TRUE(opened) << opened.error().message;
        EXPECT_EQ(opened->kind, signature.kind);
        EXPECT_EQ(opened->channels, signature.channels);
    }
}

TEST(SignatureCodec, TellsLowInformationWhereTheFormCan) {
    Signature signature = small_example();
    signature.low_information = true;
    EXPECT_TRUE(decode_signature(encode_signature(signature))->low_information);
    EXPECT_FALSE(from_open(to_open(signature))->low_information);
    EXPECT_TRUE(from_open(to_open(Signature{}))->low_information);
}

TEST(SignatureCodec, RefusesEveryOtherLength) {
    const std::vector<std::uint8_t> bytes = encode_signature(example());
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        expect_refused(decode_signature(std::span(bytes).first(length)),
                       std::to_string(length) + " bytes");
    }
    for (std::size_t extra = 1; extra < 5; ++extra) {
        std::vector<std::uint8_t> longer = bytes;
        longer.resize(bytes.size() + extra);
        expect_refused(decode_signature(longer),
                       std::to_string(longer.size()) + " bytes");
    }
}

// Whatever one byte is changed to: refused, or a signature with exactly these bytes.
TEST(SignatureCodec, TakesAChangedByteAtItsWordOrRefusesIt) {
    const std::vector<std::uint8_t> original = encode_signature(small_example());
    for (std::size_t at = 0; at < original.size(); ++at) {
        int accepted = 0;
        for (int value = 0; value < 256; ++value) {
            std::vector<std::uint8_t> bytes = original;
            bytes[at] = static_cast<std::uint8_t>(value);
            const auto decoded = decode_signature(bytes);
            if (!decoded) continue;
            ++accepted;
            ASSERT_EQ(encode_signature(*decoded), bytes)
                << "byte " << at << " = " << value;
        }
        // The header has no choice but of the kind (in RGB no average is negative), and a
        // count must agree with the length.
        const bool fixed = at < 7 || (at >= 20 && at < 24);
        const int choices = at == 4 ? 4 : at == 5 ? 2 : 1;
        EXPECT_GE(accepted, 1) << "byte " << at;
        if (fixed) {
            EXPECT_EQ(accepted, choices) << "byte " << at;
        }
    }
}

TEST(SignatureCodec, NamesTheHeaderFieldThatIsWrong) {
    const std::pair<int, std::string_view> fields[] = {
        {0, "not a signature: it starts with bytes 200, 83"},
        {1, "not a signature: it starts with bytes 72, 200"},
        {3, "algorithm 200, expected 1"},
        {4, "color space 200, expected 1 to 5"},
        {5, "decomposition 200, expected 1 to 2"},
        {6, "decode rule 200, expected 1"},
        {7, "flags 200"},
        {20, "200 coefficients in channel Y, at most 100"},
        {21, "200 coefficients in channel I, at most 100"},
        {22, "200 coefficients in channel Q, at most 100"},
        {23, "byte 23 is 200"},
    };
    for (const auto& [at, reason] : fields) {
        std::vector<std::uint8_t> bytes = encode_signature(small_example());
        bytes[at] = 200;
        expect_refused(decode_signature(bytes), reason);
    }
}

TEST(SignatureCodec, RefusesKindsBesideThoseThereAre) {
    const std::pair<int, int> cases[] = {{4, 0}, {4, 6}, {5, 0}, {5, 3}};
    for (const auto& [at, value] : cases) {
        std::vector<std::uint8_t> bytes = encode_signature(small_example());
        bytes[at] = static_cast<std::uint8_t>(value);
        expect_refused(decode_signature(bytes),
                       std::to_string(value) + ", expected 1 to");
    }
}

TEST(SignatureCodec, TellsANewerVersionFromAnImpossibleOne) {
    std::vector<std::uint8_t> bytes = encode_signature(small_example());
    bytes[2] = 0;
    expect_refused(decode_signature(bytes), "version 0, expected 1");
    bytes[2] = 2;
    const auto newer = decode_signature(bytes);
    ASSERT_FALSE(newer);
    EXPECT_EQ(newer.error().code, ErrorCode::kNewerVersion);
    EXPECT_NE(newer.error().message.find("version 2"), std::string::npos);
}

TEST(SignatureCodec, RefusesIndicesThatNoPictureHas) {
    const std::pair<int, std::string_view> cases[] = {
        {0, "index 0 in channel Y"},
        {16384, "index 16384 in channel Y"},
        {-16384, "index -16384 in channel Y"},
        {-32768, "index -32768 in channel Y"},
        {-1, "index 1 in channel Y is there twice"},
        {1, "index 1 in channel Y is there twice"},
    };
    for (const auto& [index, reason] : cases) {
        Signature signature = small_example();
        signature.channels[0].indices[1] = static_cast<std::int16_t>(index);
        expect_refused(decode_signature(encode_signature(signature)), reason);
        OpenSignature open = to_open(small_example());
        open.coefficients[0][1] = index;
        expect_refused(from_open(open), reason);
    }
}

// Bytes are checked in another way than open forms: both find the same fault.
TEST(SignatureCodec, RefusesTheSameIndicesInBytesAsInTheOpenForm) {
    std::mt19937 random(67);
    for (int i = 0; i < 3000; ++i) {
        const Signature sound = random_signature(random, {});
        OpenSignature open = to_open(sound);
        const std::size_t channel = random() % kChannels;
        std::vector<int>& indices = open.coefficients[channel];
        if (indices.size() < 2) continue;
        const std::size_t at = random() % indices.size();
        const int other = indices[random() % indices.size()];
        const int wrong[] = {other, -other, 0, -32768, 32767, -16384, 16384};
        indices[at] = wrong[random() % std::size(wrong)];
        Signature changed = sound;
        changed.channels[channel].indices[at] = static_cast<std::int16_t>(indices[at]);
        const auto from_bytes = decode_signature(encode_signature(changed));
        const auto from_numbers = from_open(open);
        ASSERT_EQ(from_bytes.has_value(), from_numbers.has_value()) << i;
        if (from_numbers) {
            // Another sign, or the same number again.
            EXPECT_EQ(from_bytes->channels, from_numbers->channels);
        } else {
            EXPECT_EQ(from_bytes.error().message, from_numbers.error().message) << i;
        }
    }
}

TEST(SignatureCodec, RefusesOpenIndicesBeyondTheirType) {
    for (const int index :
         {std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
        OpenSignature open;
        open.coefficients[2] = {index};
        expect_refused(from_open(open),
                       "index " + std::to_string(index) + " in channel Q");
    }
}

TEST(SignatureCodec, RefusesMoreOpenCoefficientsThanAreKept) {
    OpenSignature open;
    for (int i = 1; i <= kMaxCoefficients; ++i) open.coefficients[1].push_back(i);
    EXPECT_TRUE(from_open(open));
    open.coefficients[1].push_back(kMaxCoefficients + 1);
    expect_refused(from_open(open), "101 coefficients in channel I, at most 100");
}

TEST(SignatureCodec, RefusesAveragesOutsideTheChannelsRange) {
    for (const ColorSpace space : kAllColorSpaces) {
        for (int c = 0; c < kChannels; ++c) {
            const std::string name = "in channel " + std::string(channel_name(space, c));
            const ChannelRange range = channel_range(space, c);
            for (const auto& [bound, outwards] :
                 {std::pair(range.lowest, -1.0), std::pair(range.highest, 1.0)}) {
                OpenSignature open;
                open.kind.color_space = space;
                open.average[c] = bound;
                EXPECT_TRUE(from_open(open)) << bound << " " << name;
                Signature signature;
                signature.kind = open.kind;
                signature.channels[c].average = static_cast<std::int32_t>(
                    std::lround((bound + outwards * 1e-5) * kAverageOne));
                expect_refused(decode_signature(encode_signature(signature)), name);
                open.average[c] = bound + outwards * 1e-5;
                expect_refused(from_open(open), name);
                open.average[c] = outwards * std::numeric_limits<double>::infinity();
                expect_refused(from_open(open), name);
                open.average[c] = std::numeric_limits<double>::quiet_NaN();
                expect_refused(from_open(open), name);
            }
        }
    }
}

TEST(SignatureCodec, RefusesTextThatIsNoSignature) {
    expect_refused(signature_from_text(""), "0 bytes");
    expect_refused(signature_from_text("SFMB="), "5 characters");
    expect_refused(signature_from_text("SF?B"), "byte 63 at position 2");
    expect_refused(signature_from_text(std::string(833, 'A')),
                   "833 characters, at most 832");
    expect_refused(signature_from_text(signature_to_text(example()) + "AAAA"),
                   "characters");
}

TEST(SignatureCodec, TextSurvivesNoChangedCharacterUnnoticed) {
    const std::string text = signature_to_text(small_example());
    for (std::size_t at = 0; at < text.size(); ++at) {
        for (int value = 0; value < 256; ++value) {
            std::string changed = text;
            changed[at] = static_cast<char>(value);
            const auto decoded = signature_from_text(changed);
            if (decoded) {
                ASSERT_EQ(signature_to_text(*decoded), changed);
            }
        }
    }
}

}  // namespace
}  // namespace haarmony::image
