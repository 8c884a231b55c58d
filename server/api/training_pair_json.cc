#include "server/api/training_pair_json.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/image/signature_codec.h"
#include "server/api/profile_json.h"
#include "server/api/signature_json.h"
#include "server/api/strokes_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

// A day and more: nobody paints for longer.
constexpr double kMaxSeconds = 1e6;

void refuse_at(Inputs& inputs, std::string_view name, http::Problem problem) {
    if (problem.param.empty()) problem.param = name;
    inputs.refuse(std::move(problem));
}

void read_signature(Inputs& inputs, NewPair& read) {
    const std::optional<json> value = inputs.any("signature");
    if (!value) return;
    Result<image::Signature> signature = parse_signature(*value);
    if (!signature) {
        refuse_at(inputs, "signature", http::problem_of(signature.error()));
        return;
    }
    read.feedback.signature = image::encode_signature(signature.value());
    read.pair.signature = std::move(signature).value();
}

void read_strokes(Inputs& inputs, NewPair& read) {
    const std::optional<json> value = inputs.member("strokes");
    if (!value) return;
    Outcome<image::StrokePicture> strokes = parse_strokes(*value);
    if (!strokes) {
        refuse_at(inputs, "strokes", strokes.problem());
        return;
    }
    read.feedback.strokes = value->dump();
    read.pair.strokes = *std::move(strokes);
}

}  // namespace

Outcome<NewPair> read_pair(Inputs inputs) {
    NewPair read;
    read_signature(inputs, read);
    read_strokes(inputs, read);
    if (!inputs.has("signature") && !inputs.has("strokes"))
        inputs.refuse(http::Problem{400,
                                    "no_source",
                                    "nothing to learn from: send signature or strokes",
                                    "signature",
                                    {}});
    if (const auto target =
            inputs.integer("target", 1, std::numeric_limits<std::int64_t>::max()))
        read.pair.target = ImageId{*target};
    if (!inputs.has("target")) inputs.refuse("target", "is missing");
    read.feedback.target = read.pair.target;
    read.feedback.kind = inputs.text("kind").value_or("painted");
    if (!is_word(read.feedback.kind))
        inputs.refuse("kind", "is not 1 to 64 of a-z, 0-9, _ and -");
    read.feedback.seconds = inputs.number("seconds", 0, kMaxSeconds);
    if (const auto problem = inputs.refused()) return *problem;
    return read;
}

Outcome<NewPair> parse_pair(const std::string& line) {
    Result<json> parsed = http::parse_json(line);
    if (!parsed) return parsed.error();
    auto inputs = Inputs::of_object(std::move(parsed).value());
    if (!inputs) return inputs.problem();
    return read_pair(*std::move(inputs));
}

std::optional<QueryPair> stored_pair(const schema::Feedback& feedback) {
    QueryPair pair;
    pair.target = feedback.target;
    if (!feedback.signature.empty()) {
        Result<image::Signature> signature = image::decode_signature(feedback.signature);
        if (signature) pair.signature = std::move(signature).value();
    }
    if (!feedback.strokes.empty()) {
        const Result<json> value = http::parse_json(feedback.strokes);
        if (value)
            if (Outcome<image::StrokePicture> strokes = parse_strokes(value.value()))
                pair.strokes = *std::move(strokes);
    }
    if (!pair.signature && !pair.strokes) return {};
    return pair;
}

json pair_json(const schema::Feedback& feedback) {
    json members{{"kind", feedback.kind}, {"target", to_int(feedback.target)}};
    if (!feedback.signature.empty()) {
        const auto signature = image::decode_signature(feedback.signature);
        if (signature) members["signature"] = image::signature_to_text(signature.value());
    }
    if (!feedback.strokes.empty()) {
        Result<json> strokes = http::parse_json(feedback.strokes);
        if (strokes) members["strokes"] = std::move(strokes).value();
    }
    if (feedback.seconds) members["seconds"] = *feedback.seconds;
    return members;
}

}  // namespace haarmony::server
