#include "server/api/details_json.h"

#include <string>
#include <utility>

namespace haarmony::server {
namespace {

using nlohmann::json;

http::Problem wrong_count(const std::string& place,
                          std::size_t found,
                          std::size_t wanted) {
    return impossible("row_count",
                      place + " has " + std::to_string(found) +
                          (found == 1 ? " row, not " : " rows, not ") +
                          std::to_string(wanted),
                      place);
}

}  // namespace

Outcome<curve::LocalDetails> read_details(Inputs& inputs,
                                          curve::Frame frame,
                                          curve::Ends ends) {
    const json* coarse = inputs.peek("coarse");
    const json* details = inputs.peek("details");
    if (coarse == nullptr) return malformed("coarse is missing", "coarse");
    if (details == nullptr) return malformed("details is missing", "details");
    curve::LocalDetails read;
    read.ends = ends;
    read.frame = frame;
    auto rows = read_points(*coarse, "coarse", kMostPoints);
    if (!rows) return rows.problem();
    if (const std::size_t wanted = curve::control_count(0, ends); rows->size() != wanted)
        return wrong_count("coarse", rows->size(), wanted);
    read.coarse = *std::move(rows);
    if (!details->is_array())
        return malformed("details '" + shown_json(*details) + "' is not an array",
                         "details");
    if (details->size() > std::size_t{curve::kMostLevel})
        return impossible("level_out_of_range",
                          "details has " + std::to_string(details->size()) +
                              " levels, more than " + std::to_string(curve::kMostLevel),
                          "details");
    for (std::size_t level = 0; level < details->size(); ++level) {
        const std::string place = "details[" + std::to_string(level) + "]";
        auto detail = read_points((*details)[level], place, kMostPoints);
        if (!detail) return detail.problem();
        const std::size_t wanted = curve::segment_count(static_cast<int>(level));
        if (detail->size() != wanted) return wrong_count(place, detail->size(), wanted);
        if (detail->dimension() != read.coarse.dimension())
            return impossible(
                "mixed_dimensions",
                place + " has points of " + std::to_string(detail->dimension()) +
                    " numbers, coarse of " + std::to_string(read.coarse.dimension()),
                place);
        read.details.push_back(*std::move(detail));
    }
    return read;
}

void add_details(JsonObject& object, const curve::LocalDetails& details) {
    std::string levels = "[";
    for (const curve::Points& detail : details.details) {
        if (levels.size() > 1) levels += ',';
        append_points(levels, detail);
    }
    levels += ']';
    object.integer("level", details.level())
        .json("coarse", points_text(details.coarse))
        .json("details", levels);
}

}  // namespace haarmony::server
