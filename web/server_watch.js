// Whether the server is there, lets the page in, and has pictures. Everything that the page
// asks beside a search runs through attempt(), so that each trouble is told in one place.

import { byId } from './dom.js';
import { KeyWanted, Unreachable } from './failures.js';

const kStatusMs = 15_000;
/** An empty collection is being watched. */
const kEmptyStatusMs = 2_000;

export class ServerWatch {
  #api;
  #connection;
  #keyDialog;
  #notices;
  #counted;
  /** Pictures in the collection; negative before the first answer. */
  #count = -1;
  #timer = 0;

  /**
   * @param {object} parts
   * @param {import('./api.js').Api} parts.api
   * @param {import('./connection.js').Connection} parts.connection
   * @param {import('./key_dialog.js').KeyDialog} parts.keyDialog
   * @param {import('./notices.js').Notices} parts.notices
   * @param {(count: number, filled: boolean) => void} parts.counted told of each count;
   *     `filled`: the collection was empty before
   * @param {() => void} parts.back the server is there again
   */
  constructor({ api, connection, keyDialog, notices, counted, back }) {
    this.#api = api;
    this.#connection = connection;
    this.#keyDialog = keyDialog;
    this.#notices = notices;
    this.#counted = counted;
    connection.addEventListener('lost', () => {
      notices.warn('The server does not answer. Your painting is safe; this page keeps trying.');
    });
    connection.addEventListener('back', () => {
      notices.clear();
      notices.tell('The server is back');
      back();
    });
    byId('banner-button', HTMLButtonElement).addEventListener('click', () => void connection.ask());
    window.addEventListener('online', () => void connection.ask());
    document.addEventListener('visibilitychange', () => void this.look());
  }

  get empty() {
    return this.#count === 0;
  }

  /** Counts the pictures, now and from time to time. */
  async look() {
    window.clearTimeout(this.#timer);
    if (!document.hidden && !this.#connection.lost) {
      await this.attempt(async () => {
        const { images } = await this.#api.status();
        const filled = this.empty && images > 0;
        this.#count = images;
        this.#counted(images, filled);
      });
    }
    window.clearTimeout(this.#timer); // another look may have ended meanwhile
    const delay = this.empty ? kEmptyStatusMs : kStatusMs;
    this.#timer = window.setTimeout(() => void this.look(), delay);
  }

  /** @param {() => Promise<void>} run */
  async attempt(run) {
    try {
      await run();
      this.#connection.recover();
    } catch (error) {
      if (error instanceof Unreachable) this.#connection.lose();
      else if (error instanceof KeyWanted) {
        if (!this.#keyDialog.declined) this.#keyDialog.ask(this.#api.key !== null);
      } else this.#notices.tell(error instanceof Error ? error.message : String(error));
    }
  }
}
