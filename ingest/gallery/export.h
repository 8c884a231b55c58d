// The gallery as files: one JPEG a picture, e.g. `landscape-001.jpg`.
//   gallery.h -> [export.h] -> command_line.h
//
// A file is complete or absent: it is written under another name (hidden, `.part`) and
// renamed. One that already holds the same bytes is not touched, so that its time stands
// and nothing is ingested twice. Two exports into one folder take turns.
//
// Errors  kIo, naming the file or folder and what the system said; pictures written
//         before it stay.
// Threads starts `jobs` of its own and joins them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/result.h"

namespace haarmony::gallery {

inline constexpr int kMostPictures = 100'000;
inline constexpr int kMostJobs = 256;

struct ExportOptions {
    std::filesystem::path folder;  // made when absent, its parents too
    std::uint64_t seed = 1;
    int count = 300;  // 1 .. kMostPictures
    int jobs = 1;     // 1 .. kMostJobs
    // Longest side of every picture, kLeastSide .. kLargestSide; else gallery_side().
    std::optional<int> side = {};
};

struct ExportReport {
    int written = 0;
    int unchanged = 0;
};

// Requires: count, jobs and side (kLeastSide .. kLargestSide) within their ranges.
[[nodiscard]] Result<ExportReport> export_gallery(const ExportOptions& options);

// `kind` with blanks as dashes, the number counted from 1.
[[nodiscard]] std::string file_name(const std::string& kind, int number);

}  // namespace haarmony::gallery
