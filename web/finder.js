// Finding: a source becomes a search, its answer becomes results and an address. What can go
// wrong on the way is told in words that say what to do.

import { KeyWanted, Refused, TimedOut, Unreachable } from './failures.js';
import { Search } from './search.js';
import { counted, nameOf } from './wording.js';

/** @typedef {import('./api.js').Source} Source */
/** @typedef {import('./api.js').Reply} Reply */
/** @typedef {import('./journey.js').Visit} Visit */
/**
 * @typedef {object} Asked what the page says about the query
 * @property {string} title
 * @property {string | null} preview data: address
 * @property {string | null} shared the sentence for an address from elsewhere
 */
/**
 * @typedef {object} Query
 * @property {string} topic
 * @property {boolean} settled false in the middle of a stroke
 * @property {Source} source
 * @property {string} profile
 * @property {Asked} asked
 * @property {boolean} record whether the answer makes an entry in the history
 * @property {string | null} kept data: address of the painting behind a signature of ours
 */

const kPainting = 'painting';
const kResults = 20;
/** Side of the square that the painting is sent in: twice what a signature is made from would
    be wasted, half of it would blur it. */
const kQuerySide = 160;
/** For Back: enough to go on painting. */
const kKeptSide = 480;

export class Finder {
  #painting;
  #screens;
  #journey;
  #notices;
  #connection;
  #search;
  #askForKey;
  /** @type {Query | null} */ #query = null;
  /** The profile for sketches and the one for pictures, as chosen last. */
  #profiles = { painting: 'painted', picture: 'scanned' };

  /**
   * @param {object} parts
   * @param {import('./api.js').Api} parts.api
   * @param {import('./canvas/painting.js').Painting} parts.painting
   * @param {import('./screens.js').Screens} parts.screens
   * @param {import('./journey.js').Journey} parts.journey
   * @param {import('./notices.js').Notices} parts.notices
   * @param {import('./connection.js').Connection} parts.connection
   * @param {import('./clock.js').Clock} parts.clock
   * @param {() => void} parts.askForKey
   */
  constructor({ api, painting, screens, journey, notices, connection, clock, askForKey }) {
    this.#painting = painting;
    this.#screens = screens;
    this.#journey = journey;
    this.#notices = notices;
    this.#connection = connection;
    this.#askForKey = askForKey;
    /** @type {import('./search.js').SearchPort<Query, Reply>} */
    const port = {
      send: ({ source, profile }, seq, signal) =>
        api.query(source, { profile, limit: kResults, seq }, signal),
      started: () => (screens.busy = true),
      answered: (query, reply) => this.#answered(query, reply),
      failed: (query, error) => this.#failed(query, error),
      delayed: () => notices.announce('The server is busy. Trying again in a moment.'),
    };
    this.#search = new Search(port, clock);
  }

  /** What is searched for at present. */
  get query() {
    return this.#query;
  }

  /** @param {boolean} settled false in the middle of a stroke */
  painting(settled) {
    const png = () => this.#painting.toPng(kQuerySide);
    const asked = { title: 'Like your painting', preview: null, shared: null };
    const profile = this.#profiles.painting;
    /** @type {Source} */
    const source = { kind: 'painting', png };
    this.#submit({ topic: kPainting, settled, source, profile, asked, record: true, kept: null });
  }

  /** @param {import('./api.js').Picture} picture */
  like(picture) {
    const asked = { title: `Like ${nameOf(picture)}`, preview: null, shared: null };
    this.#pictureQuery(`id:${picture.id}`, { kind: 'id', id: picture.id }, asked);
  }

  /**
   * @param {File} file
   * @param {string | null} preview
   */
  file(file, preview) {
    const asked = { title: `Like ${file.name || 'the pasted picture'}`, preview, shared: null };
    this.#pictureQuery(`file:${Date.now()}`, { kind: 'file', file }, asked);
  }

  /**
   * An address: of this tab's history, or one that somebody shared.
   * @param {Visit} visit
   */
  visit({ shared, entry }) {
    const byId = 'id' in shared;
    /** @type {Source} */
    const source = byId
      ? { kind: 'id', id: shared.id }
      : { kind: 'signature', signature: shared.signature };
    const asked = {
      title: entry?.title ?? (byId ? `Like picture ${shared.id}` : 'A shared search'),
      preview: entry?.preview ?? null,
      shared: entry ? null : sentenceFor(byId),
    };
    const topic = entry?.topic ?? (byId ? `id:${shared.id}` : 'shared');
    const kept = entry?.painting ?? null;
    const { profile } = shared;
    this.#submit({ topic, settled: true, source, profile, asked, record: false, kept });
  }

  /**
   * Compares again, otherwise.
   * @param {string} profile
   */
  compareAs(profile) {
    if (!this.#query) return;
    this.#profiles[this.#query.topic === kPainting ? 'painting' : 'picture'] = profile;
    this.#submit({ ...this.#query, profile, settled: true, record: true });
  }

  /** @returns {string} the painting as an entry of the history keeps it */
  keep() {
    return this.#painting.toDataUrl(kKeptSide);
  }

  again() {
    this.#search.again();
  }

  stop() {
    this.#search.stop();
    this.#query = null;
    this.#screens.busy = false;
  }

  /**
   * @param {string} topic
   * @param {Source} source
   * @param {Asked} asked
   */
  #pictureQuery(topic, source, asked) {
    const profile = this.#profiles.picture;
    this.#submit({ topic, settled: true, source, profile, asked, record: true, kept: null });
  }

  /** @param {Query} query */
  #submit(query) {
    this.#query = query;
    this.#search.submit(query);
  }

  /**
   * @param {Query} query
   * @param {Reply} reply
   */
  #answered(query, reply) {
    this.#connection.recover();
    this.#screens.busy = false;
    this.#screens.count(reply.searched);
    if (reply.searched === 0) return this.#screens.show('empty');
    this.#screens.ask(query);
    this.#screens.answer(reply);
    const { settled, record, source, asked, topic, profile, kept } = query;
    if (!settled) return;
    const [best] = reply.matches;
    this.#notices.announce(
      `${counted(reply.matches.length, 'result', 'results')}` +
        (best ? `, best ${nameOf(best)}` : ''),
    );
    if (!record) return;
    const shared =
      source.kind === 'id'
        ? { id: source.id, profile }
        : { signature: reply.query.signature, profile };
    const painting = source.kind === 'painting' ? this.keep() : kept;
    this.#journey.record(shared, { topic, title: asked.title, preview: asked.preview, painting });
  }

  /**
   * @param {Query} query
   * @param {unknown} error
   */
  #failed(query, error) {
    this.#screens.busy = false;
    if (error instanceof KeyWanted) return this.#askForKey();
    if (error instanceof Unreachable) return this.#connection.lose();
    this.#screens.ask(query);
    if (error instanceof Refused) {
      this.#screens.problem(titleFor(error, query.source), error.message, error.status >= 500);
    } else if (error instanceof TimedOut) {
      this.#screens.problem('The server takes too long', `There was ${error.message}.`, true);
    } else {
      this.#screens.problem('That did not work', String(error), true);
    }
  }
}

/** @param {boolean} byId */
function sentenceFor(byId) {
  const what = byId ? 'pictures like this one' : 'what somebody painted or uploaded finds here';
  return `You opened a shared search: it shows ${what}. Paint on the canvas to start your own.`;
}

/**
 * @param {Refused} error
 * @param {Source} source
 */
function titleFor({ status }, source) {
  if (status === 413) return 'This picture is too large';
  if (status === 415 || status === 422) {
    return source.kind === 'signature'
      ? 'This address cannot be read'
      : 'This picture cannot be read';
  }
  if (status === 404 && source.kind === 'id') return 'This picture is no longer in the collection';
  if (status === 400 && source.kind === 'signature') return 'This address cannot be read';
  if (status === 403) return 'The server does not allow this';
  return 'The server refused the search';
}
