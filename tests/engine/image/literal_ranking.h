// A collection ranked picture by picture and coefficient by coefficient: the oracle of
// random questions. It shares nothing with the search but the signature and the weights, and
// the rules of bins are written out a second time.
//
// Scale   score and distance as Score in query.h, exact.
// Source  sec. 4.2.4, equations (4.3) and (4.4); sec. 4.3.2, bin(i, j).
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/image/id_set.h"
#include "engine/image/profile.h"
#include "engine/image/query.h"
#include "engine/image/record.h"

namespace haarmony::image {

// Live pictures by id.
using Pictures = std::map<std::int64_t, Record>;

struct Question {
    Signature signature;
    Profile profile;
    int m = 1;
    std::int32_t log_aspect = 0;
    std::int32_t aspect_weight = 0;  // in 1/100
    std::optional<std::set<std::int64_t>> only;
    int limit = 0;

    // All of it but the signature, for whoever has to ask again.
    [[nodiscard]] std::string text() const;
};

// The question as the search takes it.
[[nodiscard]] Query query_of(const Question& question);
[[nodiscard]] std::optional<IdSet> id_set_of(const Question& question);

// All pictures that are asked about, best first, whatever the limit.
[[nodiscard]] std::vector<Match> rank_literally(const Pictures& pictures,
                                                const Question& question);

// What (4.3) has and (4.4) leaves out: the weights of all coefficients of the question.
[[nodiscard]] Score left_out(const Question& question);

}  // namespace haarmony::image
