// The colours to paint with: a fixed set, what was mixed or picked lately, and any other.

import { isHex, luminance } from './canvas/color.js';
import { byId, make } from './dom.js';

/** Ordered by what they paint: snow to night, earth, fire, flowers, leaves, water and sky. */
export const kColors = [
  ['#ffffff', 'white'], ['#c9ccd1', 'light grey'], ['#7d828a', 'grey'], ['#3b3f46', 'dark grey'],
  ['#0f1114', 'black'], ['#4a2f1d', 'dark brown'], ['#8a5a33', 'brown'], ['#d8b48a', 'sand'],
  ['#f3d9b8', 'skin'], ['#ffe14d', 'yellow'], ['#f9a62b', 'amber'], ['#ee6c2c', 'orange'],
  ['#d62f2f', 'red'], ['#8e1b2f', 'wine'], ['#f19bb4', 'pink'], ['#c2409a', 'magenta'],
  ['#6d4bb8', 'violet'], ['#2d2f7a', 'navy'], ['#2364c4', 'blue'], ['#5db1ec', 'sky blue'],
  ['#b9def5', 'pale blue'], ['#1f8f8a', 'teal'], ['#8cc63f', 'light green'], ['#3c8a3a', 'green'],
  ['#1d4a2b', 'dark green'],
];
const kMostRecent = 5;
/** Above it a dark tick is easier to see on a colour than a light one. */
const kTickLuminance = 0.35;

export class Palette extends EventTarget {
  #field = byId('palette', HTMLFieldSetElement);
  #custom = byId('custom-color', HTMLInputElement);
  #color = '#2364c4';

  constructor() {
    super();
    const mixer = this.#custom.closest('label');
    for (const [hex, name] of kColors) mixer?.before(swatch(hex, name));
    this.#field.addEventListener('change', (event) => {
      const { target } = event;
      if (target instanceof HTMLInputElement) this.choose(target.value);
    });
    // A colour dialog tells every colour on the way: paint with it, remember only the last.
    this.#custom.addEventListener('input', () => this.#set(this.#custom.value));
    this.#mark();
  }

  get color() {
    return this.#color;
  }

  /**
   * A new colour joins the recent ones.
   * @param {string} hex
   */
  choose(hex) {
    if (!isHex(hex)) throw new RangeError(`not a colour: ${hex}`);
    if (!this.#swatches().some((input) => input.value === hex)) {
      this.#custom.closest('label')?.after(swatch(hex, `recent ${hex}`, true));
      const recent = this.#field.querySelectorAll('.swatch.recent');
      for (const old of [...recent].slice(kMostRecent)) old.remove();
    }
    this.#set(hex);
  }

  /** @param {string} hex */
  #set(hex) {
    this.#color = hex;
    this.#mark();
    this.dispatchEvent(new Event('change'));
  }

  #mark() {
    this.#custom.value = this.#color;
    for (const input of this.#swatches()) input.checked = input.value === this.#color;
  }

  #swatches() {
    return [...this.#field.querySelectorAll('input')].filter(({ type }) => type === 'radio');
  }
}

/**
 * @param {string} hex
 * @param {string} name
 * @param {boolean} [recent]
 */
function swatch(hex, name, recent = false) {
  const input = make('input', { type: 'radio', name: 'color', value: hex });
  input.setAttribute('aria-label', name);
  const label = make('label', { className: 'swatch', title: name }, input);
  label.classList.toggle('recent', recent);
  label.classList.toggle('pale', luminance(hex) > kTickLuminance);
  label.style.setProperty('--swatch', hex);
  return label;
}
