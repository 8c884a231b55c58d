// A server that keeps to the contract of the REST interface as far as the page uses it, and
// that can be told to misbehave: slow, out of order, empty, locked, gone. It finds nothing
// by itself: matches come in an order derived from the query, so that tests can predict them.

import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { FakeFeatures } from './fake_features.mjs';
import { encodePng } from './png.mjs';

const kWeb = fileURLToPath(new URL('../../../web/', import.meta.url));
/** What the daemon sends with the page. */
const kContentSecurityPolicy =
  "default-src 'self'; img-src 'self' blob: data:; object-src 'none'; base-uri 'none'; " +
  "form-action 'self'; frame-ancestors 'none'";
/** @type {Record<string, string>} */
const kTypes = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.svg': 'image/svg+xml',
};

/** @typedef {import('node:http').IncomingMessage} IncomingMessage */
/** @typedef {import('node:http').ServerResponse} ServerResponse */
/** @typedef {{method: string, url: URL, headers: import('node:http').IncomingHttpHeaders, body: Buffer}} Call */
/** @typedef {{status: number, headers?: Record<string, string>, body?: unknown}} Answer */

export class FakeServer {
  /** Pictures in the collection. */
  count = 60;
  /** @type {string | null} wanted of every caller but the page and /healthz */
  key = null;
  /** @type {Call[]} every call to /query, in order */
  queries = [];
  /** @type {((call: Call, answer: Answer) => Answer | Promise<Answer>) | null} may change or delay */
  onQuery = null;
  /** @type {((id: number) => Promise<{type: string, bytes: Buffer}>)} */
  picture = async (id) => ({ type: 'image/png', bytes: drawn(id) });
  /** Everything beyond the plain search; null: an older server. @type {FakeFeatures | null} */
  features = new FakeFeatures(problem, described);
  /** Queries that are being answered at this moment, and the most there ever were. */
  inFlight = 0;
  mostInFlight = 0;
  #server = createServer((request, response) => void this.#serve(request, response));
  #port = 0;

  async start() {
    await new Promise((resolve, reject) => {
      this.#server.once('error', reject);
      this.#server.listen(this.#port, '127.0.0.1', () => resolve(undefined));
    });
    const address = this.#server.address();
    if (address === null || typeof address === 'string') throw new Error('no port');
    this.#port = address.port;
    return this;
  }

  /** May be started again: at the same port. */
  async stop() {
    this.#server.closeAllConnections();
    await new Promise((resolve) => this.#server.close(resolve));
  }

  get address() {
    return `http://127.0.0.1:${this.#port}/`;
  }

  /**
   * @param {IncomingMessage} request
   * @param {ServerResponse} response
   */
  async #serve(request, response) {
    const chunks = [];
    for await (const chunk of request) chunks.push(chunk);
    const call = {
      method: request.method ?? 'GET',
      url: new URL(request.url ?? '/', this.address),
      headers: request.headers,
      body: Buffer.concat(chunks),
    };
    const answer = await this.#answer(call);
    const { body = '' } = answer;
    const bytes = Buffer.isBuffer(body) || typeof body === 'string' ? body : JSON.stringify(body);
    response.writeHead(answer.status, {
      'Content-Type': 'application/json',
      'Content-Security-Policy': kContentSecurityPolicy,
      ...answer.headers,
    });
    response.end(call.method === 'HEAD' ? undefined : bytes);
  }

  /**
   * @param {Call} call
   * @returns {Promise<Answer>}
   */
  async #answer(call) {
    const path = call.url.pathname;
    if (path === '/healthz') return { status: 200, body: { status: 'ok' } };
    const page = await pageFile(path);
    if (page) return page;
    if (this.key !== null && call.headers.authorization !== `Bearer ${this.key}`) {
      return problem(401, 'unauthorized', 'this needs an API key');
    }
    const feature = this.features?.answer(call);
    if (feature) return feature;
    if (path === '/query') return this.#query(call);
    if (path === '/status') return { status: 200, body: { images: this.count } };
    if (path === '/images') return { status: 200, body: this.#list(call.url) };
    const [, id, part] = path.match(/^\/images\/(\d+)(?:\/(thumbnail|original))?$/) ?? [];
    if (id === undefined || Number(id) > this.count) return problem(404, 'not_found', `no ${path}`);
    if (part === undefined) return { status: 200, body: described(Number(id)) };
    // Half of the originals are outside the media roots.
    if (part === 'original' && Number(id) % 2 === 0) return problem(404, 'not_found', 'no original');
    const { type, bytes } = await this.picture(Number(id));
    return { status: 200, headers: { 'Content-Type': type }, body: bytes };
  }

  /** @param {Call} call */
  async #query(call) {
    this.queries.push(call);
    this.mostInFlight = Math.max(this.mostInFlight, ++this.inFlight);
    try {
      const answer = this.#found(call);
      return this.onQuery ? await this.onQuery(call, answer) : answer;
    } finally {
      --this.inFlight;
    }
  }

  /**
   * @param {Call} call
   * @returns {Answer}
   */
  #found(call) {
    const { searchParams } = call.url;
    const id = Number(searchParams.get('id') ?? 0);
    if (id > this.count) return problem(404, 'unknown_id', `there is no image ${id}`);
    const [, signed] = (searchParams.get('signature') ?? '').match(/^opaque-(\d+)$/) ?? [];
    const first = id || Number(signed) || 1 + (hash(call) % Math.max(1, this.count));
    const limit = Math.min(this.count, Number(searchParams.get('limit')));
    const plain = Array.from({ length: limit }, (_, i) => ({
      ...described(1 + ((first - 1 + i) % this.count)),
      rank: i + 1,
      distance: i * 1.25,
      similarity: 1 - i / 25,
      orientation: 'identity',
    }));
    const matches = plain.map((match) => this.features?.enrich(match, searchParams) ?? match);
    const signature = searchParams.get('signature') ?? `opaque-${first}`;
    return {
      status: 200,
      body: {
        matches,
        searched: this.count,
        took_ms: 1.25,
        query: { profile: searchParams.get('profile'), m: 60, signature, low_information: false },
        seq: Number(searchParams.get('seq')),
      },
    };
  }

  /** @param {URL} url */
  #list(url) {
    const from = Number(url.searchParams.get('cursor') ?? 0);
    const to = Math.min(this.count, from + Number(url.searchParams.get('limit')));
    const items = Array.from({ length: to - from }, (_, i) => described(from + i + 1));
    return { items, next_cursor: to < this.count ? String(to) : null };
  }
}

/**
 * @param {number} status
 * @param {string} code
 * @param {string} detail
 * @returns {Answer}
 */
export function problem(status, code, detail) {
  return {
    status,
    headers: { 'Content-Type': 'application/problem+json' },
    body: { type: 'about:blank', title: code, status, detail, code, request_id: 'r1' },
  };
}

/** @param {string} path */
async function pageFile(path) {
  const name = normalize(path === '/' ? '/index.html' : path);
  const type = kTypes[extname(name)];
  if (!type || name.includes('..')) return null;
  try {
    return { status: 200, headers: { 'Content-Type': type }, body: await readFile(kWeb + name) };
  } catch {
    return null;
  }
}

/** @param {number} id */
export function described(id) {
  return {
    id,
    uri: `file:///pictures/picture%20${id}.png`,
    width: 64,
    height: 48,
    thumbnail: `/images/${id}/thumbnail`,
    tags: id % 3 === 0 ? ['third', 'multiple'] : [],
    metadata: { camera: 'none' },
  };
}

/** @param {number} id */
function drawn(id) {
  const base = [(id * 53) % 256, (id * 97) % 256, (id * 151) % 256];
  return encodePng(64, 48, (x, y) => base.map((c, i) => (c + (i === 0 ? x * 2 : y * 3)) % 256));
}

/** @param {Call} call what identifies a query, without its number */
function hash({ url, body }) {
  let sum = 0;
  const text = `${url.searchParams.get('signature') ?? ''}${body.toString('latin1')}`;
  for (let i = 0; i < text.length; ++i) sum = (sum * 31 + text.charCodeAt(i)) >>> 0;
  return sum;
}
