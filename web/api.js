// The server's REST interface, as far as the page needs it. Every address is relative to the
// page, so that both may live below a prefix of a proxy.

import { KeyWanted, Overloaded, Refused, Unreachable } from './failures.js';
import { optionsFor, parametersOf } from './search_options.js';

/**
 * @typedef {object} Picture
 * @property {number} id
 * @property {string | null} [uri]
 * @property {string | null} [thumbnail]
 * @property {number} [width]
 * @property {number} [height]
 * @property {string[]} [tags]
 * @property {Record<string, unknown>} [metadata]
 */
/**
 * @typedef {object} Finding how a picture was found
 * @property {number} rank
 * @property {number} distance
 * @property {number} similarity
 * @property {string} [orientation]
 * @property {number} [combined_rank]
 * @property {number} [probability]
 * @property {import('./explanation.js').Explanation} [explain]
 */
/** @typedef {Picture & Finding} Match */
/**
 * @typedef {object} Reply
 * @property {Match[]} matches
 * @property {number} searched
 * @property {number} took_ms
 * @property {{profile: string, signature: string, low_information?: boolean}} query
 * @property {unknown} [seq]
 */
/** @typedef {{items: Picture[], next_cursor?: string | null}} PictureList */
/**
 * @typedef {{kind: 'painting', png: () => Promise<Blob>}
 *   | {kind: 'file', file: File}
 *   | {kind: 'id', id: number}
 *   | {kind: 'signature', signature: string}} Source
 */

/**
 * @typedef {object} Asking
 * @property {string} profile
 * @property {number} limit
 * @property {number} [seq]
 * @property {import('./search_options.js').Options} [options]
 * @property {boolean} [explain]
 */

/** Without Retry-After, an overloaded server is left alone for a moment. */
const kRetryMs = 1000;
/** What proxies answer for a server that is not there. */
const kGoneStatuses = [502, 504];

export class Api {
  #fetch;
  /** @type {string | null} */ key = null;

  /** @param {(address: string, options: RequestInit) => Promise<Response>} fetch */
  constructor(fetch) {
    this.#fetch = fetch;
  }

  /**
   * @param {Source} source
   * @param {Asking} asking
   * @param {AbortSignal} [signal]
   * @returns {Promise<Reply>}
   */
  async query(source, { profile, limit, seq, options = {}, explain = false }, signal) {
    const fields = new URLSearchParams();
    if (source.kind === 'id') fields.set('id', String(source.id));
    if (source.kind === 'signature') fields.set('signature', source.signature);
    fields.set('profile', profile);
    fields.set('limit', String(limit));
    if (seq !== undefined) fields.set('seq', String(seq));
    for (const [name, value] of parametersOf(optionsFor(options, source.kind), profile)) {
      fields.set(name, value);
    }
    if (explain) fields.set('explain', 'true');
    const address = `query?${fields}`;
    if (source.kind === 'painting') {
      const png = await source.png();
      const headers = { 'Content-Type': 'image/png' };
      return this.json(address, { method: 'POST', body: png, headers, signal });
    }
    if (source.kind === 'file') {
      const form = new FormData();
      form.set('file', source.file, source.file.name || 'picture');
      return this.json(address, { method: 'POST', body: form, signal });
    }
    return this.json(address, { signal });
  }

  /**
   * @param {number} limit
   * @param {string | null} cursor
   * @returns {Promise<PictureList>}
   */
  pictures(limit, cursor) {
    const fields = new URLSearchParams({ limit: String(limit) });
    if (cursor !== null) fields.set('cursor', cursor);
    return this.json(`images?${fields}`, {});
  }

  /**
   * @param {number} id
   * @returns {Promise<Picture>}
   */
  picture(id) {
    return this.json(`images/${id}`, {});
  }

  /** @returns {Promise<{images: number}>} */
  status() {
    return this.json('status', {});
  }

  /** Whether the server answers at all; needs no key. */
  async alive() {
    try {
      return (await this.#fetch('healthz', { cache: 'no-store' })).ok;
    } catch {
      return false;
    }
  }

  /**
   * @param {string} address
   * @returns {Promise<Blob>}
   */
  async bytes(address) {
    return (await this.#send(address, {})).blob();
  }

  /**
   * The type of what is stored there, null if there is nothing.
   * @param {string} address
   * @returns {Promise<string | null>}
   */
  async typeOf(address) {
    try {
      const response = await this.#send(address, { method: 'HEAD' });
      return response.headers.get('Content-Type') ?? '';
    } catch (error) {
      if (error instanceof Refused) return null;
      throw error;
    }
  }

  /**
   * What the server answers there, of the shape that the caller knows.
   * @param {string} address
   * @param {RequestInit} options
   * @returns {Promise<any>}
   */
  async json(address, options) {
    const response = await this.#send(address, options);
    try {
      return await response.json();
    } catch (error) {
      // The connection can break in the middle of an answer as well.
      throw new Unreachable(`the answer broke off: ${error}`);
    }
  }

  /**
   * Asks for something to be done whose answer says nothing more.
   * @param {string} address
   * @param {RequestInit} options
   */
  async order(address, options) {
    await this.#send(address, options);
  }

  /**
   * @param {string} address
   * @param {RequestInit} options
   * @returns {Promise<Response>} one that is ok
   */
  async #send(address, options) {
    const headers = new Headers(options.headers);
    if (this.key !== null) headers.set('Authorization', `Bearer ${this.key}`);
    let response;
    try {
      response = await this.#fetch(address, { ...options, headers });
    } catch (error) {
      throw new Unreachable(String(error));
    }
    if (response.ok) return response;
    throw await failureOf(response);
  }
}

/**
 * A request that carries a JSON document.
 * @param {string} method
 * @param {unknown} document
 * @returns {RequestInit}
 */
export function carrying(method, document) {
  return { method, headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(document) };
}

/** @param {number} id */
export function thumbnailAddress(id) {
  return `images/${id}/thumbnail`;
}

/** @param {number} id */
export function originalAddress(id) {
  return `images/${id}/original`;
}

/** @param {Response} response */
async function failureOf(response) {
  if (response.status === 401) return new KeyWanted(`status ${response.status}`);
  if (kGoneStatuses.includes(response.status)) return new Unreachable(`status ${response.status}`);
  if (response.status === 503 || response.status === 429) {
    return new Overloaded(retryAfterMs(response.headers.get('Retry-After')));
  }
  let detail = `The server answered with status ${response.status}.`;
  let code = '';
  try {
    const problem = await response.json();
    detail = String(problem.detail || problem.title || detail);
    code = String(problem.code ?? '');
  } catch {
    // No problem document: the status has to do.
  }
  return new Refused(response.status, detail, code);
}

/** @param {string | null} header in seconds */
function retryAfterMs(header) {
  const seconds = Number.parseFloat(header ?? '');
  return seconds > 0 ? seconds * 1000 : kRetryMs;
}
