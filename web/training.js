// Training: the weights of a profile of one's own are fitted to the answers that were given,
// and some answers are held back to say whether that helped.

import { carrying } from './api.js';
import { byId } from './dom.js';
import { Refused } from './failures.js';
import { kProfileName } from './search_options.js';
import { counted } from './wording.js';

/** @typedef {{median_rank: number, rank_1: number, top_20: number}} Ranks the last two in [0, 1] */
/**
 * @typedef {object} Trained
 * @property {{pairs: number, before: Ranks, after: Ranks}} held_back
 * @property {boolean} [better]
 * @property {boolean} [stored]
 */

export class Training {
  #section = byId('training', HTMLElement);
  #button = byId('train', HTMLButtonElement);
  #name = byId('train-name', HTMLInputElement);
  #said = byId('train-said', HTMLElement);
  #use = byId('train-use', HTMLButtonElement);
  #parts;
  #offered = false;

  /**
   * @param {object} parts
   * @param {import('./api.js').Api} parts.api
   * @param {import('./answers.js').Answers} parts.answers
   * @param {import('./server_watch.js').ServerWatch} parts.watch
   * @param {() => {base: string, kind: import('./answers.js').Kind}} parts.subject what is searched now
   * @param {(profile: string) => void} parts.use
   */
  constructor(parts) {
    this.#parts = parts;
    this.#button.addEventListener('click', () => void this.#train());
    this.#use.addEventListener('click', () => {
      this.#use.hidden = true;
      parts.use(this.#name.value.trim());
    });
    parts.answers.addEventListener('change', () => this.refresh());
  }

  /** @param {import('./capabilities.js').Capabilities} capabilities */
  offer(capabilities) {
    this.#offered = capabilities.answers('/profiles/{name}/train', 'post');
    this.refresh();
  }

  /** After another answer, or another query. */
  refresh() {
    const { answers, subject } = this.#parts;
    const count = answers.count(subject().kind);
    this.#section.hidden = !this.#offered;
    this.#button.textContent =
      count > 0 ? `Train on my ${counted(count, 'answer', 'answers')}` : 'Train on the answers';
    byId('train-hint', HTMLElement).textContent =
      count > 0
        ? 'Fits a profile of your own to all answers that this server keeps.'
        : 'Say “This is it” on results first: each answer is a pair to learn from.';
  }

  async #train() {
    const name = this.#name.value.trim();
    if (!kProfileName.test(name)) {
      this.#say('The name takes letters, digits, and . _ - only.');
      this.#name.focus();
      return;
    }
    this.#button.disabled = true;
    this.#use.hidden = true;
    this.#say('Training …');
    await this.#parts.watch.attempt(async () => {
      try {
        const address = `profiles/${encodeURIComponent(name)}/train`;
        const { subject, api } = this.#parts;
        /** @type {Trained} */
        const trained = await api.json(address, carrying('POST', subject()));
        this.#say(outcome(trained, name));
        this.#use.hidden = trained.stored !== true;
        this.#use.textContent = `Search with ${name}`;
      } catch (error) {
        this.#say(error instanceof Refused ? error.message : '');
        if (!(error instanceof Refused)) throw error;
      }
    });
    this.#button.disabled = false;
  }

  /** @param {string} text */
  #say(text) {
    this.#said.hidden = text === '';
    this.#said.textContent = text;
  }
}

/**
 * What training came to, in words.
 * @param {Trained} trained
 * @param {string} name
 */
export function outcome({ held_back: { pairs, before, after }, better, stored }, name) {
  const verdict =
    stored === true
      ? `Stored as ${name}.`
      : better === false
        ? 'Not stored: it would be worse than before.'
        : 'Not stored.';
  if (pairs === 0) return `No answer could be held back to compare. ${verdict}`;
  const share = (/** @type {number} */ part) => `${Math.round(part * 100)} %`;
  return (
    `On ${counted(pairs, 'answer', 'answers')} held back, the picture that was meant was first ` +
    `in ${share(before.rank_1)} before and ${share(after.rank_1)} now, among the first 20 in ` +
    `${share(before.top_20)} and ${share(after.top_20)}; its median rank went from ` +
    `${before.median_rank} to ${after.median_rank}. ${verdict}`
  );
}
