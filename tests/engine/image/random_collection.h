// Everything random about a small collection and what it is asked, all of it from one seed.
#pragma once

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "engine/image/index.h"
#include "tests/engine/image/literal_ranking.h"

namespace haarmony::image {

// What one call of Index::apply() is given.
struct Change {
    std::vector<Record> upserts;  // an id may be there twice
    std::vector<ImageId> removals;
};

class RandomCollection {
  public:
    explicit RandomCollection(unsigned seed);

    [[nodiscard]] const IndexOptions& options() const { return options_; }
    // What was chosen for the whole collection.
    [[nodiscard]] std::string text() const;

    // How many changes it goes through.
    [[nodiscard]] int changes() const { return changes_; }
    // Whether its changes leave one small segment after the other, so that a search has more
    // blocks than it visits first.
    [[nodiscard]] bool scattered() const { return scattered_; }
    // The next change, which live() has then seen.
    Change change();
    [[nodiscard]] const Pictures& live() const { return live_; }

    Question question();

    // In [0, bound). Requires: bound >= 1.
    int below(int bound) { return static_cast<int>(random_() % unsigned(bound)); }
    bool one_in(int chances) { return below(chances) == 0; }

  private:
    // How the coefficients of pictures are spread over the places.
    enum class Spread { kPopular, kFewPlaces, kAnywhere };

    ImageId any_id();
    int any_index();
    std::int32_t any_average();
    Signature any_signature();
    Signature any_picture();
    Signature asked_signature();
    Profile any_profile();
    std::set<std::int64_t> any_filter();
    int any_limit();

    std::mt19937 random_;
    int pictures_ = 0;  // about as many as there will be
    int changes_ = 0;
    bool scattered_ = false;
    IndexOptions options_;
    Spread spread_ = Spread::kPopular;
    int most_coefficients_ = 0;
    int places_ = 0;  // of kFewPlaces
    int average_steps_ = 0;
    std::int64_t average_step_ = 0;
    std::int64_t first_id_ = 1;
    std::int64_t id_stride_ = 1;
    std::vector<Signature> kinds_;  // empty: no two pictures need be alike
    // Which channel made last took the place; cheaper than forgetting all places each time.
    std::vector<int> taken_by_ = std::vector<int>(kCoefficientCount);
    int channels_made_ = 0;
    Pictures live_;
};

}  // namespace haarmony::image
