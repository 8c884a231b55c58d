// The table of the REST interface: which function answers which address.
#pragma once

#include <span>
#include <string_view>

#include "server/api/context.h"
#include "server/api/outcome.h"
#include "server/http/router.h"

namespace haarmony::server {

// Up to Context::max_body, or max_video_body.
enum class Body { kNone, kPicture, kVideo };

struct Route {
    std::string_view method;
    std::string_view pattern;
    http::Cost cost;
    Body body;
    bool open;  // needs no key
    Reply (*handler)(const Context&, const http::Request&);
    http::Cost (*cost_of)(const http::Request&) = nullptr;  // instead of `cost`
    http::Cost (*cost_in)(const Context&, const http::Request&) = nullptr;  // the same
};

[[nodiscard]] std::span<const Route> routes();

// Requires: `context` outlives the router.
void add_routes(const Context& context, http::Router& router);

}  // namespace haarmony::server
