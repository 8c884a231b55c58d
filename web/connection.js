// Whether the server is there. Once it is lost, this asks again and again, less and less
// often, until it answers.

/** @typedef {import('./clock.js').Clock} Clock */

const kFirstDelayMs = 1000;
const kLongestDelayMs = 15_000;

export class Connection extends EventTarget {
  #alive;
  #clock;
  #random;
  #lost = false;
  #attempt = 0;
  #asking = false;
  /** @type {number | null} */ #timer = null;

  /**
   * @param {() => Promise<boolean>} alive asks the server
   * @param {Clock} clock
   * @param {() => number} random in [0, 1): spreads the pages that lost the same server
   */
  constructor(alive, clock, random) {
    super();
    this.#alive = alive;
    this.#clock = clock;
    this.#random = random;
  }

  get lost() {
    return this.#lost;
  }

  /** A request got no answer. */
  lose() {
    if (this.#lost) return;
    this.#lost = true;
    this.#attempt = 0;
    this.dispatchEvent(new Event('lost'));
    this.#wait();
  }

  /** A request was answered. */
  recover() {
    if (!this.#lost) return;
    this.#lost = false;
    this.#cancelTimer();
    this.dispatchEvent(new Event('back'));
  }

  /** Asks at once, as when the network is back or somebody presses the button. */
  async ask() {
    if (!this.#lost || this.#asking) return;
    this.#cancelTimer();
    this.#asking = true;
    const answered = await this.#alive();
    this.#asking = false;
    if (answered) this.recover();
    else if (this.#lost) this.#wait();
  }

  #wait() {
    const backoff = Math.min(kLongestDelayMs, kFirstDelayMs * 2 ** this.#attempt++);
    const delay = backoff * (0.75 + 0.25 * this.#random());
    this.#timer = this.#clock.setTimeout(() => void this.ask(), delay);
  }

  #cancelTimer() {
    if (this.#timer !== null) this.#clock.clearTimeout(this.#timer);
    this.#timer = null;
  }
}
