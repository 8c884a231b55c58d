// A frame of a clip as a tree that a source may hand in again.
//   time_tree.h -> [leaf_tree.h] -> place.h, compose.h, clip_frames.h
//
// Shape   the frame's detail up to its space_level(); its pixels are the padded averages,
//         so that what a square shows beyond the picture's edge is clear. Below level 3
//         pixels are squares of several, as in any tree.
// Errors  none.
// Cost    linear in the nodes copied.
#pragma once

#include <cstdint>

#include "engine/video/image_tree.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

// How much an operation has looked at: squares of the trees that it reads and of those
// that it writes.
struct Visited {
    std::int64_t read = 0;
    std::int64_t written = 0;

    Visited& operator+=(const Visited& other) {
        read += other.read;
        written += other.written;
        return *this;
    }
    friend bool operator==(const Visited&, const Visited&) = default;
};

// `tree`'s storage is used again.
Visited leaf_tree(const Frame& frame, ImageTree& tree);

}  // namespace haarmony::video
