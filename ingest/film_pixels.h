// Pictures made fit for a film, before their colours are subsampled.
//   [film_pixels.h] -> libav_film.h
//
// Threads const-safe.
#pragma once

#include "engine/video/picture.h"

namespace haarmony::ingest {

// Every pixel over an opaque colour, one rounding a channel.
void lay_over(video::Picture& picture, video::Rgba background);

// Clear pixels next to others, two steps far, take the mean colour of those and stay clear.
// A chroma sample covers 2 x 2 pixels: without this the edges of what is painted would mix
// with the black of what is not.
void bleed_into_clear(video::Picture& picture);

}  // namespace haarmony::ingest
