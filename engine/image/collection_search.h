// One search over all that a collection holds: sealed segments and tail.
//   segment_search.h, tail.h -> [collection_search.h] -> index.h
//
// The most promising blocks of all segments are visited first, so that the worst match kept
// is good before the others are judged by it. With an executor the segments are searched at
// the same time; the answer is the same.
//
// Errors  none.
// Threads const-thread-safe.
// Source  sec. 4.3.1, 4.3.2.
#pragma once

#include <vector>

#include "engine/image/collection.h"
#include "engine/image/index.h"

namespace haarmony::image {

[[nodiscard]] SearchResult search(const Collection& collection,
                                  const Query& query,
                                  const SearchScope& scope);

// Every picture that is not removed, and in `only` if there is one, with its score.
[[nodiscard]] std::vector<Match> score_all(const Collection& collection,
                                           const Query& query,
                                           const IdSet* only);

}  // namespace haarmony::image
