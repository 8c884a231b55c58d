// The overview: the collection in groups of pictures that look alike, one picture for each;
// a group opens in place.

import { byId, make } from './dom.js';
import { Refused } from './failures.js';
import { thumbLink } from './thumb_link.js';
import { counted, nameOf } from './wording.js';

/** @typedef {import('./api.js').Picture} Picture */
/** @typedef {{representative: Picture, size: number, members: Picture[]}} Cluster */

/** More thumbnails than these at once help nobody; a search by the picture shows more like it. */
const kShownMembers = 60;

export class Overview {
  #list = byId('clusters', HTMLUListElement);
  #count = byId('overview-count', HTMLSelectElement);
  #said = byId('overview-said', HTMLElement);
  #parts;
  /** The request that was made last: an earlier one that ends later is dropped. */
  #asked = 0;

  /**
   * @param {object} parts
   * @param {import('./api.js').Api} parts.api
   * @param {import('./pictures.js').PictureLoader} parts.loader
   * @param {import('./server_watch.js').ServerWatch} parts.watch
   * @param {(picture: Picture) => void} parts.like
   * @param {(count: number) => void} parts.chosen another number of groups
   */
  constructor(parts) {
    this.#parts = parts;
    this.#count.addEventListener('change', () => parts.chosen(Number(this.#count.value)));
  }

  /** @param {number} count of groups */
  async open(count) {
    const asked = ++this.#asked;
    const known = [...this.#count.options].some(({ value }) => value === String(count));
    if (!known) this.#count.append(make('option', { value: String(count) }, String(count)));
    this.#count.value = String(count);
    this.#list.replaceChildren();
    this.#say('Grouping the collection …');
    await this.#parts.watch.attempt(async () => {
      try {
        /** @type {{clusters: Cluster[]}} */
        const { clusters } = await this.#parts.api.json(`clusters?count=${count}`, {});
        if (asked === this.#asked) this.#show(clusters);
      } catch (error) {
        if (asked === this.#asked) this.#say(error instanceof Refused ? refusal(error) : '');
        if (!(error instanceof Refused)) throw error;
      }
    });
  }

  /** @param {Cluster[]} clusters */
  #show(clusters) {
    const all = clusters.reduce((sum, { size }) => sum + size, 0);
    this.#say(
      clusters.length === 0
        ? 'There is nothing to group yet.'
        : `${counted(all, 'picture', 'pictures')} in ${counted(clusters.length, 'group', 'groups')}`,
    );
    this.#list.replaceChildren(...clusters.flatMap((cluster, i) => this.#group(cluster, i)));
  }

  /**
   * @param {Cluster} cluster
   * @param {number} index
   * @returns {HTMLElement[]} its picture, and below that row its members
   */
  #group({ representative, size, members }, index) {
    const { loader, like } = this.#parts;
    const link = thumbLink(representative, loader, like);
    if (size < 2) return [make('li', { className: 'group' }, link, make('p', {}, '1 picture'))];
    const name = nameOf(representative);
    const inside = make('ul', { className: 'members', id: `members-${index}` });
    const row = make('li', { className: 'group-row', hidden: true }, inside);
    const button = make('button', { type: 'button', className: 'button quiet' }, counted(size, 'picture', 'pictures'));
    button.setAttribute('aria-expanded', 'false');
    button.setAttribute('aria-controls', inside.id);
    button.setAttribute('aria-label', `${counted(size, 'picture', 'pictures')} like ${name}`);
    button.addEventListener('click', () => {
      row.hidden = !row.hidden;
      button.setAttribute('aria-expanded', String(!row.hidden));
      if (row.hidden || inside.children.length > 0) return;
      inside.replaceChildren(
        ...members.slice(0, kShownMembers).map((member) => make('li', {}, thumbLink(member, loader, like))),
      );
      const more = size - inside.children.length;
      if (more > 0) row.append(make('p', {}, `and ${counted(more, 'other', 'others')}`));
    });
    return [make('li', { className: 'group' }, link, button), row];
  }

  /** @param {string} text */
  #say(text) {
    this.#said.textContent = text;
  }
}

/** @param {Refused} error */
function refusal(error) {
  return error.status === 404 ? 'This server gives no overview.' : error.message;
}
