// Flood fill of a raster: the 4-connected region around a seed whose colours are near the
// seed's takes the new colour. Span by span, so that a full canvas costs milliseconds.
//
// Nearness is the largest difference of the premultiplied channels, so that every kind of
// unpainted (transparent) pixel is the same colour. Soft brush edges that border the region
// get the colour *under* them: without it a filled sky keeps a pale rim around each stroke.

/** @typedef {import('./color.js').Rgba} Rgba */
/** @typedef {{width: number, height: number, data: Uint8ClampedArray}} Raster row-major RGBA */
/** @typedef {{x: number, y: number, width: number, height: number}} Rect */

/**
 * Fills in place.
 * @param {Raster} raster
 * @param {number} seedX whole pixel inside the raster
 * @param {number} seedY
 * @param {Rgba} color opaque
 * @param {number} tolerance 0 (only equal colours) .. 255 (everything)
 * @returns {Rect | null} what changed, null if nothing did
 */
export function floodFill(raster, seedX, seedY, color, tolerance) {
  const { width, height, data } = raster;
  if (!(seedX >= 0 && seedX < width && seedY >= 0 && seedY < height)) {
    throw new RangeError(`seed (${seedX}, ${seedY}) is outside ${width} x ${height}`);
  }
  const region = regionAround(raster, seedX, seedY, tolerance);
  let changed = false;
  for (let y = region.top; y <= region.bottom; ++y) {
    for (let x = region.left; x <= region.right; ++x) {
      const pixel = y * width + x;
      if (region.inside[pixel]) {
        changed = paint(data, pixel * 4, color) || changed;
      } else if (isSoft(data[pixel * 4 + 3]) && borders(region.inside, width, height, x, y)) {
        changed = paintUnder(data, pixel * 4, color) || changed;
      }
    }
  }
  if (!changed) return null;
  return {
    x: region.left,
    y: region.top,
    width: region.right - region.left + 1,
    height: region.bottom - region.top + 1,
  };
}

/**
 * @param {Raster} raster
 * @param {number} seedX
 * @param {number} seedY
 * @param {number} tolerance
 */
function regionAround({ width, height, data }, seedX, seedY, tolerance) {
  const inside = new Uint8Array(width * height);
  const seed = premultiplied(data, (seedY * width + seedX) * 4);
  /** @param {number} pixel */
  const near = (pixel) => !inside[pixel] && difference(data, pixel * 4, seed) <= tolerance;
  let [left, right, top, bottom] = [seedX, seedX, seedY, seedY];
  const stack = [seedY * width + seedX];
  while (stack.length > 0) {
    const pixel = /** @type {number} */ (stack.pop());
    if (!near(pixel)) continue;
    const y = Math.floor(pixel / width);
    const row = y * width;
    let from = pixel;
    while (from > row && near(from - 1)) --from;
    let to = pixel;
    while (to < row + width - 1 && near(to + 1)) ++to;
    inside.fill(1, from, to + 1);
    for (const next of [y > 0 ? -width : 0, y < height - 1 ? width : 0]) {
      if (next === 0) continue;
      // One seed a run is enough: the run is walked in full when it is popped.
      let inRun = false;
      for (let p = from + next; p <= to + next; ++p) {
        const open = near(p);
        if (open && !inRun) stack.push(p);
        inRun = open;
      }
    }
    left = Math.min(left, from - row);
    right = Math.max(right, to - row);
    top = Math.min(top, y);
    bottom = Math.max(bottom, y);
  }
  // One pixel more on each side: soft edges next to the region are painted under.
  return {
    inside,
    left: Math.max(0, left - 1),
    right: Math.min(width - 1, right + 1),
    top: Math.max(0, top - 1),
    bottom: Math.min(height - 1, bottom + 1),
  };
}

/** @param {number} alpha */
function isSoft(alpha) {
  return alpha > 0 && alpha < 255;
}

/**
 * @param {Uint8ClampedArray} data
 * @param {number} at
 * @returns {Rgba}
 */
function premultiplied(data, at) {
  const alpha = data[at + 3] / 255;
  return [data[at] * alpha, data[at + 1] * alpha, data[at + 2] * alpha, data[at + 3]];
}

/**
 * @param {Uint8ClampedArray} data
 * @param {number} at
 * @param {Rgba} seed premultiplied
 */
function difference(data, at, seed) {
  const alpha = data[at + 3] / 255;
  return Math.max(
    Math.abs(data[at] * alpha - seed[0]),
    Math.abs(data[at + 1] * alpha - seed[1]),
    Math.abs(data[at + 2] * alpha - seed[2]),
    Math.abs(data[at + 3] - seed[3]),
  );
}

/**
 * @param {Uint8Array} inside
 * @param {number} width
 * @param {number} height
 * @param {number} x
 * @param {number} y
 */
function borders(inside, width, height, x, y) {
  // Diagonal neighbours too: a soft edge is up to one and a half pixels wide.
  for (let j = Math.max(0, y - 1); j <= Math.min(height - 1, y + 1); ++j) {
    for (let i = Math.max(0, x - 1); i <= Math.min(width - 1, x + 1); ++i) {
      if (inside[j * width + i] === 1) return true;
    }
  }
  return false;
}

/**
 * @param {Uint8ClampedArray} data
 * @param {number} at
 * @param {Rgba} color
 */
function paint(data, at, color) {
  const same = color.every((channel, i) => data[at + i] === channel);
  data.set(color, at);
  return !same;
}

/**
 * Puts an opaque colour below a pixel (the "destination over" operator).
 * @param {Uint8ClampedArray} data
 * @param {number} at
 * @param {Rgba} color
 */
function paintUnder(data, at, color) {
  const alpha = data[at + 3] / 255;
  for (let i = 0; i < 3; ++i) {
    data[at + i] = Math.round(data[at + i] * alpha + color[i] * (1 - alpha));
  }
  data[at + 3] = 255;
  return true;
}
