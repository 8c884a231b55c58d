// A ZIP archive of stored entries, written without going back.
//   [zip_writer.h] -> png_zip.h
//
// Shape   local headers with sizes and checksums, so that a reader needs no look ahead; no
//         dates (1980-01-01), so that the same entries give the same archive; no ZIP64.
// Errors  kTooLarge: more than 65,535 entries, or bytes that 32 bits cannot count.
// Threads one caller an archive.
// Source  APPNOTE.TXT 6.3.10, 4.3.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace haarmony::ingest {

inline constexpr std::int64_t kMaxZipEntries = 65'535;
inline constexpr std::uint64_t kMaxZipBytes = 0xFFFF'FFFE;

class ZipWriter {
  public:
    // The archive begins at `offset` of the file.
    explicit ZipWriter(std::uint64_t offset) : offset_(offset) {}

    // The bytes of one more entry, to be written next. Requires: names are ASCII, and differ.
    [[nodiscard]] Result<std::vector<std::uint8_t>> entry(
        const std::string& name,
        std::span<const std::uint8_t> content);
    // The end of the archive.
    [[nodiscard]] std::vector<std::uint8_t> end() const;

  private:
    std::uint64_t offset_;
    std::int64_t entries_ = 0;
    std::vector<std::uint8_t> directory_;
};

}  // namespace haarmony::ingest
