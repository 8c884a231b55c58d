// haarmony-gallery's command line:
//   haarmony-gallery --out DIR [--count N] [--seed S] [--side N] [--jobs N]
//
// Errors  exit code 2 for a bad command line, 3 when the pictures cannot be written; one
//         line on `err` with the bad value or the file.
#pragma once

#include <iosfwd>
#include <span>
#include <string>

namespace haarmony::gallery {

// Returns the exit code. `arguments` are those after the program's name.
[[nodiscard]] int run(std::span<const std::string> arguments,
                      std::ostream& out,
                      std::ostream& err);

}  // namespace haarmony::gallery
