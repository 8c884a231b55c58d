// What the page says: to screen readers, in passing, and in the banner of a lost server.

import { byId } from './dom.js';

const kToastMs = 4000;

export class Notices {
  #announcer = byId('announcer', HTMLElement);
  #toast = byId('toast', HTMLElement);
  #banner = byId('banner', HTMLElement);
  #timer = 0;

  /** @param {string} text for screen readers only */
  announce = (text) => {
    // The same words twice are read twice only if they differ.
    const again = this.#announcer.textContent === text;
    this.#announcer.textContent = again ? `${text}\u00a0` : text;
  };

  /** @param {string} text shown for a moment, and announced */
  tell(text) {
    this.announce(text);
    this.#toast.textContent = text;
    this.#toast.hidden = false;
    window.clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => (this.#toast.hidden = true), kToastMs);
  }

  /** @param {string} text stays until clear() */
  warn(text) {
    byId('banner-text', HTMLElement).textContent = text;
    this.#banner.hidden = false;
  }

  clear() {
    this.#banner.hidden = true;
  }
}
