#include "server/api/signature_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/image/signature_codec.h"
#include "tests/engine/image/pictures.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

image::Signature signature(unsigned seed) {
    return image::make_signature(image::scene(64, 64, seed).view());
}

TEST(SignatureJson, EveryFormComesBackAsTheSameSignature) {
    const image::Signature original = signature(1);
    const json both = signature_json(original);
    json open = both;
    open.erase("signature");
    json bare = open;
    bare.erase("low_information");
    for (const json& form : {both, open, bare, both["signature"]}) {
        // Through text, as a client sends it.
        const auto parsed = parse_signature(json::parse(form.dump()));
        ASSERT_TRUE(parsed) << parsed.error().message;
        EXPECT_EQ(parsed.value(), original);
    }
}

TEST(SignatureJson, KeepsLowInformation) {
    const image::Signature flat =
        image::make_signature(image::flat(32, 32, {90, 90, 90}).view());
    ASSERT_TRUE(flat.low_information);
    json open = signature_json(flat);
    open.erase("signature");
    EXPECT_TRUE(parse_signature(open).value().low_information);
}

TEST(SignatureJson, FormsThatDisagreeAreRefused) {
    json mixed = signature_json(signature(1));
    mixed["signature"] = image::signature_to_text(signature(2));
    const auto refused = parse_signature(mixed);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("another picture"), std::string::npos);
}

TEST(SignatureJson, RefusesWhatNoSignatureIs) {
    const json good = signature_json(signature(1));
    const auto with = [&](const char* member, const json& value) {
        json changed = good;
        changed.erase("signature");
        changed[member] = value;
        return changed;
    };
    const json empty = json::array();
    const std::vector<json> bad{
        nullptr,
        7,
        "",
        "no signature",
        json::array(),
        json::object(),
        with("color", 1),
        with("average", "white"),
        with("average", {0.5, 0.0}),
        with("average", {0.5, 0.0, "0"}),
        with("average", {7.0, 0.0, 0.0}),
        with("coefficients", nullptr),
        with("coefficients", {empty, empty}),
        with("coefficients", {empty, empty, 5}),
        with("coefficients", {{0}, empty, empty}),
        with("coefficients", {{1.5}, empty, empty}),
        with("coefficients", {{"1"}, empty, empty}),
        with("coefficients", {{16384}, empty, empty}),
        with("coefficients", {{-16384}, empty, empty}),
        with("coefficients", {{18446744073709551615ULL}, empty, empty}),
        with("coefficients", {{5, 5}, empty, empty}),
        with("coefficients", {{5, -5}, empty, empty}),
        with("coefficients", {std::vector<int>(101, 1), empty, empty}),
        with("low_information", 1),
        with("signature", 3),
        with("signature", "damaged"),
    };
    for (const json& value : bad) {
        const auto refused = parse_signature(value);
        ASSERT_FALSE(refused) << value.dump().substr(0, 200);
        EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(refused.error().param, "signature");
    }
}

}  // namespace
}  // namespace haarmony::server
