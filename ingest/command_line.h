// The options of haarmony-ingest (`--help` documents them).
//
// Errors  kInvalidArgument with what to print; the caller exits with 2.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "ingest/pipeline.h"
#include "ingest/progress.h"

namespace haarmony::ingest {

struct CommandLine {
    std::string database;
    PipelineOptions pipeline;
    std::size_t most_key_frames = kMostKeyFrames;  // of a film
    std::optional<ProgressMode> progress;          // nothing: by what stdout is
    std::string answer;  // not empty (--help, --version): print it, and that is all
};

// `arguments` without the program's name.
[[nodiscard]] Result<CommandLine> parse_command_line(std::vector<std::string> arguments);

}  // namespace haarmony::ingest
