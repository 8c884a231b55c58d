// The whole of ingest: one walker, several workers, one writer, bounded queues between.
//   walk -> [read, compare, describe] x jobs -> batches of rows
//
// What is committed when the process dies stays; the rest is found again by the next run,
// because a file is known only by its committed row. Nothing else is kept on disk.
//
// Scale   memory: the queues, one batch, one folder's names, and file_bytes for the bytes
//         of files (one file alone may be as large as max_file_bytes).
//         Films are read in pieces, in a child process.
// Errors  Report::outcome: the catalogue's. Files and folders that fail are reported to the
//         observer and counted; they never end the run.
// Threads run() starts its own threads and returns when they have ended; the calling thread
//         is the writer. `stop` may be set from anywhere, a signal handler too: no more
//         files are taken, what has been described is committed, nothing is pruned.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/image/signature_kind.h"
#include "ingest/catalogue.h"
#include "ingest/read_film.h"
#include "ingest/tally.h"
#include "ingest/walk.h"
#include "ingest/writer.h"

namespace haarmony::ingest {

// The steps from bytes to a row. Each worker makes its own, so that a decoder is never
// shared. Errors of `describe` become the file's reason of failure.
struct PictureSteps {
    std::function<Result<schema::NewImage>(std::span<const std::uint8_t>)> describe;
    std::function<std::string(std::span<const std::uint8_t>)> content_hash;
    FilmSteps film = {};  // where the walk finds films
};
using MakePictureSteps = std::function<PictureSteps()>;

// The real ones: decode.h, video_source.h, describe.h; of a film at most so many key frames
// (key_frames.h). Requires: `kinds` starts with the default kind; most_key_frames >= 1.
[[nodiscard]] MakePictureSteps picture_steps(std::vector<image::SignatureKind> kinds,
                                             std::size_t most_key_frames);

struct PipelineOptions {
    std::vector<std::string> paths = {};
    WalkOptions walk = {};
    int jobs = 1;  // >= 1
    bool prune = false;
    bool restore = false;
    bool count_ahead = false;  // a second walk tells the observer how many there will be
    std::int64_t max_file_bytes = std::int64_t{1} << 30;  // of a picture
    std::int64_t file_bytes = std::int64_t{1} << 30;
};

struct Report {
    Tally tally;
    std::size_t paths_reached = 0;  // PATHs that could be used
    bool stopped = false;           // `stop` was set: perhaps before everything was done
    Result<void> outcome;
};

[[nodiscard]] Report run(const PipelineOptions& options,
                         Catalogue& catalogue,
                         const MakePictureSteps& make_steps,
                         Observer& observer,
                         const std::atomic<bool>& stop);

}  // namespace haarmony::ingest
