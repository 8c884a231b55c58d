// Asks for the server's key when it wants one, or another one.

import { byId } from './dom.js';

export class KeyDialog {
  #dialog = byId('key', HTMLDialogElement);
  #input = byId('key-input', HTMLInputElement);
  #asked = false;

  /** @param {(key: string) => void} use */
  constructor(use) {
    byId('key-form', HTMLFormElement).addEventListener('submit', () => {
      const key = this.#input.value.trim();
      if (key !== '') use(key);
    });
    byId('key-cancel', HTMLButtonElement).addEventListener('click', () => this.#dialog.close());
  }

  /** @param {boolean} refused whether there was a key already */
  ask(refused) {
    if (this.#dialog.open) return;
    byId('key-title', HTMLElement).textContent = refused
      ? 'The server does not know this key'
      : 'This server wants a key';
    this.#input.value = '';
    this.#dialog.showModal();
    this.#asked = true;
  }

  /** Whether somebody has been asked and closed the dialog without a key that works. */
  get asked() {
    return this.#asked;
  }

  /** A request with the key was answered. */
  accepted() {
    this.#asked = false;
  }
}
