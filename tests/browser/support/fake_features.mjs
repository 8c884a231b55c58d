// What the fake server knows beyond the plain search: a description of the interface, profiles,
// groups, duplicates with their job, answers and training. Each part can be taken away or made
// to fail, as on an older server.

import { encodePng } from './png.mjs';

/** @typedef {import('./fake_server.mjs').Call} Call */
/** @typedef {import('./fake_server.mjs').Answer} Answer */

const kNames = ['orientations', 'autocrop', 'aspect_weight', 'partial', 'text', 'tags', 'combine', 'combine_by', 'explain'];
const kPaths = {
  '/clusters': ['get'],
  '/duplicates': ['get'],
  '/duplicates/ignore': ['post'],
  '/jobs': ['post'],
  '/feedback': ['post'],
  '/profiles': ['get'],
  '/profiles/{name}/train': ['post'],
};

export class FakeFeatures {
  /** Options of a query that the description lists. */
  options = [...kNames];
  /** @type {Record<string, string[]>} */ paths = kPaths;
  /** Bodies posted to /feedback, to /duplicates/ignore and to .../train, and ids deleted. */
  answers = /** @type {any[]} */ ([]);
  ignored = /** @type {number[][]} */ ([]);
  trained = /** @type {any[]} */ ([]);
  deleted = /** @type {number[]} */ ([]);
  /** States that the job has, one for each time that it is looked at. */
  states = ['queued', 'running', 'done'];
  /** @type {((call: Call) => Answer | null)} may answer in the place of all this */
  instead = () => null;
  found = false;
  #problem;
  #described;

  /**
   * @param {(status: number, code: string, detail: string) => Answer} problem
   * @param {(id: number) => {id: number}} described
   */
  constructor(problem, described) {
    this.#problem = problem;
    this.#described = described;
  }

  /**
   * @param {Call} call
   * @returns {Answer | null} null: not one of these
   */
  answer(call) {
    const instead = this.instead(call);
    if (instead) return instead;
    const { url, method, body } = call;
    const posted = () => JSON.parse(body.toString());
    const path = url.pathname;
    if (path === '/openapi.json') return { status: 200, body: this.#description() };
    if (path === '/profiles') return { status: 200, body: { items: kProfiles } };
    if (path === '/clusters') return { status: 200, body: this.#clusters(Number(url.searchParams.get('count'))) };
    if (path === '/duplicates') return { status: 200, body: this.#duplicates(url.searchParams) };
    if (path === '/feedback') {
      this.answers.push(posted());
      return { status: 201, body: { id: this.answers.length } };
    }
    if (path === '/duplicates/ignore') {
      this.ignored.push(posted().ids);
      return { status: 204 };
    }
    if (path === '/jobs') return { status: 202, headers: { Location: '/jobs/7' }, body: this.#job() };
    if (path === '/jobs/7') return this.#look(method);
    if (path === '/jobs/7/events') return { status: 200, headers: kStream, body: this.#events() };
    if (/^\/profiles\/[^/]+\/train$/.test(path)) return this.#train(path, posted());
    const [, id] = path.match(/^\/images\/(\d+)$/) ?? [];
    if (method !== 'DELETE' || id === undefined) return null;
    this.deleted.push(Number(id));
    return { status: 204 };
  }

  /**
   * A match with what the options of its query add.
   * @template {{rank: number, id: number}} T
   * @param {T} match
   * @param {URLSearchParams} fields
   */
  enrich(match, fields) {
    const turns = ['identity', 'mirror_x', 'turn_90', 'anti_transpose'];
    const turned = fields.has('orientations') ? { orientation: turns[(match.rank - 1) % 4] } : {};
    const combined = fields.has('combine') ? { combined_rank: match.rank + 0.5 } : {};
    const explained = fields.get('explain') === 'true' ? { explain: explanation(match.id) } : {};
    const probability = Math.max(0.001, 0.9 - match.rank / 20);
    return { ...match, ...turned, ...combined, ...explained, probability };
  }

  #description() {
    const parameters = this.options.map((name) => ({ $ref: `#/components/parameters/${name}` }));
    const named = this.options.map((name) => [name, { name, in: 'query', schema: {} }]);
    const paths = Object.entries(this.paths).map(([path, methods]) => [
      path,
      Object.fromEntries(methods.map((method) => [method, {}])),
    ]);
    return {
      paths: { '/query': { get: { parameters } }, ...Object.fromEntries(paths) },
      components: { parameters: Object.fromEntries(named) },
    };
  }

  /** @param {number} count */
  #clusters(count) {
    const clusters = Array.from({ length: Math.min(count, 60) }, (_, i) => {
      const size = i === 1 ? 1 : 3 + (i % 5);
      const members = Array.from({ length: size }, (_, k) => this.#described(1 + ((i + k * 7) % 60)));
      return { representative: members[0], size, members };
    });
    return { clusters };
  }

  /** @param {URLSearchParams} fields */
  #duplicates(fields) {
    if (!this.found) return { items: [], next_cursor: null, as_of: null };
    const level = fields.get('level');
    // A level takes in what is more alike than it.
    const all = kGroups.slice(0, level === null ? 3 : 1 + kGroups.findIndex((group) => group.level === level));
    const from = Number(fields.get('cursor') ?? 0);
    const items = all.slice(from, from + 2).map((group) => ({ ...group, images: group.ids.map(this.#described) }));
    const next = from + 2 < all.length ? String(from + 2) : null;
    return { items, next_cursor: next, as_of: '2026-01-02T03:04:05Z' };
  }

  #job() {
    const state = (this.states.length > 1 && this.states.shift()) || this.states[0];
    if (state === 'done') this.found = true;
    const errors = state === 'failed' ? ['the disk is full'] : [];
    return { id: 7, type: 'find_duplicates', state, counts: { seen: 40 }, total: 60, eta_s: 3, errors };
  }

  /** @param {string} method */
  #look(method) {
    if (method !== 'DELETE') return { status: 200, body: this.#job() };
    this.states = ['cancelled'];
    return { status: 204 };
  }

  /** All that is left of the job, at once. */
  #events() {
    const lines = [];
    do {
      const job = this.#job();
      const kind = kEnds.includes(job.state) ? 'end' : 'progress';
      lines.push(`event: ${kind}\ndata: ${JSON.stringify(job)}\n\n`);
    } while (this.states.length > 1);
    return lines.join('');
  }

  /**
   * @param {string} path
   * @param {any} asked
   */
  #train(path, asked) {
    this.trained.push({ path, ...asked });
    if (this.answers.length < 1) return this.#problem(422, 'too_few_pairs', 'there is 1 pair, and training takes at least 10');
    return {
      status: 200,
      body: {
        weights: [],
        fit: {},
        held_back: {
          pairs: 10,
          before: { median_rank: 6, rank_1: 0.2, top_20: 0.7 },
          after: { median_rank: 2, rank_1: 0.5, top_20: 0.9 },
        },
        better: true,
        stored: true,
      },
    };
  }
}

/** @param {number} id */
function explanation(id) {
  const png = encodePng(384, 128, (x, y) => {
    const wave = Math.sign(Math.sin((x % 128) / (6 + id % 9)) * Math.sin(y / 11));
    return [128 + 60 * wave, 128 + 60 * wave, 128 + 60 * wave];
  });
  const channels = ['Y', 'I', 'Q'].map((channel, c) => ({
    channel,
    average: { query: 0.51 - c / 9, target: 0.48 - c / 8, weight: 5 - c },
    distance: 1.25 * (c + 1),
    bins: [1, 2, 3, 4, 5].map((bin) => ({ bin, weight: 1 / bin, matched: bin + c, missed: 6 - bin })),
    matched: [],
    missed: [],
  }));
  return { variant: 'yiq-standard', channels, picture: `data:image/png;base64,${png.toString('base64')}` };
}

const kEnds = ['done', 'failed', 'cancelled'];
const kStream = { 'Content-Type': 'text/event-stream' };
const kProfiles = [
  { name: 'painted', built_in: true, indexed: 60 },
  { name: 'scanned', built_in: true, indexed: 60 },
  { name: 'painted_lab', built_in: false, indexed: 60 },
  { name: 'scanned_rgb', built_in: false, indexed: 60 },
  { name: 'not_indexed_yet', built_in: false, indexed: 0 },
];
const kGroups = [
  { level: 'exact', similarity: 1, ids: [3, 9] },
  { level: 'near', similarity: 0.93, ids: [4, 12, 31] },
  { level: 'similar', similarity: 0.81, ids: [5, 22] },
];
