// Finding: a source becomes a search, its answer becomes results and an address. What can go
// wrong on the way is told in words that say what to do.

import { KeyWanted, Refused, TimedOut, Unreachable } from './failures.js';
import { Search } from './search.js';
import { optionsFor } from './search_options.js';
import { counted, nameOf } from './wording.js';

/** @typedef {import('./api.js').Source} Source */
/** @typedef {import('./api.js').Reply} Reply */
/** @typedef {import('./journey.js').Visit} Visit */
/** @typedef {import('./search_options.js').Options} Options */
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
 * @property {Options} options
 * @property {Asked} asked
 * @property {boolean} record whether the answer makes an entry in the history
 * @property {string | null} kept data: address of the painting behind a signature of ours
 */

const kPainting = 'painting';
export const kResults = 20;
/** Side of the square that the painting is sent in: twice what a signature is made from would
    be wasted, half of it would blur it. */
const kQuerySide = 160;
/** For Back: enough to go on painting. */
const kKeptSide = 480;

/** 'change' tells that another answer, or none, is on the screen. */
export class Finder extends EventTarget {
  #painting;
  #screens;
  #journey;
  #notices;
  #connection;
  #search;
  #askForKey;
  /** @type {Query | null} */ #query = null;
  /** The answer that is on the screen. @type {Reply | null} */ #reply = null;
  /** As chosen last, or as the address says. @type {Options} */ #options = {};
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
    super();
    this.#painting = painting;
    this.#screens = screens;
    this.#journey = journey;
    this.#notices = notices;
    this.#connection = connection;
    this.#askForKey = askForKey;
    /** @type {import('./search.js').SearchPort<Query, Reply>} */
    const port = {
      send: ({ source, profile, options }, seq, signal) =>
        api.query(source, { profile, limit: kResults, seq, options }, signal),
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

  /** The answer on the screen, if it answers a query. */
  get reply() {
    return this.#query && this.#reply;
  }

  /** What the search on the screen compares by, or the next painting would. */
  get profile() {
    return this.#query?.profile ?? this.#profiles.painting;
  }

  /** @param {boolean} settled false in the middle of a stroke */
  painting(settled) {
    const png = () => this.#painting.toPng(kQuerySide);
    const asked = { title: 'Like your painting', preview: null, shared: null };
    const profile = this.#profiles.painting;
    /** @type {Source} */
    const source = { kind: 'painting', png };
    const options = this.#options;
    this.#submit({ topic: kPainting, settled, source, profile, options, asked, record: true, kept: null });
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
    const { profile, options = {} } = shared;
    const asked = {
      title: entry?.title ?? (byId ? `Like picture ${shared.id}` : 'A shared search'),
      preview: entry?.preview ?? null,
      shared: options.partial ? kWholeSentence : entry ? null : sentenceFor(byId),
    };
    this.#options = options;
    const topic = entry?.topic ?? (byId ? `id:${shared.id}` : 'shared');
    const kept = entry?.painting ?? null;
    this.#submit({ topic, settled: true, source, profile, options, asked, record: false, kept });
  }

  /**
   * Compares again, otherwise; without a query, the next painting.
   * @param {string} profile
   */
  compareAs(profile) {
    const paints = !this.#query || this.#query.topic === kPainting;
    this.#profiles[paints ? 'painting' : 'picture'] = profile;
    if (this.#query) this.#submit({ ...this.#query, profile, settled: true, record: true });
  }

  /**
   * Searches again, with other options; without a query, the next time.
   * @param {Options} options
   */
  narrow(options) {
    this.#options = options;
    if (this.#query) this.#submit({ ...this.#query, options, settled: true, record: true });
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
    this.#reply = null;
    this.#screens.busy = false;
    this.dispatchEvent(new Event('change'));
  }

  /**
   * @param {string} topic
   * @param {Source} source
   * @param {Asked} asked
   */
  #pictureQuery(topic, source, asked) {
    const profile = this.#profiles.picture;
    const options = this.#options;
    this.#submit({ topic, settled: true, source, profile, options, asked, record: true, kept: null });
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
    const { settled, record, source, asked, topic, profile, options, kept } = query;
    // With a filter, what was searched is not what there is.
    const filtered = options.text !== undefined || options.tags !== undefined;
    if (!filtered) this.#screens.count(reply.searched);
    if (reply.searched === 0 && !filtered) return this.#screens.show('empty');
    this.#reply = reply;
    // What was chosen while the answer was on its way stays chosen: it has been asked, too.
    this.#screens.ask({ ...query, options: this.#options });
    this.#screens.answer(reply);
    this.dispatchEvent(new Event('change'));
    if (!settled) return;
    const [best] = reply.matches;
    this.#notices.announce(
      `${counted(reply.matches.length, 'result', 'results')}` +
        (best ? `, best ${nameOf(best)}` : ''),
    );
    if (!record) return;
    const shared =
      source.kind === 'id'
        ? { id: source.id, profile, options: optionsFor(options, 'id') }
        : { signature: reply.query.signature, profile, options };
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

const kWholeSentence =
  'This search was for a part of a picture, which an address cannot carry: here it is for the whole.';

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
