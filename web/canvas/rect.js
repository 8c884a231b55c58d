// Whole-pixel rectangles: what a stroke touched, so that undo keeps no more than that.

/** @typedef {import('./flood_fill.js').Rect} Rect */

/** Grows around what is drawn. */
export class Extent {
  #left = Infinity;
  #top = Infinity;
  #right = -Infinity;
  #bottom = -Infinity;

  /** @param {import('./stroke.js').Piece} piece */
  add({ x0, y0, x1, y1, width }) {
    const reach = width / 2 + 1; // the soft edge
    this.#left = Math.min(this.#left, x0 - reach, x1 - reach);
    this.#top = Math.min(this.#top, y0 - reach, y1 - reach);
    this.#right = Math.max(this.#right, x0 + reach, x1 + reach);
    this.#bottom = Math.max(this.#bottom, y0 + reach, y1 + reach);
  }

  /**
   * @param {number} width of the canvas
   * @param {number} height
   * @returns {Rect | null} null if nothing inside the canvas was touched
   */
  within(width, height) {
    const x = Math.max(0, Math.floor(this.#left));
    const y = Math.max(0, Math.floor(this.#top));
    const right = Math.min(width, Math.ceil(this.#right));
    const bottom = Math.min(height, Math.ceil(this.#bottom));
    if (!(right > x && bottom > y)) return null;
    return { x, y, width: right - x, height: bottom - y };
  }
}

/**
 * The largest size of the same shape that fits a square, at least one pixel each way.
 * @param {number} width
 * @param {number} height
 * @param {number} side
 */
export function fitInto(width, height, side) {
  const scale = Math.min(1, side / Math.max(width, height));
  return {
    width: Math.max(1, Math.round(width * scale)),
    height: Math.max(1, Math.round(height * scale)),
  };
}
