// "Why this match", below the facts of an opened picture: the search is asked again with an
// explanation, which is shown as a small picture and a table for each channel.

import { byId, make } from './dom.js';
import { Refused } from './failures.js';
import { kResults } from './finder.js';
import { rowsOf, tally } from './explanation.js';

/** @typedef {import('./explanation.js').Explanation} Explanation */
/** @typedef {import('./api.js').Match} Match */

export class Why {
  #fold = byId('why', HTMLDetailsElement);
  #body = byId('why-body', HTMLElement);
  #parts;
  #offered = false;
  /** @type {Match | null} */ #match = null;

  /**
   * @param {object} parts
   * @param {import('./api.js').Api} parts.api
   * @param {import('./finder.js').Finder} parts.finder
   * @param {import('./server_watch.js').ServerWatch} parts.watch
   */
  constructor(parts) {
    this.#parts = parts;
    this.#fold.addEventListener('toggle', () => {
      if (this.#fold.open) void this.#ask();
    });
  }

  /** @param {import('./capabilities.js').Capabilities} capabilities */
  offer(capabilities) {
    this.#offered = capabilities.takes('explain', true);
  }

  /**
   * Another picture is shown.
   * @param {Match} match
   */
  about(match) {
    this.#match = match;
    this.#fold.hidden = !this.#offered || this.#parts.finder.reply === null;
    this.#body.replaceChildren();
    if (this.#fold.open && !this.#fold.hidden) void this.#ask();
  }

  async #ask() {
    const match = this.#match;
    const { query, reply } = this.#parts.finder;
    if (!match || !query || !reply) return;
    this.#say('Asking …');
    await this.#parts.watch.attempt(async () => {
      try {
        const { profile, options } = query;
        /** @type {import('./api.js').Source} */
        const source = { kind: 'signature', signature: reply.query.signature };
        const asking = { profile, options, limit: kResults, explain: true };
        const { matches } = await this.#parts.api.query(source, asking);
        if (match !== this.#match) return;
        const explanation = matches.find(({ id }) => id === match.id)?.explain;
        if (explanation) this.#show(explanation);
        else this.#say('By its signature alone the query does not find this picture again.');
      } catch (error) {
        if (match === this.#match) this.#say(error instanceof Refused ? error.message : '');
        if (!(error instanceof Refused)) throw error;
      }
    });
  }

  /** @param {string} text */
  #say(text) {
    this.#body.replaceChildren(...(text === '' ? [] : [make('p', {}, text)]));
  }

  /** @param {Explanation} explanation */
  #show(explanation) {
    const { channels, picture } = explanation;
    const names = channels.map(({ channel }) => channel).join(', ');
    const { matched, all } = tally(explanation);
    const parts = [
      make('p', {}, `${matched} of ${all} strong wavelet coefficients of the query are in this picture as well.`),
    ];
    if (picture?.startsWith('data:image/')) {
      const alt = `The shapes that both have, in the channels ${names}`;
      const drawn = make('img', { src: picture, alt, className: 'why-picture' });
      const legend = make('span', {}, ...channels.map(({ channel }) => make('span', {}, channel)));
      parts.push(make('p', { className: 'why-panels' }, drawn, legend));
    }
    this.#body.replaceChildren(...parts, ...channels.map(tableOf));
  }
}

/** @param {import('./explanation.js').Channel} channel */
function tableOf(channel) {
  const { average, distance } = channel;
  const head = ['Bin', 'Weight', 'Matched', 'Missed'].map((text) => {
    return make('th', { scope: 'col' }, text);
  });
  const rows = rowsOf(channel).map(({ bin, weight, matched, missed }) => {
    const cells = [weight, matched, missed].map((value) => make('td', {}, String(value)));
    return make('tr', {}, make('th', { scope: 'row' }, String(bin)), ...cells);
  });
  const means = `average ${average.query.toFixed(2)} against ${average.target.toFixed(2)}`;
  return make(
    'table',
    {},
    make('caption', {}, make('b', {}, channel.channel), ` ${means}, distance ${distance.toFixed(2)}`),
    make('thead', {}, make('tr', {}, ...head)),
    make('tbody', {}, ...rows),
  );
}
