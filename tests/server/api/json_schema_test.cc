#include "tests/server/api/json_schema.h"

#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>

namespace haarmony::server {
namespace {

using nlohmann::json;

// The validator has to see what is wrong, or the tests of openapi.yaml could not fail.
TEST(JsonSchema, SeesEveryKindOfViolation) {
    const json schema = json::parse(R"({"type": "object", "required": ["n"],
        "additionalProperties": false, "properties": {
            "n": {"type": "integer", "minimum": 1, "maximum": 3},
            "s": {"type": ["string", "null"], "minLength": 2, "maxLength": 3, "pattern": "^a"},
            "l": {"type": "array", "minItems": 1, "maxItems": 2, "items": {"enum": [1, "x"]}},
            "o": {"oneOf": [{"type": "number"}, {"type": "integer"}, {"type": "string"}]},
            "r": {"$ref": "#/word"}}})");
    const json references{{"word", {{"type", "boolean"}}}};
    const auto good =
        json::parse(R"({"n": 1, "s": null, "l": [1, "x"], "o": 1.5, "r": true})");
    EXPECT_EQ(violation(good, schema, references), std::nullopt);
    for (const char* bad : {"[]",
                            "{}",
                            R"({"n": 0})",
                            R"({"n": 4})",
                            R"({"n": 1.5})",
                            R"({"n": 1, "m": 1})",
                            R"({"n": 1, "s": 7})",
                            R"({"n": 1, "s": "a"})",
                            R"({"n": 1, "s": "aaaa"})",
                            R"({"n": 1, "s": "baa"})",
                            R"({"n": 1, "l": []})",
                            R"({"n": 1, "l": [1, 1, 1]})",
                            R"({"n": 1, "l": [2]})",
                            R"({"n": 1, "o": 1})",
                            R"({"n": 1, "o": null})",
                            R"({"n": 1, "r": 1})"})
        EXPECT_NE(violation(json::parse(bad), schema, references), std::nullopt) << bad;
    EXPECT_THROW((void)violation(1, {{"multipleOf", 2}}, references), std::runtime_error);
}

}  // namespace
}  // namespace haarmony::server
