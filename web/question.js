// A question before something that cannot be taken back.

import { byId } from './dom.js';

export class Question {
  #dialog = byId('question', HTMLDialogElement);
  #yes = byId('question-yes', HTMLButtonElement);

  constructor() {
    this.#yes.addEventListener('click', () => this.#dialog.close('yes'));
    byId('question-no', HTMLButtonElement).addEventListener('click', () => this.#dialog.close());
  }

  /**
   * @param {string} title
   * @param {string} text
   * @param {string} yes what the button says that does it
   * @returns {Promise<boolean>}
   */
  ask(title, text, yes) {
    byId('question-title', HTMLElement).textContent = title;
    byId('question-text', HTMLElement).textContent = text;
    this.#yes.textContent = yes;
    this.#dialog.returnValue = '';
    this.#dialog.showModal();
    return new Promise((resolve) => {
      this.#dialog.addEventListener('close', () => resolve(this.#dialog.returnValue === 'yes'), { once: true });
    });
  }
}
