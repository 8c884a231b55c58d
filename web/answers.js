// "This is it": somebody says which picture was meant. The query and that picture go to the
// server as a pair to train on. Nothing else that is painted is ever kept.

import { carrying } from './api.js';
import { counted, nameOf } from './wording.js';

/** @typedef {import('./api.js').Match} Match */
/** @typedef {'painted' | 'scanned'} Kind */

const kSlot = 'haarmony.answers';

export class Answers extends EventTarget {
  #parts;
  #offered = false;
  /** The query that was answered last, and the pictures that it was for. */
  #signature = '';
  /** @type {Set<number>} */ #targets = new Set();

  /**
   * @param {object} parts
   * @param {import('./api.js').Api} parts.api
   * @param {import('./finder.js').Finder} parts.finder
   * @param {import('./stroke_log.js').StrokeLog} parts.log
   * @param {import('./notices.js').Notices} parts.notices
   * @param {import('./server_watch.js').ServerWatch} parts.watch
   * @param {Storage} parts.storage counts the answers of this browser
   */
  constructor(parts) {
    super();
    this.#parts = parts;
  }

  /** @param {import('./capabilities.js').Capabilities} capabilities */
  offer(capabilities) {
    this.#offered = capabilities.answers('/feedback', 'post');
  }

  /** Whether a match can be called the one: a picture of the collection is its own answer. */
  get possible() {
    const { query, reply } = this.#parts.finder;
    return this.#offered && reply !== null && query !== null && query.source.kind !== 'id';
  }

  /** @param {Match} match */
  given(match) {
    const signature = this.#parts.finder.reply?.query.signature;
    return signature === this.#signature && this.#targets.has(match.id);
  }

  /**
   * @param {Kind} kind
   * @returns {number} given with this browser
   */
  count(kind) {
    const count = Number(this.#parts.storage.getItem(`${kSlot}.${kind}`) ?? 0);
    return Number.isSafeInteger(count) && count > 0 ? count : 0;
  }

  /** @param {Match} match */
  async give(match) {
    const { api, finder, notices, storage, watch } = this.#parts;
    const { reply } = finder;
    if (!this.possible || !reply || this.given(match)) return;
    const pair = this.#pair(match, reply.query.signature);
    await watch.attempt(async () => {
      await api.order('feedback', carrying('POST', pair));
      if (this.#signature !== reply.query.signature) this.#targets.clear();
      this.#signature = reply.query.signature;
      this.#targets.add(match.id);
      storage.setItem(`${kSlot}.${pair.kind}`, String(this.count(pair.kind) + 1));
      const took = pair.seconds === undefined ? '' : `, found in ${counted(pair.seconds, 'second', 'seconds')}`;
      notices.tell(`Thank you: ${nameOf(match)}${took}`);
      this.dispatchEvent(new Event('change'));
    });
  }

  /**
   * @param {Match} match
   * @param {string} signature
   * @returns {{target: number, kind: Kind, signature?: string, strokes?: object, seconds?: number}}
   */
  #pair({ id: target }, signature) {
    const { finder, log } = this.#parts;
    const kind = kindOf(finder.query);
    // A painting that was brought back from the history was not painted just now.
    if (finder.query?.source.kind !== 'painting') return { signature, target, kind };
    const seconds = log.seconds();
    const strokes = log.strokes();
    const what = strokes ? { strokes } : { signature };
    return { ...what, target, kind, ...(seconds === null ? {} : { seconds: Math.round(seconds * 10) / 10 }) };
  }
}

/**
 * @param {import('./finder.js').Query | null} query
 * @returns {Kind}
 */
export function kindOf(query) {
  if (query?.source.kind === 'file') return 'scanned';
  return query?.source.kind === 'signature' && query.profile === 'scanned' ? 'scanned' : 'painted';
}
