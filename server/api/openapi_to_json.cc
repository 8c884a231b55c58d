// openapi_to_json FROM.yaml TO.json: the description of the REST interface as JSON, for the
// daemon to embed. A program of the build, not of the product.
//
// YAML leaves it to the reader what a plain scalar is; here the core schema of YAML 1.2
// decides (null, true, false, decimal numbers), quoted scalars are strings, and a repeated
// key is an error. Exit code 1 and the reason on stderr where the file is not such YAML.
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const YAML::Node& node, const std::string& why) {
    throw std::runtime_error("line " + std::to_string(node.Mark().line + 1) + ": " + why);
}

Json scalar_json(const YAML::Node& node) {
    const std::string& text = node.Scalar();
    const bool quoted = node.Tag() == "!";
    if (quoted) return text;
    if (text == "null" || text == "~") return nullptr;
    if (text == "true" || text == "false") return text == "true";
    // JSON's own grammar of numbers is the core schema's, but for octal and hexadecimal.
    const Json number = Json::parse(text, nullptr, false);
    return number.is_number() ? number : Json(text);
}

Json to_json(const YAML::Node& node) {
    switch (node.Type()) {
        case YAML::NodeType::Scalar:
            return scalar_json(node);
        case YAML::NodeType::Null:
            return nullptr;
        case YAML::NodeType::Sequence: {
            Json array = Json::array();
            for (const YAML::Node& element : node) array.push_back(to_json(element));
            return array;
        }
        case YAML::NodeType::Map: {
            Json object = Json::object();
            for (const auto& member : node) {
                const std::string& key = member.first.Scalar();
                if (object.contains(key))
                    refuse(member.first, "'" + key + "' appears twice");
                object[key] = to_json(member.second);
            }
            return object;
        }
        case YAML::NodeType::Undefined:
            break;
    }
    refuse(node, "not a value");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: openapi_to_json FROM.yaml TO.json\n";
        return 2;
    }
    try {
        const Json document = to_json(YAML::LoadFile(argv[1]));
        std::ofstream file(argv[2], std::ios::binary | std::ios::trunc);
        file << document.dump() << '\n';
        file.close();
        if (!file) throw std::runtime_error("cannot write " + std::string(argv[2]));
    } catch (const std::exception& error) {
        std::cerr << argv[1] << ": " << error.what() << '\n';
        return 1;
    }
    return 0;
}
