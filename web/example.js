// Paints an example by itself: the coarse colours of a random picture, blob by blob, as
// somebody would from memory. The search runs along, so the picture is found while it is
// painted.

import { toHex } from './canvas/color.js';

/** @typedef {import('./canvas/painting.js').Painting} Painting */

const kColumns = 8;
const kRows = 6;
const kBlobMs = 45;

/**
 * The mean colours of a picture's cells, row by row.
 * @param {CanvasImageSource} picture
 * @returns {string[]}
 */
export function mosaic(picture) {
  const canvas = document.createElement('canvas');
  // An exact mean needs whole pixels in each cell: sixteen each way.
  canvas.width = kColumns * 16;
  canvas.height = kRows * 16;
  const context = canvas.getContext('2d', { willReadFrequently: true });
  if (!context) throw new Error('this browser gives no 2-D canvas');
  context.drawImage(picture, 0, 0, canvas.width, canvas.height);
  const colors = [];
  for (let row = 0; row < kRows; ++row) {
    for (let column = 0; column < kColumns; ++column) {
      const { data } = context.getImageData(column * 16, row * 16, 16, 16);
      colors.push(toHex(mean(data)));
    }
  }
  return colors;
}

/**
 * @param {Painting} painting
 * @param {string[]} colors
 * @param {AbortSignal} signal stops in the middle, as when somebody takes the brush
 */
export async function paintMosaic(painting, colors, signal) {
  const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
  const [width, height] = [painting.width / kColumns, painting.height / kRows];
  const size = Math.hypot(width, height) * 0.98;
  for (let i = 0; i < colors.length && !signal.aborted; ++i) {
    const x = (i % kColumns) * width;
    const y = (Math.floor(i / kColumns) + 0.5) * height;
    painting.beginStroke({ x: x + width * 0.35, y, pressure: 1 }, { color: colors[i], size });
    painting.extendStroke([{ x: x + width * 0.65, y, pressure: 1 }]);
    painting.endStroke();
    if (!still) await pause(kBlobMs);
  }
}

/** @param {Uint8ClampedArray} pixels RGBA */
function mean(pixels) {
  const sums = [0, 0, 0];
  for (let i = 0; i < pixels.length; ++i) if (i % 4 < 3) sums[i % 4] += pixels[i];
  return sums.map((sum) => Math.round(sum / (pixels.length / 4)));
}

/** @param {number} ms */
function pause(ms) {
  return new Promise((resolve) => window.setTimeout(resolve, ms));
}
