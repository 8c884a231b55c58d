// The canvas with a tool in hand: pointer and keys become strokes, fills and picked colours.

import { toHex } from './canvas/color.js';
import { listenToKeys } from './canvas/keyboard_brush.js';
import { listenToPointers, toCanvas } from './canvas/pointer_input.js';
import { nearestShape, sizeOfShape } from './canvas/shapes.js';
import { byId } from './dom.js';

/** @typedef {import('./canvas/painting.js').Painting} Painting */
/** @typedef {import('./canvas/stroke.js').PenPoint} PenPoint */
/** @typedef {{x: number, y: number}} Point */

export class Easel {
  #canvas = byId('canvas', HTMLCanvasElement);
  #frame = byId('frame', HTMLElement);
  #ring = byId('ring', HTMLElement);
  #shape = byId('shape', HTMLSelectElement);
  #painting;
  #toolbox;
  #palette;
  #announce;

  /**
   * @param {Painting} painting
   * @param {import('./toolbox.js').Toolbox} toolbox
   * @param {import('./palette.js').Palette} palette
   * @param {(text: string) => void} announce
   */
  constructor(painting, toolbox, palette, announce) {
    this.#painting = painting;
    this.#toolbox = toolbox;
    this.#palette = palette;
    this.#announce = announce;
    listenToPointers(this.#canvas, {
      start: (point, how) => this.#start(point, how),
      move: (points) => painting.extendStroke(points),
      end: () => painting.endStroke(),
      cancel: () => painting.cancelStroke(),
    });
    listenToKeys(this.#canvas, {
      move: (point) => this.#showRing(point, true),
      press: (point) => this.#press(point),
      draw: (point) => painting.extendStroke([{ ...point, pressure: 1 }]),
      lift: () => {
        painting.endStroke();
        this.#announce('Brush up');
      },
    });
    this.#followPointer();
    this.#wireSteps();
    this.#shape.addEventListener('change', () => {
      const { width, height } = sizeOfShape(this.#shape.value);
      painting.reshape(width, height);
    });
    toolbox.addEventListener('change', () => this.#equip());
    palette.addEventListener('change', () => {
      // A new colour is meant to be painted with.
      if (toolbox.tool === 'eraser' || toolbox.tool === 'pick') toolbox.take('brush');
      this.#equip();
    });
    painting.addEventListener('change', () => this.#refresh());
    this.#equip();
    this.#refresh();
  }

  /**
   * Puts a picture on the canvas, in the shape that is nearest to its own.
   * @param {CanvasImageSource} picture
   * @param {number} width its own
   * @param {number} height
   */
  place(picture, width, height) {
    const size = sizeOfShape(nearestShape(width, height));
    this.#painting.place(picture, size.width, size.height);
  }

  /**
   * @param {PenPoint} point
   * @param {{erase: boolean, pick: boolean}} how
   */
  #start(point, { erase, pick }) {
    const tool = pick ? 'pick' : erase ? 'eraser' : this.#toolbox.tool;
    if (tool === 'pick') return this.#pick(point);
    if (tool === 'fill') {
      return this.#painting.fill(point, this.#palette.color, this.#toolbox.tolerance);
    }
    const color = tool === 'eraser' ? null : this.#palette.color;
    this.#painting.beginStroke(point, { color, size: this.#toolbox.size });
  }

  /**
   * @param {Point} point
   * @returns {boolean} whether the brush is down now
   */
  #press(point) {
    this.#start({ ...point, pressure: 1 }, { erase: false, pick: false });
    if (this.#painting.drawing) this.#announce('Brush down');
    return this.#painting.drawing;
  }

  /** @param {Point} point */
  #pick(point) {
    const pixel = this.#painting.pixel(point);
    if (pixel[3] === 0) return this.#announce('Nothing is painted there');
    const hex = toHex(pixel);
    this.#palette.choose(hex);
    this.#announce(`Colour ${hex}`);
  }

  #followPointer() {
    this.#canvas.addEventListener('pointermove', (event) => {
      if (event.pointerType === 'touch') this.#ring.hidden = true;
      else this.#showRing(toCanvas(this.#canvas, event), false);
    });
    this.#canvas.addEventListener('pointerleave', () => (this.#ring.hidden = true));
    this.#canvas.addEventListener('blur', () => (this.#ring.hidden = true));
  }

  /**
   * @param {Point} point
   * @param {boolean} byKeys a cursor that must be seen with every tool
   */
  #showRing({ x, y }, byKeys) {
    const draws = this.#toolbox.tool === 'brush' || this.#toolbox.tool === 'eraser';
    this.#ring.hidden = !draws && !byKeys;
    this.#ring.classList.toggle('crosshair', byKeys);
    this.#ring.style.left = `${(x / this.#canvas.width) * 100}%`;
    this.#ring.style.top = `${(y / this.#canvas.height) * 100}%`;
  }

  #wireSteps() {
    byId('undo', HTMLButtonElement).addEventListener('click', () => this.#painting.undo());
    byId('redo', HTMLButtonElement).addEventListener('click', () => this.#painting.redo());
    byId('clear', HTMLButtonElement).addEventListener('click', () => this.#painting.clear());
  }

  #equip() {
    const { tool, size } = this.#toolbox;
    this.#canvas.dataset.tool = tool;
    this.#ring.style.setProperty('--share', String(size / this.#canvas.width));
    this.#ring.style.setProperty('--ink', tool === 'eraser' ? 'transparent' : this.#palette.color);
  }

  #refresh() {
    const painting = this.#painting;
    byId('undo', HTMLButtonElement).disabled = !painting.canUndo;
    byId('redo', HTMLButtonElement).disabled = !painting.canRedo;
    byId('clear', HTMLButtonElement).disabled = painting.empty;
    byId('invitation', HTMLElement).hidden = !painting.empty || painting.drawing;
    this.#shape.value = nearestShape(painting.width, painting.height);
    this.#frame.style.setProperty('--ratio', String(painting.width / painting.height));
    this.#ring.style.setProperty('--share', String(this.#toolbox.size / painting.width));
  }
}
