// What was painted since the canvas was last empty, stroke by stroke with its time (section
// 4.5.6 of the dissertation: the time until the target is found). It stays in the page until
// somebody says which picture was meant.

import { pressedWidth } from './canvas/stroke.js';

/** @typedef {import('./canvas/painting.js').Step} Step */
/** @typedef {EventTarget & {empty: boolean, drawing: boolean, width: number, height: number}} Painted */
/** @typedef {{points: [number, number][], width: number | number[], color: string}} StrokeItem */
/** @typedef {{width: number, height: number, background: null, items: StrokeItem[]}} Strokes */
/**
 * @typedef {object} Entry
 * @property {number} at when it began
 * @property {boolean} blank whether nothing was on the canvas after it
 * @property {StrokeItem | null} item null: no stroke of a brush, but a fill, the eraser, a picture
 */

export class StrokeLog {
  #painting;
  #clock;
  /** @type {Entry[]} */ #done = [];
  /** @type {Entry[]} */ #undone = [];
  /** @type {number | null} */ #began = null;

  /**
   * @param {Painted} painting
   * @param {import('./clock.js').Clock} clock
   */
  constructor(painting, clock) {
    this.#painting = painting;
    this.#clock = clock;
    painting.addEventListener('change', () => {
      if (!painting.drawing) return;
      this.#began ??= clock.now();
    });
    painting.addEventListener('step', (event) => {
      this.#take(/** @type {CustomEvent<Step>} */ (event).detail);
    });
  }

  /**
   * The painting as its strokes, in painting order.
   * @returns {Strokes | null} null if strokes alone do not say it
   */
  strokes() {
    const items = [];
    for (const { item } of this.#running()) {
      if (item === null) return null;
      items.push(item);
    }
    const { width, height } = this.#painting;
    return items.length > 0 ? { width, height, background: null, items } : null;
  }

  /** @returns {number | null} seconds since the first stroke; null if nothing is painted */
  seconds() {
    const [first] = this.#running();
    return first ? (this.#clock.now() - first.at) / 1000 : null;
  }

  /** The entries after the last one that left nothing. */
  #running() {
    return this.#done.slice(this.#done.map(({ blank }) => blank).lastIndexOf(true) + 1);
  }

  /** @param {Step} step */
  #take(step) {
    if (step.kind === 'undo' || step.kind === 'redo') {
      const [from, to] =
        step.kind === 'undo' ? [this.#done, this.#undone] : [this.#undone, this.#done];
      const entry = from.pop();
      if (entry) to.push(entry);
      return;
    }
    const at = this.#began ?? this.#clock.now();
    this.#began = null;
    this.#undone = [];
    this.#done.push({ at, blank: this.#painting.empty, item: itemOf(step) });
  }
}

/**
 * @param {Step} step
 * @returns {StrokeItem | null}
 */
function itemOf(step) {
  if (step.kind !== 'stroke' || step.color === null) return null;
  const { trace, size, color } = step;
  const widths = trace.map(({ pressure }) => tenths(pressedWidth(size, pressure)));
  const even = widths.every((width) => width === widths[0]);
  return {
    points: trace.map(({ x, y }) => [tenths(x), tenths(y)]),
    width: even ? widths[0] : widths,
    color,
  };
}

/** @param {number} length in canvas pixels: more digits say nothing */
function tenths(length) {
  return Math.round(length * 10) / 10;
}
