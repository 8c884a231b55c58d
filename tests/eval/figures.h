// The whole evaluation of section 4.5 on one's own pictures, as a page and tables.
//
// Errors  kNotFound for pictures that cannot be found or read, kIo for an output folder that
//         cannot be written.
// Source  sec. 4.5.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/executor.h"
#include "engine/core/result.h"
#include "tests/eval/picture_source.h"

namespace haarmony::eval {

struct FiguresOptions {
    std::uint64_t seed = 1;
    int queries = 150;
    int m_step = 10;  // of Figure 4.5: m = m_step, 2 m_step, ... 100
    int steps = 11;   // strengths of each distortion of Figure 4.7
};

struct OutputFile {
    std::string name;
    std::string text;
};

// The files: index.html and the tables as CSV. `progress` hears one line for each part.
// Requires: queries >= 1, 1 <= m_step <= 100, steps >= 2.
[[nodiscard]] Result<std::vector<OutputFile>> make_figures(
    const PictureSource& source,
    const FiguresOptions& options,
    Executor& executor,
    const std::function<void(const std::string&)>& progress);

// Writes them into a folder, which is made if need be.
[[nodiscard]] Result<void> write_files(const std::vector<OutputFile>& files,
                                       const std::string& folder);

}  // namespace haarmony::eval
