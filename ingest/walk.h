// Finds the candidates below files and folders (ingest, step 1 of 4):
//   [walk] -> decode -> describe -> store
//
// A candidate is a regular file (or a symbolic link to one) that has the extension or the
// first bytes of a format that can be read (sniff.h); a file that is itself a PATH is one
// whatever it looks like.
// Symbolic links to folders are not followed, unless they are a PATH. Sockets, fifos and
// devices are never opened. Hidden files and folders are like any other.
//
// Shape   each candidate once, however PATHs overlap: named files first, then folders in
//         the order given; in a folder its files by name (bytes), then its folders by name.
// Units   sizes in bytes, mtime in nanoseconds since 1970.
// Errors  folders that cannot be read and PATHs that cannot be used go to on_failure and
//         the walk goes on. Links to nothing and files that vanish are passed over.
// Threads holds one open folder, and no stack but the list of folders still to be read.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "ingest/glob.h"

struct stat;

namespace haarmony::ingest {

// What unchanged files are recognised by before they are read.
struct FileLook {
    std::int64_t size = 0;
    std::int64_t mtime_ns = 0;

    friend bool operator==(const FileLook&, const FileLook&) = default;
};

[[nodiscard]] FileLook look_of(const struct stat& status);

struct FoundFile {
    std::string path;  // absolute, normal
    FileLook look;
};

// A file on disk, whatever its names are.
struct FileIdentity {
    std::uint64_t device = 0;
    std::uint64_t inode = 0;

    friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};

// The files that SQLite keeps for the database `path`, as far as they exist now.
[[nodiscard]] std::vector<FileIdentity> database_files(const std::string& path);

struct WalkOptions {
    std::vector<Exclusion> exclude;  // a folder that is a PATH is walked all the same
    std::vector<FileIdentity> own_files;  // never candidates
    bool films = false;      // are candidates as well, by extension or first bytes
    bool file_links = true;  // below a PATH; false where a link may lead out of bounds
};

struct WalkEvents {
    // Return false to end the walk.
    std::function<bool(FoundFile)> on_file;
    std::function<bool(const std::string& path, const Error&)> on_failure;
    std::function<bool()> keep_going;  // asked before each folder and each file
};

struct WalkSummary {
    bool finished = false;             // not ended by one of the events
    std::vector<std::string> reached;  // the PATHs that could be used, normal
};

[[nodiscard]] WalkSummary walk(const std::vector<std::string>& paths,
                               const WalkOptions& options,
                               const WalkEvents& events);

}  // namespace haarmony::ingest
