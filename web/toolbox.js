// Which tool is in hand, and its size or tolerance.

import { byId } from './dom.js';

/** @typedef {'brush' | 'eraser' | 'fill' | 'pick'} Tool */

/** [ and ] change the size by this factor: each step is as visible as the last. */
const kSizeFactor = 1.25;

export class Toolbox extends EventTarget {
  #field = byId('tools', HTMLFieldSetElement);
  #size = byId('size', HTMLInputElement);
  #tolerance = byId('tolerance', HTMLInputElement);

  constructor() {
    super();
    for (const input of [this.#field, this.#size, this.#tolerance]) {
      input.addEventListener('input', () => this.#changed());
    }
    this.#changed();
  }

  /** @returns {Tool} */
  get tool() {
    const checked = this.#field.querySelector('input:checked');
    return /** @type {Tool} */ (/** @type {HTMLInputElement} */ (checked).value);
  }

  /** @returns {number} diameter in canvas pixels */
  get size() {
    return this.#size.valueAsNumber;
  }

  /** @returns {number} 0..255 */
  get tolerance() {
    return this.#tolerance.valueAsNumber;
  }

  /** @param {Tool} tool */
  take(tool) {
    const input = this.#field.querySelector(`input[value="${tool}"]`);
    if (input instanceof HTMLInputElement) input.checked = true;
    this.#changed();
  }

  larger() {
    this.#resize(Math.ceil(this.size * kSizeFactor));
  }

  smaller() {
    this.#resize(Math.floor(this.size / kSizeFactor));
  }

  /** @param {number} size clamped by the slider */
  #resize(size) {
    this.#size.value = String(size);
    this.#changed();
  }

  #changed() {
    const fills = this.tool === 'fill';
    byId('size-setting', HTMLLabelElement).hidden = fills;
    byId('tolerance-setting', HTMLLabelElement).hidden = !fills;
    byId('size-value', HTMLOutputElement).value = String(this.size);
    byId('tolerance-value', HTMLOutputElement).value = String(this.tolerance);
    this.dispatchEvent(new Event('change'));
  }
}
