// One picture, large: the original if the server gives it and the browser can show it, else
// the thumbnail; what is known about it; and the way on to pictures like it.

import { originalAddress, thumbnailAddress } from './api.js';
import { byId, make } from './dom.js';
import { decoded, likely, nameOf, percent, turned } from './wording.js';

/** @typedef {import('./api.js').Match} Match */

const kShown = ['image/jpeg', 'image/png', 'image/gif', 'image/webp', 'image/avif', 'image/bmp'];

export class Details {
  #dialog = byId('details', HTMLDialogElement);
  #image = byId('details-picture', HTMLImageElement);
  #original = byId('details-original', HTMLAnchorElement);
  #note = byId('details-note', HTMLElement);
  /** @type {Match[]} */ #matches = [];
  #index = 0;
  #answer = byId('details-answer', HTMLButtonElement);
  #loader;
  #api;
  #answers;
  #why;

  /**
   * @param {import('./api.js').Api} api
   * @param {import('./pictures.js').PictureLoader} loader
   * @param {(match: Match) => void} like
   * @param {{answers: import('./answers.js').Answers, why: import('./why.js').Why}} features
   */
  constructor(api, loader, like, { answers, why }) {
    this.#api = api;
    this.#loader = loader;
    this.#answers = answers;
    this.#why = why;
    this.#answer.addEventListener('click', () => void answers.give(this.#match));
    answers.addEventListener('change', () => {
      if (this.#dialog.open) this.#showAnswer();
    });
    byId('details-close', HTMLButtonElement).addEventListener('click', () => this.#dialog.close());
    byId('details-previous', HTMLButtonElement).addEventListener('click', () => this.#turn(-1));
    byId('details-next', HTMLButtonElement).addEventListener('click', () => this.#turn(1));
    byId('details-like', HTMLButtonElement).addEventListener('click', () => {
      this.#dialog.close();
      like(this.#match);
    });
    this.#original.addEventListener('click', (event) => {
      if (!loader.needsKey) return;
      event.preventDefault();
      void loader.openWithKey(this.#original.href);
    });
    this.#dialog.addEventListener('keydown', (event) => {
      if (event.key === 'ArrowLeft') this.#turn(-1);
      if (event.key === 'ArrowRight') this.#turn(1);
    });
    this.#dialog.addEventListener('click', (event) => {
      if (event.target === this.#dialog) this.#dialog.close(); // the backdrop
    });
  }

  /**
   * @param {Match[]} matches
   * @param {number} index
   */
  open(matches, index) {
    this.#matches = matches;
    this.#index = index;
    this.#fill();
    this.#dialog.showModal();
  }

  get #match() {
    return this.#matches[this.#index];
  }

  /** @param {number} step */
  #turn(step) {
    const count = this.#matches.length;
    this.#index = (this.#index + step + count) % count;
    this.#fill();
  }

  #showAnswer() {
    const given = this.#answers.given(this.#match);
    this.#answer.hidden = !this.#answers.possible;
    this.#answer.ariaDisabled = String(given); // it keeps the focus
    byId('details-answer-text', HTMLElement).textContent = given ? 'Thank you, it is kept' : 'This is it';
    byId('details-answer-note', HTMLElement).hidden = this.#answer.hidden;
  }

  #fill() {
    const match = this.#match;
    this.#showAnswer();
    this.#why.about(match);
    byId('details-name', HTMLElement).textContent = nameOf(match);
    byId('details-facts', HTMLElement).replaceChildren(
      ...facts(match).map(([term, text]) =>
        make('div', {}, make('dt', {}, term), make('dd', {}, text)),
      ),
    );
    byId('details-tags', HTMLElement).replaceChildren(
      ...(match.tags ?? []).map((tag) => make('li', {}, tag)),
    );
    this.#image.alt = nameOf(match);
    this.#original.hidden = true;
    this.#note.hidden = true;
    void this.#loader.show(this.#image, thumbnailAddress(match.id));
    void this.#showOriginal(match);
  }

  /** @param {Match} match */
  async #showOriginal(match) {
    const address = originalAddress(match.id);
    const type = await this.#api.typeOf(address).catch(() => null);
    if (match !== this.#match) return;
    this.#original.hidden = type === null;
    this.#note.hidden = type !== null;
    this.#original.href = address;
    if (type !== null && kShown.includes(type.split(';')[0].trim())) {
      await this.#loader.show(this.#image, address);
    }
  }
}

/**
 * @param {Match} match
 * @returns {[string, string][]}
 */
function facts(match) {
  /** @type {[string, string][]} */
  const known = [
    ['Similarity', `${percent(match.similarity)}, rank ${match.rank}`],
    ['Distance', match.distance.toFixed(2)],
  ];
  if (match.combined_rank !== undefined) {
    known.push(['Combined rank', String(Math.round(match.combined_rank * 10) / 10)]);
  }
  if (match.probability !== undefined) {
    known.push(['Probability', likely(match.probability)]);
  }
  if (turned(match.orientation) !== '') known.push(['Orientation', turned(match.orientation)]);
  if (match.width && match.height) known.push(['Size', `${match.width} × ${match.height} pixels`]);
  if (match.uri) known.push(['Address', decoded(match.uri)]);
  for (const [name, value] of Object.entries(match.metadata ?? {})) {
    if (typeof value === 'object') continue;
    known.push([name, String(value)]);
  }
  return known;
}
