// Random pictures of the collection, for "surprise me" and the first screen. The server lists
// pictures page by page; each draw reads one page more, so that the choice widens with use
// and a large collection is never listed at once.

/** @typedef {import('./api.js').Picture} Picture */
/** @typedef {import('./api.js').PictureList} PictureList */

const kPage = 200;
const kMost = 4000;

export class Sampler {
  #list;
  #random;
  /** @type {Picture[]} */ #pictures = [];
  /** @type {string | null} */ #cursor = null;
  #complete = false;

  /**
   * @param {(limit: number, cursor: string | null) => Promise<PictureList>} list
   * @param {() => number} random in [0, 1)
   */
  constructor(list, random) {
    this.#list = list;
    this.#random = random;
  }

  /**
   * @param {number} count
   * @param {number[]} [except] ids not to choose while there are others
   * @returns {Promise<Picture[]>} different ones, at most `count`
   */
  async draw(count, except = []) {
    await this.#readOn();
    const fresh = this.#pictures.filter(({ id }) => !except.includes(id));
    const urn = fresh.length > 0 ? fresh : [...this.#pictures];
    const drawn = [];
    while (drawn.length < count && urn.length > 0) {
      drawn.push(urn.splice(Math.floor(this.#random() * urn.length), 1)[0]);
    }
    return drawn;
  }

  /** Starts over, as when the collection was empty and no longer is. */
  forget() {
    this.#pictures = [];
    this.#cursor = null;
    this.#complete = false;
  }

  async #readOn() {
    if (this.#complete || this.#pictures.length >= kMost) return;
    const page = await this.#list(kPage, this.#cursor);
    // A row whose file could not be read has no thumbnail and is found by no search.
    this.#pictures.push(...page.items.filter(({ thumbnail }) => thumbnail !== null));
    this.#cursor = page.next_cursor ?? null;
    this.#complete = this.#cursor === null;
  }
}
