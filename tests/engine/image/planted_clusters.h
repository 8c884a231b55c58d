// Pictures around a few centers, for tests of what finds such groups again.
#pragma once

#include <random>
#include <vector>

#include "engine/core/executor.h"
#include "engine/image/signature.h"

namespace haarmony::image {

// `each` variations of each of `groups` random pictures, group after group: a variation
// has every tenth coefficient replaced. No two pictures are alike.
[[nodiscard]] std::vector<Signature> planted_clusters(std::mt19937& random,
                                                      int groups,
                                                      int each);

// Does the last first, so that work which is not independent shows.
class BackwardExecutor final : public Executor {
  public:
    void parallel_for(std::size_t count,
                      const std::function<void(std::size_t)>& work) override {
        for (std::size_t i = count; i-- > 0;) work(i);
    }
};

}  // namespace haarmony::image
