// A film's file to the rows of its key frames (ingest, steps 2 and 3 of 4, for films):
//   walk -> [read_film] -> film_rows
//
// The film is never in memory: it is hashed in pieces and decoded by a child process.
//
// Shape   of a row: the film's stamp, but a content hash of the film's hash and the row's
//         fragment, so that no two frames are the same file; the film's media type;
//         metadata {"video": the film's address, "time": seconds, "frame": number}.
// Threads one caller a film.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "ingest/catalogue.h"
#include "ingest/change.h"
#include "ingest/file_descriptor.h"
#include "ingest/key_frames.h"

namespace haarmony::ingest {

using KeepGoing = std::function<bool()>;

// The steps from a film to its key frames and to its hash, of a file that is open.
struct FilmSteps {
    std::function<Result<std::vector<KeyFrame>>(int file, const KeepGoing&)> describe =
        {};
    std::function<Result<std::string>(int file, const KeepGoing&)> content_hash = {};
};

struct OpenFilm {
    FileDescriptor file;
    FileLook look;
    std::string media_type;
};

// The file if it is a film: bytes that no picture begins with, of a clip that can be read.
// Nothing: it is something else, is gone or cannot be opened.
[[nodiscard]] std::optional<OpenFilm> open_film(const std::string& path);

// What came of it; `known` are its rows, for kCompare. Nothing: stopped.
[[nodiscard]] std::optional<Reading> read_film(const OpenFilm& film,
                                               const std::string& uri,
                                               const std::vector<FilmRow>& known,
                                               Need need,
                                               const FilmSteps& steps,
                                               const KeepGoing& keep_going);

}  // namespace haarmony::ingest
