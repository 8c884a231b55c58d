// Drops the rows whose file is gone.
//
// Only a file that certainly is not there is gone: its path leads nowhere, or to something
// that is no regular file. What cannot be looked at (permission, input/output errors) stays,
// and so does what exists but is excluded or is no candidate any more.
//
// Errors  those of the catalogue; batches committed before stay.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "engine/core/result.h"
#include "ingest/catalogue.h"

namespace haarmony::ingest {

struct Pruned {
    std::int64_t rows = 0;
    Result<void> outcome;
};

// `root` is an absolute, normal path that exists: nothing else may be pruned below, since a
// folder that is not mounted would look like one whose files are all gone.
[[nodiscard]] Pruned prune_below(Catalogue& catalogue,
                                 const std::string& root,
                                 const std::function<bool()>& keep_going);

}  // namespace haarmony::ingest
