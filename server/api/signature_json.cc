#include "server/api/signature_json.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "engine/image/signature_codec.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

Error refused(const std::string& message) {
    return {ErrorCode::kInvalidArgument, "signature: " + message, "signature"};
}

Result<image::Signature> from_text(const std::string& text) {
    Result<image::Signature> signature = image::signature_from_text(text);
    if (!signature) return refused(signature.error().message);
    return signature;
}

bool is_triple(const json& value) {
    return value.is_array() && value.size() == image::kChannels;
}

// By size and sign apart: an unsigned number above 2^63 must not wrap around to a small one.
bool is_signed_index(const json& value) {
    if (value.is_number_unsigned())
        return value.get<std::uint64_t>() < image::kCoefficientCount;
    return value.is_number_integer() &&
           value.get<std::int64_t>() > -image::kCoefficientCount;
}

Result<image::OpenSignature> read_open(const json& average, const json& coefficients) {
    image::OpenSignature open;
    if (!is_triple(average)) return refused("average is not an array of 3 numbers");
    if (!is_triple(coefficients))
        return refused("coefficients is not an array of 3 arrays");
    for (std::size_t channel = 0; channel < image::kChannels; ++channel) {
        if (!average[channel].is_number())
            return refused("average is not an array of 3 numbers");
        open.average[channel] = average[channel].get<double>();
        if (!coefficients[channel].is_array())
            return refused("coefficients is not an array of 3 arrays");
        for (const json& index : coefficients[channel]) {
            if (!is_signed_index(index))
                return refused("coefficient " + index.dump().substr(0, 40) +
                               " is not a signed index");
            open.coefficients[channel].push_back(index.get<int>());
        }
    }
    return open;
}

}  // namespace

json signature_json(const image::Signature& signature) {
    const image::OpenSignature open = image::to_open(signature);
    return {{"kind", image::kind_name(open.kind)},
            {"average", open.average},
            {"coefficients", open.coefficients},
            {"signature", image::signature_to_text(signature)},
            {"low_information", signature.low_information}};
}

Result<image::Signature> parse_signature(const json& value) {
    if (value.is_string()) return from_text(value.get_ref<const std::string&>());
    if (!value.is_object()) return refused("neither a string nor an object");
    json average;
    json coefficients;
    json opaque;
    json low_information = false;
    image::SignatureKind kind;
    for (const auto& [name, member] : value.items()) {
        if (name == "average") {
            average = member;
        } else if (name == "coefficients") {
            coefficients = member;
        } else if (name == "kind") {
            const auto known = image::kind_from_name(
                member.is_string() ? member.get<std::string>() : "");
            if (!known)
                return refused("kind " + member.dump().substr(0, 40) + " is not known");
            kind = *known;
        } else if (name == "signature" && member.is_string()) {
            opaque = member;
        } else if (name == "low_information" && member.is_boolean()) {
            low_information = member;
        } else {
            return refused("member '" + name.substr(0, 40) +
                           "' is not known or has the wrong type");
        }
    }
    Result<image::OpenSignature> open = read_open(average, coefficients);
    if (!open) return open.error();
    open->kind = kind;
    Result<image::Signature> signature = image::from_open(open.value());
    if (!signature) return refused(signature.error().message);
    if (low_information.get<bool>()) signature->low_information = true;
    if (opaque.is_null()) return signature;

    Result<image::Signature> same = from_text(opaque.get_ref<const std::string&>());
    if (same && (same->kind != kind || same->channels != signature->channels))
        return refused("the member 'signature' is that of another picture");
    return same;
}

}  // namespace haarmony::server
