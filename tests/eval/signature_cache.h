// Synthetic collections as a file, since a million pictures take minutes to make.
//
// Shape   a header of 64 bytes (magic, versions, seed, digest of the photos, number of
//         pictures, queries of each kind), the queries, and blocks of kCacheBlock pictures:
//         signatures, their checksum, descriptions of the rivals, their checksum. Numbers as
//         this machine keeps them: the file is a cache and no document.
// Errors  kNotFound for no file, kUnsupportedFormat for a file of something else or of
//         another version, kUndecodable for a damaged one, kInvalidArgument for one with too
//         few pictures, kIo where it cannot be written.
#pragma once

#include <cstdint>
#include <string>

#include "engine/core/result.h"
#include "tests/eval/synthetic_signatures.h"

namespace haarmony::eval {

inline constexpr std::int64_t kCacheBlock = 65536;

// All signatures and queries of a file, whatever it was made from; no cells or histograms.
[[nodiscard]] Result<SyntheticCollection> read_signature_cache(const std::string& path);

// The first `images` pictures, with everything. Requires: images >= 1.
[[nodiscard]] Result<SyntheticCollection> read_collection_cache(const std::string& path,
                                                                std::int64_t images);

// Requires: a complete collection. The file appears whole or not at all.
[[nodiscard]] Result<void> write_collection_cache(const SyntheticCollection& collection,
                                                  const std::string& path);

}  // namespace haarmony::eval
