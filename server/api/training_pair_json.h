// Training pairs as the interface has them, in POST /feedback, in a training and in files of
// JSON lines: {"signature" and/or "strokes", "target": id, "kind": "painted", "seconds": 7.5}.
//
// Shape   in the database the signature is bytes and the strokes are JSON text.
// Errors  400 naming the member, left in the Inputs; see read_feedback().
// Threads const-safe.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "schema/feedback_store.h"
#include "server/api/inputs.h"
#include "server/api/outcome.h"
#include "server/app/profile_training.h"

namespace haarmony::server {

struct NewPair {
    QueryPair pair;
    schema::NewFeedback feedback;  // the same as it is stored
};

// 400 "no_source" without a query; every unknown member is refused.
[[nodiscard]] Outcome<NewPair> read_pair(Inputs inputs);

// One line of a file.
[[nodiscard]] Outcome<NewPair> parse_pair(const std::string& line);

// A logged pair; nothing where what is stored cannot be read any more.
[[nodiscard]] std::optional<QueryPair> stored_pair(const schema::Feedback& feedback);

// Exactly the members that parse_pair() takes.
[[nodiscard]] nlohmann::json pair_json(const schema::Feedback& feedback);

}  // namespace haarmony::server
