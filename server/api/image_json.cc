#include "server/api/image_json.h"

#include <nlohmann/json.hpp>

#include "server/api/json_text.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

std::string_view name_of(schema::ImageState state) {
    switch (state) {
        case schema::ImageState::kIndexed:
            return "indexed";
        case schema::ImageState::kFailed:
            return "failed";
        case schema::ImageState::kDeleted:
            return "deleted";
    }
    return "";
}

// What was stored as an object; rows written by others are shown empty where it is none.
json metadata_of(const schema::Image& image) {
    json metadata = json::parse(image.metadata, nullptr, false);
    return metadata.is_object() ? metadata : json::object();
}

json text_or_null(const std::string& text) { return text.empty() ? json() : json(text); }

}  // namespace

json image_json(const schema::Image& image) {
    json members{{"id", to_int(image.id)},
                 {"uri", text_or_null(image.uri)},
                 {"width", image.width},
                 {"height", image.height},
                 {"thumbnail", image_address(image.id, "thumbnail")},
                 {"tags", image.tags},
                 {"metadata", metadata_of(image)}};
    members["state"] = name_of(image.state);
    members["origin"] = image.origin == schema::ImageOrigin::kFile ? "file" : "upload";
    members["media_type"] = text_or_null(image.media_type);
    members["bytes"] = image.stamp.size;
    members["content_hash"] = text_or_null(image.stamp.content_hash);
    members["low_information"] = image.low_information;
    members["added_at"] = image.added_at;
    members["updated_at"] = image.updated_at;
    if (image.state == schema::ImageState::kFailed) {
        members["failure"] = image.failure;
        members["thumbnail"] = nullptr;
    }
    return members;
}

void append_match(const FoundImage& found,
                  const PlannedWay& way,
                  const image::Profile& profile,
                  int rank,
                  std::string_view explanation,
                  std::string& reply) {
    const schema::Image& image = found.image;
    JsonObject match(reply);
    match.integer("id", to_int(image.id))
        .integer("rank", rank)
        .number("distance", found.match.distance)
        .number("similarity", found.match.similarity)
        .text("orientation", image::symmetry_name(way.symmetry));
    if (found.match.combined_rank)
        match.number("combined_rank", *found.match.combined_rank);
    if (profile.calibration)
        match.number("probability",
                     image::probability(*profile.calibration, found.match.distance));
    match.text_or_null("uri", image.uri)
        .integer("width", image.width)
        .integer("height", image.height)
        .text("thumbnail", image_address(image.id, "thumbnail"))
        .texts("tags", image.tags)
        // Most have none, and need not be read for it.
        .json(
            "metadata",
            image.metadata == "{}" ? image.metadata : http::to_text(metadata_of(image)));
    if (!explanation.empty()) match.json("explain", explanation);
    match.end();
}

std::string image_address(ImageId id) { return "/images/" + std::to_string(to_int(id)); }

std::string image_address(ImageId id, std::string_view part) {
    return image_address(id) + "/" + std::string(part);
}

}  // namespace haarmony::server
