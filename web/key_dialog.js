// Asks for the server's key when it wants one, or another one.

import { byId } from './dom.js';

export class KeyDialog {
  #dialog = byId('key', HTMLDialogElement);
  #input = byId('key-input', HTMLInputElement);
  #declined = false;

  /** @param {{use: (key: string) => void, decline: () => void}} port */
  constructor({ use, decline }) {
    byId('key-form', HTMLFormElement).addEventListener('submit', () => {
      const key = this.#input.value.trim();
      this.#declined = false;
      if (key !== '') use(key);
    });
    byId('key-cancel', HTMLButtonElement).addEventListener('click', () => this.#dialog.close());
    this.#dialog.addEventListener('close', () => {
      if (this.#declined) decline();
    });
  }

  /** @param {boolean} refused whether there was a key already */
  ask(refused) {
    if (this.#dialog.open) return;
    byId('key-title', HTMLElement).textContent = refused
      ? 'The server does not know this key'
      : 'This server wants a key';
    this.#input.value = '';
    this.#declined = true;
    this.#dialog.showModal();
  }

  /** Whether somebody was asked and gave none: what runs by itself should not ask again. */
  get declined() {
    return this.#declined;
  }

  /** Somebody tries again. */
  forgive() {
    this.#declined = false;
  }
}
