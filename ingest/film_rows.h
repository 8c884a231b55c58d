// The rows of a film, one for each key frame: what a film needs, and bringing its rows up to
// date (ingest, step 4 of 4, for films).
//
// All rows of a film are written in one transaction: a film is in the database whole or not
// at all. A key frame is the same one as before if it is shown at the same time, to the
// millisecond; it keeps its row and id, and its tags and metadata. Rows of times that are no
// key frame any more go. Deleted ones stay deleted until the film's content changes, or until
// `restore`, as with pictures.
//
// A film that cannot be decoded any more leaves its rows as failed ones, with their ids; one
// that never could has a failed row under its own address.
//
// Errors  those of the catalogue.
// Threads as Catalogue.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "ingest/catalogue.h"
#include "ingest/change.h"
#include "ingest/tally.h"

namespace haarmony::ingest {

// What stands in a key frame's row for the hash of its file: of the film's hash and the
// fragment of the row's address, because no two frames are the same file.
[[nodiscard]] std::string key_frame_hash(const std::string& film_hash,
                                         std::string_view uri);

// As first_need(); `own` is the row of the film's own address.
[[nodiscard]] Need film_need(const std::optional<schema::KnownFile>& own,
                             const std::vector<FilmRow>& rows,
                             const FileLook& look,
                             bool restore);

// What is to be counted: one file seen, and each row that was written; or one skipped or
// failed. Requires: inside a transaction of the catalogue; a reading of read_film().
[[nodiscard]] Result<Tally> write_film(Catalogue& catalogue,
                                       const std::string& uri,
                                       const Reading& reading,
                                       bool restore);

// The rows of what is no film any more. Requires: as above.
[[nodiscard]] Result<void> drop_key_frames(Catalogue& catalogue, const std::string& uri);

}  // namespace haarmony::ingest
