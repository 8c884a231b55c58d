// A clock whose hands the test turns.

/** @typedef {import('../../web/clock.js').Clock} Clock */

/** @implements {Clock} */
export class FakeClock {
  #now = 0;
  #next = 1;
  /** @type {Map<number, {at: number, call: () => void}>} */ #timers = new Map();

  now = () => this.#now;

  /** @type {Clock['setTimeout']} */
  setTimeout = (call, ms) => {
    this.#timers.set(this.#next, { at: this.#now + ms, call });
    return this.#next++;
  };

  /** @type {Clock['clearTimeout']} */
  clearTimeout = (timer) => void this.#timers.delete(timer);

  /** Delays until each timer, soonest first. */
  get waiting() {
    return [...this.#timers.values()].map(({ at }) => at - this.#now).sort((a, b) => a - b);
  }

  /**
   * Lets time pass; timers fire in their order.
   * @param {number} ms
   */
  async pass(ms) {
    const end = this.#now + ms;
    for (;;) {
      const due = [...this.#timers].filter(([, { at }]) => at <= end);
      if (due.length === 0) break;
      const [id, { at, call }] = due.reduce((a, b) => (b[1].at < a[1].at ? b : a));
      this.#timers.delete(id);
      this.#now = at;
      call();
      await settle();
    }
    this.#now = end;
  }
}

/** Lets every promise that can settle do so. */
export function settle() {
  return new Promise((resolve) => setImmediate(resolve));
}
