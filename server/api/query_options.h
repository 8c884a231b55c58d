// How to search: the options that every kind of query takes.
//
// What is described but not built yet is refused with the code "not_built", so that no
// client takes an option for obeyed.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "server/api/context.h"
#include "server/api/inputs.h"
#include "server/app/image_service.h"
#include "server/app/query_picture.h"

namespace haarmony::server {

struct QueryOptions {
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
