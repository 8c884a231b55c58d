// A set of handwritten strokes, searched by their signatures.
//   stroke_signature.h -> [stroke_index.h]
//
// Score    of a term of the query that the stored stroke has, with the same sign: the weight
//          of its level; of one of level 3 or finer that it has a row beside it: half of that,
//          because the same shape may be found a little further along the curve. No term counts twice, so a
//          stroke scores highest with itself. Scores are integers: ties are exact, and go to
//          the smaller name.
// Errors   none.
// Threads  const-thread-safe; changes are the caller's to guard.
// Cost     a query walks the lists of its terms, a fraction of the strokes for each.
// Source   sec. 6.3; Figure 4.2 (lists by term), sec. 4.2.3 (weights).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/curve/stroke_signature.h"

namespace haarmony::curve {

struct StrokeMatch {
    std::string name;
    std::int64_t score = 0;
    double similarity = 0;  // score / that of the query with itself, in [0, 1]
    friend bool operator==(const StrokeMatch&, const StrokeMatch&) = default;
};

// Of one stroke with another, by the definition above.
[[nodiscard]] std::int64_t stroke_score(const StrokeSignature& query,
                                        const StrokeSignature& stored);

class StrokeIndex {
  public:
    // In place of one of the same name, if there is one.
    void add(const std::string& name, const StrokeSignature& signature);
    // Whether there was one.
    bool remove(const std::string& name);
    [[nodiscard]] std::size_t size() const { return slots_.size(); }

    // Best first, those that score at all, `limit` at most.
    [[nodiscard]] std::vector<StrokeMatch> query(const StrokeSignature& signature,
                                                 std::size_t limit) const;

  private:
    using Slot = std::uint32_t;

    std::map<std::string, Slot, std::less<>> slots_;
    std::vector<std::string> names_;           // of each slot
    std::vector<StrokeSignature> signatures_;  // of each slot
    std::vector<Slot> free_;
    std::array<std::vector<Slot>, 2 * kSignatureKeys> lists_;  // by term
};

}  // namespace haarmony::curve
