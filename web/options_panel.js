// The search options beside the canvas: a fold that shows what this server can do. What is
// chosen there is told as 'change'; a chosen profile as 'profile'.

import { byId, make } from './dom.js';
import { countOptions } from './search_options.js';

/** @typedef {import('./search_options.js').Options} Options */
/** @typedef {import('./api.js').Source} Source */
/** @typedef {{name: string, built_in: boolean, indexed: number}} Profile indexed: pictures that it can find */

/** What each row needs of the server: an option, and a value that it must take. */
const kNeeds = /** @type {[string, string, unknown][]} */ ([
  ['orientations-row', 'orientations', 'mirror'],
  ['aspect-row', 'aspect_weight', 5],
  ['autocrop-row', 'autocrop', true],
  ['text-row', 'text', undefined],
  ['tags-row', 'tags', undefined],
]);

export class OptionsPanel extends EventTarget {
  #fold = byId('options', HTMLDetailsElement);
  #profile = byId('option-profile', HTMLSelectElement);
  #orientations = byId('option-orientations', HTMLSelectElement);
  #aspect = byId('option-aspect', HTMLSelectElement);
  #autocrop = byId('option-autocrop', HTMLInputElement);
  #partial = byId('option-partial', HTMLInputElement);
  #text = byId('option-text', HTMLInputElement);
  #tags = byId('option-tags', HTMLInputElement);
  #combine = byId('option-combine', HTMLElement);
  #combineBy = byId('option-combine-by', HTMLSelectElement);
  /** @type {Profile[]} */ #profiles = [];
  #combines = false;
  #parts = false;
  /** What is chosen, whether or not it is offered. @type {Options} */ #options = {};
  #name = 'painted';
  /** @type {Source['kind'] | null} */ #kind = null;

  constructor() {
    super();
    byId('options-rows', HTMLElement).addEventListener('change', (event) => {
      if (event.target === this.#profile) this.#choose(this.#profile.value);
      else this.#tell(this.#read());
    });
    byId('options-reset', HTMLButtonElement).addEventListener('click', () => {
      this.#tell({});
      this.#fold.querySelector('summary')?.focus(); // the button is gone
    });
  }

  /** @returns {Profile[]} those that searches can use */
  get profiles() {
    return this.#profiles;
  }

  /**
   * Shows the rows that this server understands; none: no panel.
   * @param {import('./capabilities.js').Capabilities} capabilities
   * @param {Profile[]} profiles
   */
  offer(capabilities, profiles) {
    this.#profiles = profiles.filter(({ built_in: builtIn, indexed }) => builtIn || indexed > 0);
    this.#combines = capabilities.takes('combine');
    this.#parts = capabilities.takes('partial', true);
    let any = this.#profiles.length > 0 || this.#parts;
    for (const [row, option, value] of kNeeds) {
      const offered = capabilities.takes(option, value);
      byId(row, HTMLElement).hidden = !offered;
      any ||= offered;
    }
    this.#orientations.options[2].hidden = !capabilities.takes('orientations', 'all');
    byId('profile-row', HTMLElement).hidden = this.#profiles.length === 0;
    this.#fold.hidden = !any;
    this.show(this.#name, this.#options, this.#kind);
  }

  /**
   * @param {string} profile
   * @param {Options} options
   * @param {Source['kind'] | null} kind what is searched by; null: nothing yet
   */
  show(profile, options, kind) {
    this.#name = profile;
    this.#options = options;
    this.#kind = kind;
    this.#listProfiles();
    this.#orientations.value = options.orientations ?? '';
    this.#aspect.value = options.aspect ?? '';
    this.#autocrop.checked = options.autocrop === true;
    this.#partial.checked = options.partial === true;
    const whole = kind === 'id' || kind === 'signature';
    byId('partial-row', HTMLElement).hidden = !this.#parts || whole;
    // Words that are being typed are not taken away.
    for (const [input, text] of /** @type {[HTMLInputElement, string][]} */ ([
      [this.#text, options.text ?? ''],
      [this.#tags, options.tags ?? ''],
    ])) {
      if (document.activeElement !== input) input.value = text;
    }
    this.#combineBy.value = options.combineBy ?? 'mean';
    byId('combine-by-row', HTMLElement).hidden = !options.combine?.some((name) => name !== profile);
    const count = countOptions(options);
    const badge = byId('options-count', HTMLElement);
    badge.hidden = count === 0;
    badge.textContent = String(count);
    badge.title = `${count} in use`;
    byId('options-reset', HTMLElement).hidden = count === 0;
  }

  #listProfiles() {
    const names = this.#profiles.map(({ name }) => name);
    if (!names.includes(this.#name)) names.unshift(this.#name);
    const others = names.filter((name) => name !== this.#name);
    byId('combine-row', HTMLElement).hidden = !this.#combines || others.length === 0;
    // Every answer comes through here: what stays is not made anew under somebody's finger.
    if (String(names) !== String([...this.#profile.options].map(({ value }) => value))) {
      this.#profile.replaceChildren(...names.map((name) => make('option', { value: name }, name)));
    }
    if (String(others) !== String(this.#boxes().map(({ value }) => value))) {
      this.#combine.replaceChildren(...others.map(chip));
    }
    this.#profile.value = this.#name;
    for (const box of this.#boxes()) box.checked = this.#options.combine?.includes(box.value) ?? false;
  }

  #boxes() {
    return [...this.#combine.querySelectorAll('input')];
  }

  /** @returns {Options} */
  #read() {
    const combine = this.#boxes().filter(({ checked }) => checked).map(({ value }) => value);
    /** @type {Record<string, unknown>} */
    const all = {
      orientations: this.#orientations.value,
      autocrop: this.#autocrop.checked,
      partial: this.#partial.checked,
      aspect: this.#aspect.value,
      text: this.#text.value.trim(),
      tags: this.#tags.value.trim(),
      combine: combine.length > 0 && combine,
      combineBy: combine.length > 0 && this.#combineBy.value === 'worst' && 'worst',
    };
    return Object.fromEntries(Object.entries(all).filter(([, value]) => value));
  }

  /** @param {Options} options */
  #tell(options) {
    this.#options = options;
    this.show(this.#name, options, this.#kind);
    this.dispatchEvent(new CustomEvent('change', { detail: options }));
  }

  /** @param {string} profile */
  #choose(profile) {
    this.#name = profile;
    this.dispatchEvent(new CustomEvent('profile', { detail: profile }));
    this.show(profile, this.#options, this.#kind);
  }
}

/** @param {string} value */
function chip(value) {
  const box = make('input', { type: 'checkbox', value });
  return make('label', { className: 'chip' }, box, make('span', {}, value));
}
