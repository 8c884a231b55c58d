// How to search: the options that every kind of query takes.
//
// What is described but not built yet is refused with the code "not_built", so that no
// client takes an option for obeyed.
#pragma once

#include <nlohmann/json.hpp>

#include "server/api/inputs.h"
#include "server/app/image_service.h"
#include "server/app/picture_reader.h"

namespace haarmony::server {

struct QueryOptions {
    SearchOptions search;
    Mask mask = Mask::kAlpha;
    std::optional<nlohmann::json> seq;  // a number or a string, to be echoed
};

// Problems are left in `inputs`.
[[nodiscard]] QueryOptions read_query_options(Inputs& inputs);

// Refuses `name` wherever it is given.
void refuse_not_built(Inputs& inputs, std::string_view name);

}  // namespace haarmony::server
