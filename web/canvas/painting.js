// The painting: a canvas, what can be done to it, and the way back.
//
// Unpainted canvas is transparent and does not count in the search; the eraser makes it so
// again. Every change is one step of the history; a step keeps the touched rectangle before
// and after. 'change' tells of every change, with `settled` false during a stroke; 'step' of
// every step of the history, after its change.

import { fromHex } from './color.js';
import { floodFill } from './flood_fill.js';
import { History } from './history.js';
import { Extent, fitInto } from './rect.js';
import { Stroke } from './stroke.js';

/** @typedef {import('./flood_fill.js').Rect} Rect */
/** @typedef {import('./stroke.js').PenPoint} PenPoint */
/** @typedef {{x: number, y: number}} Point */
/** @typedef {{color: string | null, size: number}} Brush no colour: the eraser */
/** @typedef {{stroke: Stroke, extent: Extent, trace: PenPoint[]} & Brush} Drawing */
/** @typedef {{kind: 'stroke', trace: PenPoint[]} & Brush | {kind: 'other' | 'undo' | 'redo'}} Step */

const kMaxSteps = 200;
const kMaxBytes = 96 * 2 ** 20;

export class Painting extends EventTarget {
  #canvas;
  #context;
  #before = document.createElement('canvas');
  #history = new History({ maxSteps: kMaxSteps, maxBytes: kMaxBytes });
  /** @type {Drawing | null} */ #stroke = null;
  #empty = true;

  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    super();
    this.#canvas = canvas;
    this.#context = context2d(canvas);
  }

  get width() {
    return this.#canvas.width;
  }

  get height() {
    return this.#canvas.height;
  }

  get canUndo() {
    return this.#history.canUndo;
  }

  get canRedo() {
    return this.#history.canRedo;
  }

  get drawing() {
    return this.#stroke !== null;
  }

  /** Whether nothing is painted. Erasing counts once its stroke has ended. */
  get empty() {
    return this.#empty;
  }

  /**
   * @param {PenPoint} point
   * @param {Brush} brush
   */
  beginStroke(point, { color, size }) {
    this.endStroke();
    this.#remember();
    const stroke = new Stroke(size, point);
    this.#stroke = { stroke, extent: new Extent(), trace: [point], color, size };
    if (color !== null) this.#empty = false;
    this.#draw([stroke.dot()]);
  }

  /** @param {PenPoint[]} points */
  extendStroke(points) {
    if (!this.#stroke) return;
    const { stroke, trace } = this.#stroke;
    trace.push(...points);
    this.#draw(points.flatMap((point) => stroke.extend(point)));
  }

  endStroke() {
    if (!this.#stroke) return;
    const { stroke, extent, trace, color, size } = this.#stroke;
    this.#draw(stroke.finish());
    this.#stroke = null;
    const touched = extent.within(this.width, this.height);
    if (touched) this.#keep(touched);
    this.#changed(true);
    if (touched) this.#stepped({ kind: 'stroke', trace, color, size });
  }

  /** Takes the stroke that is being drawn back, as when the system takes the pointer away. */
  cancelStroke() {
    if (!this.#stroke) return;
    this.#stroke = null;
    this.#context.clearRect(0, 0, this.width, this.height);
    this.#context.drawImage(this.#before, 0, 0);
    this.#changed(true);
  }

  /**
   * @param {Point} point
   * @param {string} color
   * @param {number} tolerance 0..255
   */
  fill({ x, y }, color, tolerance) {
    this.endStroke();
    const raster = this.#pixels(this.#all());
    const [seedX, seedY] = [clampIndex(x, this.width), clampIndex(y, this.height)];
    this.#remember();
    const touched = floodFill(raster, seedX, seedY, fromHex(color), tolerance);
    if (!touched) return;
    this.#context.putImageData(raster, 0, 0);
    this.#keep(touched);
    this.#changed(true);
    this.#stepped({ kind: 'other' });
  }

  /**
   * @param {Point} point
   * @returns {Uint8ClampedArray} r, g, b, a of that pixel
   */
  pixel({ x, y }) {
    const [left, top] = [clampIndex(x, this.width), clampIndex(y, this.height)];
    return this.#context.getImageData(left, top, 1, 1).data;
  }

  clear() {
    this.endStroke();
    if (this.#empty) return;
    this.#remember();
    this.#context.clearRect(0, 0, this.width, this.height);
    this.#keep(this.#all());
    this.#changed(true);
    this.#stepped({ kind: 'other' });
  }

  /**
   * Another shape of canvas. The painting is stretched with it: a search compares pictures
   * as squares, so the shape alone changes no result.
   * @param {number} width
   * @param {number} height
   */
  reshape(width, height) {
    this.endStroke();
    if (width === this.width && height === this.height) return;
    this.#remember();
    this.#replace(width, height, this.#before);
  }

  /**
   * Covers the canvas with a picture, in the canvas's shape that is nearest to it.
   * @param {CanvasImageSource} picture
   * @param {number} width
   * @param {number} height
   */
  place(picture, width, height) {
    this.endStroke();
    this.#remember();
    this.#replace(width, height, picture);
  }

  undo() {
    this.endStroke();
    if (!this.#history.undo()) return;
    this.#changed(true);
    this.#stepped({ kind: 'undo' });
  }

  redo() {
    this.endStroke();
    if (!this.#history.redo()) return;
    this.#changed(true);
    this.#stepped({ kind: 'redo' });
  }

  /**
   * The painting as a small PNG with its transparency: the query.
   * @param {number} side of the square that it fits into
   * @returns {Promise<Blob>}
   */
  toPng(side) {
    const small = this.#scaled(side);
    return new Promise((resolve, reject) => {
      small.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('no PNG'))), 'image/png');
    });
  }

  /**
   * @param {number} side
   * @returns {string} a data: address
   */
  toDataUrl(side) {
    return this.#scaled(side).toDataURL('image/png');
  }

  /** @param {number} side */
  #scaled(side) {
    const size = fitInto(this.width, this.height, side);
    const small = document.createElement('canvas');
    Object.assign(small, size);
    const context = context2d(small);
    context.imageSmoothingQuality = 'high';
    context.drawImage(this.#canvas, 0, 0, size.width, size.height);
    return small;
  }

  /** @param {import('./stroke.js').Piece[]} pieces */
  #draw(pieces) {
    const { extent, color } = /** @type {Drawing} */ (this.#stroke);
    const context = this.#context;
    context.save();
    context.globalCompositeOperation = color === null ? 'destination-out' : 'source-over';
    context.strokeStyle = color ?? '#000';
    context.fillStyle = color ?? '#000';
    context.lineCap = 'round';
    for (const piece of pieces) {
      extent.add(piece);
      drawPiece(context, piece);
    }
    context.restore();
    if (pieces.length > 0) this.#changed(false);
  }

  /** Copies the canvas as it is before a change. */
  #remember() {
    this.#before.width = this.width;
    this.#before.height = this.height;
    this.#before.getContext('2d')?.drawImage(this.#canvas, 0, 0);
  }

  /**
   * Makes a step of the change since #remember().
   * @param {Rect} touched
   */
  #keep(touched) {
    const { x, y, width, height } = touched;
    const before = context2d(this.#before).getImageData(x, y, width, height);
    const after = this.#pixels(touched);
    this.#history.push({
      undo: () => this.#context.putImageData(before, x, y),
      redo: () => this.#context.putImageData(after, x, y),
      bytes: before.data.length + after.data.length,
    });
  }

  /**
   * @param {number} width
   * @param {number} height
   * @param {CanvasImageSource} picture
   */
  #replace(width, height, picture) {
    const before = context2d(this.#before).getImageData(0, 0, this.width, this.height);
    this.#canvas.width = width;
    this.#canvas.height = height;
    this.#context.imageSmoothingQuality = 'high';
    this.#context.drawImage(picture, 0, 0, width, height);
    const after = this.#pixels(this.#all());
    this.#history.push({
      undo: () => this.#show(before),
      redo: () => this.#show(after),
      bytes: before.data.length + after.data.length,
    });
    this.#changed(true);
    this.#stepped({ kind: 'other' });
  }

  /** @param {ImageData} pixels */
  #show(pixels) {
    this.#canvas.width = pixels.width;
    this.#canvas.height = pixels.height;
    this.#context.putImageData(pixels, 0, 0);
  }

  /** @param {Rect} rect */
  #pixels({ x, y, width, height }) {
    return this.#context.getImageData(x, y, width, height);
  }

  /** @returns {Rect} */
  #all() {
    return { x: 0, y: 0, width: this.width, height: this.height };
  }

  /** @param {Step} step */
  #stepped(step) {
    this.dispatchEvent(new CustomEvent('step', { detail: step }));
  }

  /** @param {boolean} settled */
  #changed(settled) {
    if (settled) {
      this.#empty = isTransparent(this.#pixels(this.#all()).data);
    }
    this.dispatchEvent(new CustomEvent('change', { detail: { settled } }));
  }
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {import('./stroke.js').Piece} piece
 */
function drawPiece(context, { x0, y0, x1, y1, width }) {
  context.beginPath();
  if (x0 === x1 && y0 === y1) {
    // A line without length has no caps either.
    context.arc(x0, y0, width / 2, 0, 2 * Math.PI);
    context.fill();
    return;
  }
  context.lineWidth = width;
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

/** @param {HTMLCanvasElement} canvas */
function context2d(canvas) {
  // Pixels are read back after every stroke: keep them in memory, not on the graphics card.
  const context = canvas.getContext('2d', { willReadFrequently: true });
  if (!context) throw new Error('this browser gives no 2-D canvas');
  return context;
}

/** @param {Uint8ClampedArray} pixels RGBA */
function isTransparent(pixels) {
  for (let alpha = 3; alpha < pixels.length; alpha += 4) {
    if (pixels[alpha] > 0) return false;
  }
  return true;
}

/**
 * @param {number} coordinate
 * @param {number} count
 */
function clampIndex(coordinate, count) {
  return Math.min(count - 1, Math.max(0, Math.floor(coordinate)));
}
