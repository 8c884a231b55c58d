// The parts of what ingest does with one picture, each measured alone.
#pragma once

#include <span>
#include <vector>

#include "engine/image/color_planes.h"
#include "tests/bench/ingest/contenders.h"

namespace haarmony::bench {

// Decoding; then what is made of the pixels, decoded beforehand: thumbnail, area average,
// signature, the look for borders; and SHA-256 of the file. Requires: `files` outlives what is
// returned. Cost: all pictures in memory.
[[nodiscard]] std::vector<Contender> stages(const std::vector<JpegFile>& files);

// The 128 x 128 cells of each picture: what the kernels start from.
[[nodiscard]] std::vector<image::ColorPlanes> cells_of(std::span<const JpegFile> files);

// Colour conversion, Haar and truncation together; then without truncation, without Haar,
// and the copy of the cells alone that each of them works on.
// Requires: `cells` outlives what is returned.
[[nodiscard]] std::vector<Contender> kernel_steps(
    const std::vector<image::ColorPlanes>& cells);

}  // namespace haarmony::bench
