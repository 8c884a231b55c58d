// From the bytes of a JPEG to its signature, our way and two others.
//
// Errors  a picture that a contender cannot read ends the program with a message: nothing is
//         measured on a part of the pictures.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/ingest/paired.h"

namespace haarmony::bench {

using Bytes = std::vector<std::uint8_t>;

struct JpegFile {
    std::string name;
    Bytes bytes;
};

// Every *.jpg and *.jpeg of a folder, capitals or not, by name; where there are more than
// `most`, so many spread over it.
[[nodiscard]] std::vector<JpegFile> read_folder(const std::string& folder,
                                                std::size_t most);

// The first: our decoding, signature (and the look for borders) and thumbnail; the second: the
// same and SHA-256, which is all that ingest does with the bytes of a file. Then the others,
// whose only result is the signature: every pixel with OpenImageIO, and libvips' thumbnail
// where it is installed.
// Requires: `files` outlives what is returned.
[[nodiscard]] std::vector<Contender> contenders(const std::vector<JpegFile>& files);

[[noreturn]] void give_up(const std::string& message);

}  // namespace haarmony::bench
