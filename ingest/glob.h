// Patterns of file names, for --exclude.
//
// Shape   without a '/' (one at the very end apart) a pattern is compared with the name of
//         every file and folder below a PATH; with one, with the path below that PATH
//         ("drafts/*.png", "**/cache"; a leading '/' changes nothing).
//         `*`  any run of bytes but '/'      `**`  any run of bytes, '/' too
//         `?`  one byte but '/'              `**/` nothing, or any folders
//         `[a-z]`, `[!a-z]` one byte of (not of) a set, never '/'; `\x` is x itself.
//         A '[' that is never closed stands for itself. A final '/' wants a folder.
//         Bytes are compared as they are: no case folding, no locale.
// Errors  none: every non-empty text is a pattern.
#pragma once

#include <string>
#include <string_view>

namespace haarmony::ingest {

// Cost: at most |pattern| * |text|.
[[nodiscard]] bool glob_matches(std::string_view pattern, std::string_view text);

class Exclusion {
  public:
    // Requires: `pattern` is not empty.
    explicit Exclusion(std::string pattern);

    // `below` is the path below the PATH argument, without a leading slash.
    [[nodiscard]] bool matches(std::string_view below, bool is_folder) const;

  private:
    std::string pattern_;
    bool folders_only_ = false;
    bool whole_path_ = false;
};

}  // namespace haarmony::ingest
