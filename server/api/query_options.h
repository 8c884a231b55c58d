// How to search: the options that every kind of query takes.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "server/api/context.h"
#include "server/api/inputs.h"
#include "server/app/image_service.h"
#include "server/app/query_picture.h"

namespace haarmony::server {

// Frames are pictures of videos; of each shot the best is told.
enum class QueryKind { kImage, kFrame, kAll };

struct QueryOptions {
    QueryKind kind = QueryKind::kImage;
    SearchOptions search;
    LookOptions look;  // in the kinds of all profiles
    bool explain = false;
    std::optional<nlohmann::json> seq;  // a number or a string, to be echoed
};

// Problems are left in `inputs`.
[[nodiscard]] QueryOptions read_query_options(const Context& context, Inputs& inputs);

// The text and the tags that narrow a search or a list.
[[nodiscard]] schema::ImageFilter read_filter(Inputs& inputs);

}  // namespace haarmony::server
