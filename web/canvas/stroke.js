// A brush stroke as it is drawn: points come in, short straight pieces with a width go out.
//
// The line through the points is smoothed as quadratic curves between the midpoints of
// neighbours, with the points as control points: it costs nothing, lags half a step behind
// the pen, and finish() draws the rest. Units are canvas pixels.

/** @typedef {{x: number, y: number, pressure: number}} PenPoint pressure in [0, 1], 1 = full width */
/** @typedef {{x0: number, y0: number, x1: number, y1: number, width: number}} Piece */
/** @typedef {{x: number, y: number, width: number}} Knot */

/** Longest piece of a curve; below the smallest brush so that no corner shows. */
const kPieceLength = 3;
/** A pen that barely touches still draws a third of the brush. */
const kLeastPressureWidth = 0.3;

export class Stroke {
  #size;
  /** @type {Knot} the last point that came in */ #point;
  /** @type {Knot} where the drawn line ends */ #tip;

  /**
   * @param {number} size brush diameter
   * @param {PenPoint} start
   */
  constructor(size, start) {
    this.#size = size;
    this.#point = this.#knot(start);
    this.#tip = this.#point;
  }

  /** @returns {Piece} the dot that a stroke starts with */
  dot() {
    return piece(this.#tip, this.#tip);
  }

  /**
   * @param {PenPoint} point
   * @returns {Piece[]}
   */
  extend(point) {
    const next = this.#knot(point);
    const middle = between(this.#point, next, 0.5);
    const pieces = curve(this.#tip, this.#point, middle);
    this.#tip = middle;
    this.#point = next;
    return pieces;
  }

  /** @returns {Piece[]} from the tip to the last point */
  finish() {
    const pieces = curve(this.#tip, this.#tip, this.#point);
    this.#tip = this.#point;
    return pieces;
  }

  /** @param {PenPoint} point */
  #knot({ x, y, pressure }) {
    return { x, y, width: pressedWidth(this.#size, pressure) };
  }
}

/**
 * @param {number} size brush diameter
 * @param {number} pressure in [0, 1]
 */
export function pressedWidth(size, pressure) {
  return size * (kLeastPressureWidth + (1 - kLeastPressureWidth) * pressure);
}

/**
 * @param {Knot} from
 * @param {Knot} control
 * @param {Knot} to
 * @returns {Piece[]}
 */
function curve(from, control, to) {
  // A quadratic curve is nowhere faster than twice its longer leg.
  const speed =
    2 *
    Math.max(
      Math.hypot(control.x - from.x, control.y - from.y),
      Math.hypot(to.x - control.x, to.y - control.y),
    );
  const count = Math.ceil(speed / kPieceLength);
  const pieces = [];
  let last = from;
  for (let i = 1; i <= count; ++i) {
    const t = i / count;
    const next = between(between(from, control, t), between(control, to, t), t);
    pieces.push(piece(last, next));
    last = next;
  }
  return pieces;
}

/**
 * @param {Knot} a
 * @param {Knot} b
 * @param {number} t
 * @returns {Knot}
 */
function between(a, b, t) {
  return {
    x: a.x + (b.x - a.x) * t,
    y: a.y + (b.y - a.y) * t,
    width: a.width + (b.width - a.width) * t,
  };
}

/**
 * @param {Knot} a
 * @param {Knot} b
 * @returns {Piece}
 */
function piece(a, b) {
  return { x0: a.x, y0: a.y, x1: b.x, y1: b.y, width: (a.width + b.width) / 2 };
}
