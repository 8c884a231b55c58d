// Pictures that are in the collection more than once: exactly, nearly, or alike. Somebody
// starts the search for them, says which pairs are none, and may take pictures away, each
// after a question.

import { carrying } from './api.js';
import { byId, make } from './dom.js';
import { Refused } from './failures.js';
import { JobWatch } from './job_watch.js';
import { thumbLink } from './thumb_link.js';
import { counted, decoded, grouped, nameOf, percent } from './wording.js';

/** @typedef {import('./api.js').Picture} Picture */
/** @typedef {import('./address.js').Level} Level the least alike that are shown */
/** @typedef {import('./job_watch.js').Job} Job */
/** @typedef {{level: string, similarity: number, ids: number[], images: Picture[]}} Group */
/** @typedef {{items: Group[], next_cursor?: string | null, as_of?: string | null}} Page */

const kLimit = 20;
const kMoment = new Intl.DateTimeFormat('en', { dateStyle: 'medium', timeStyle: 'short' });
/** @type {Record<string, string>} */
const kLevelNames = { exact: 'The same file', near: 'Nearly the same', similar: 'Alike' };

export class Duplicates {
  #list = byId('duplicate-groups', HTMLOListElement);
  #said = byId('duplicates-said', HTMLElement);
  #more = byId('duplicates-more', HTMLButtonElement);
  #find = byId('duplicates-find', HTMLButtonElement);
  #cancel = byId('duplicates-cancel', HTMLButtonElement);
  #running = byId('duplicates-running', HTMLElement);
  #levels = byId('duplicates-level', HTMLFieldSetElement);
  #parts;
  /** @type {Level} */ #level = 'all';
  /** @type {string | null} */ #cursor = null;
  #asked = 0;
  /** @type {{id: Job['id'], watch: JobWatch} | null} */ #job = null;

  /**
   * @param {object} parts
   * @param {import('./api.js').Api} parts.api
   * @param {import('./pictures.js').PictureLoader} parts.loader
   * @param {import('./server_watch.js').ServerWatch} parts.watch
   * @param {import('./notices.js').Notices} parts.notices
   * @param {import('./question.js').Question} parts.question
   * @param {import('./clock.js').Clock} parts.clock
   * @param {(address: string) => import('./job_watch.js').EventLine} parts.events
   * @param {(picture: Picture) => void} parts.like
   * @param {(level: Level) => void} parts.chosen another level
   */
  constructor(parts) {
    this.#parts = parts;
    this.#levels.addEventListener('change', (event) => {
      if (event.target instanceof HTMLInputElement) {
        parts.chosen(/** @type {Level} */ (event.target.value));
      }
    });
    this.#more.addEventListener('click', () => void this.#read());
    this.#find.addEventListener('click', () => void this.#start());
    this.#cancel.addEventListener('click', () => {
      const job = this.#job;
      if (job) void this.#attempt(() => parts.api.order(`jobs/${job.id}`, { method: 'DELETE' }));
    });
  }

  /** @param {import('./capabilities.js').Capabilities} capabilities */
  offer(capabilities) {
    this.#find.hidden = !capabilities.answers('/jobs', 'post');
  }

  /** @param {Level} level */
  open(level) {
    this.#level = level;
    for (const input of this.#levels.querySelectorAll('input')) input.checked = input.value === level;
    return this.#reload();
  }

  #reload() {
    this.#cursor = null;
    this.#list.replaceChildren();
    this.#more.hidden = true;
    return this.#read();
  }

  async #read() {
    const asked = ++this.#asked;
    const fields = new URLSearchParams({ limit: String(kLimit) });
    if (this.#level !== 'all') fields.set('level', this.#level);
    if (this.#cursor !== null) fields.set('cursor', this.#cursor);
    await this.#attempt(async () => {
      /** @type {Page} */
      const page = await this.#parts.api.json(`duplicates?${fields}`, {});
      if (asked === this.#asked) this.#show(page);
    });
  }

  /** @param {Page} page */
  #show({ items, next_cursor: next = null, as_of: asOf = null }) {
    this.#cursor = next;
    this.#more.hidden = next === null;
    this.#list.append(...items.map((group) => this.#group(group)));
    this.#summarize(asOf);
  }

  /** @param {string | null} asOf when the last search ended */
  #summarize(asOf) {
    const count = this.#list.children.length;
    const when = asOf === null ? '' : `, as of ${kMoment.format(new Date(asOf))}`;
    if (count > 0) {
      const shown = counted(count, 'group', 'groups');
      this.#said.textContent = `${shown}${this.#cursor === null ? '' : ' and more'}${when}`;
    } else {
      const hint = this.#find.hidden ? '' : ' Look for them to be sure.';
      this.#said.textContent = asOf === null ? `None are known.${hint}` : `There are none${when}.`;
    }
  }

  /** @param {Group} group */
  #group({ level, similarity, images }) {
    const heading = make('h3', {}, kLevelNames[level] ?? level);
    const alike = make('p', {}, level === 'exact' ? '' : `${percent(similarity)} similar`);
    const element = make('li', { className: 'duplicate' }, make('div', {}, heading, alike));
    const pictures = make('ul', { className: 'copies' });
    const left = new Map(images.map((picture) => [picture.id, picture]));
    const drop = (/** @type {Picture} */ picture, /** @type {HTMLElement} */ card) => {
      left.delete(picture.id);
      card.remove();
      if (left.size < 2) element.remove();
    };
    for (const picture of images) pictures.append(this.#copy(picture, left, drop));
    element.append(pictures);
    return element;
  }

  /**
   * @param {Picture} picture
   * @param {Map<number, Picture>} left those of its group that are still shown
   * @param {(picture: Picture, card: HTMLElement) => void} drop
   */
  #copy(picture, left, drop) {
    const name = nameOf(picture);
    const size = picture.width && picture.height ? `${picture.width} × ${picture.height}` : '';
    const other = make('button', { type: 'button', className: 'button quiet' }, 'Not a duplicate');
    other.setAttribute('aria-label', `${name} is not a duplicate of the others`);
    const remove = make('button', { type: 'button', className: 'button quiet' }, 'Delete …');
    remove.setAttribute('aria-label', `Delete ${name} …`);
    const title = picture.uri ? decoded(picture.uri) : name;
    const card = make(
      'li',
      {},
      thumbLink(picture, this.#parts.loader, this.#parts.like),
      make('p', { className: 'copy-name', title }, make('b', {}, name), size),
      make('p', { className: 'copy-actions' }, other, remove),
    );
    other.addEventListener('click', () => {
      const others = [...left.keys()].filter((id) => id !== picture.id);
      void this.#settle(other, async () => {
        for (const id of others) {
          const ids = [Math.min(id, picture.id), Math.max(id, picture.id)];
          await this.#parts.api.order('duplicates/ignore', carrying('POST', { ids }));
        }
        drop(picture, card);
        this.#parts.notices.tell(`${name} will not be shown as a duplicate of these again`);
      });
    });
    remove.addEventListener('click', async () => {
      const sure = await this.#parts.question.ask(
        `Delete ${name}?`,
        'It is taken out of the collection and found by no search any more. The file itself stays where it is.',
        'Delete',
      );
      if (!sure) return;
      void this.#settle(remove, async () => {
        await this.#parts.api.order(`images/${picture.id}`, { method: 'DELETE' });
        drop(picture, card);
        this.#parts.notices.tell(`${name} is deleted`);
      });
    });
    return card;
  }

  /**
   * @param {HTMLButtonElement} button is off meanwhile
   * @param {() => Promise<void>} run
   */
  async #settle(button, run) {
    button.disabled = true;
    await this.#parts.watch.attempt(run);
    button.disabled = false;
    if (!button.isConnected) this.#said.focus({ preventScroll: true });
  }

  async #start() {
    if (this.#job) return;
    await this.#attempt(async () => {
      const { api, events, clock } = this.#parts;
      /** @type {Job} */
      const { id } = await api.json('jobs', carrying('POST', { type: 'find_duplicates' }));
      const watch = new JobWatch({
        ask: () => api.json(`jobs/${id}`, {}),
        listen: api.key === null ? () => events(`jobs/${id}/events`) : null,
        clock,
        tell: (job) => this.#follow(job),
        failed: (error) => {
          this.#idle();
          this.#said.textContent = error instanceof Error ? error.message : String(error);
        },
      });
      this.#job = { id, watch };
      this.#find.disabled = true;
      this.#running.hidden = false;
    });
  }

  /** @param {Job} job */
  #follow(job) {
    byId('duplicates-progress', HTMLElement).textContent = progressOf(job);
    if (job.state === 'queued' || job.state === 'running') return;
    this.#idle();
    if (job.state === 'done') void this.#reload();
    else this.#said.textContent = endOf(job);
  }

  #idle() {
    this.#job = null;
    this.#find.disabled = false;
    this.#running.hidden = true;
  }

  /** @param {() => Promise<void>} run whose refusal is told here */
  #attempt(run) {
    return this.#parts.watch.attempt(async () => {
      try {
        await run();
      } catch (error) {
        if (!(error instanceof Refused)) throw error;
        this.#said.textContent = error.message;
      }
    });
  }
}

/** @param {Job} job */
export function progressOf({ state, counts = {}, total, eta_s: eta }) {
  if (state === 'queued') return 'Waiting for its turn …';
  const seen = counts.seen ?? 0;
  const rest = eta ? `, about ${counted(Math.ceil(eta), 'second', 'seconds')} left` : '';
  const done = total ? `${grouped(seen)} of ${counted(total, 'picture', 'pictures')}` : counted(seen, 'picture', 'pictures');
  return `${done} compared${rest}`;
}

/** @param {Job} job one that has ended without being done */
export function endOf({ state, errors = [] }) {
  if (state === 'cancelled') return 'The search was cancelled.';
  const [first] = errors;
  const detail = /** @type {{detail?: unknown} | null} */ (first && typeof first === 'object' ? first : null)?.detail;
  const reason = typeof first === 'string' ? first : detail;
  return `The search failed${reason === undefined ? '' : `: ${reason}`}.`;
}
