// Which search is under way: one request at a time, the latest wish wins.
//
// While a request is out, a newer wish waits for it and replaces an older wish that waits.
// A wish about something else (another topic) does not wait: the request is given up.
// Mid-stroke wishes are paced; a finished stroke goes out as soon as the line is free.
// A reply that does not carry the number of the request it answers is stale: it is dropped.

import { Overloaded, TimedOut } from './failures.js';

/**
 * @template Query, Reply
 * @typedef {object} SearchPort
 * @property {(query: Query, seq: number, signal: AbortSignal) => Promise<Reply>} send
 * @property {(query: Query) => void} started
 * @property {(query: Query, reply: Reply) => void} answered
 * @property {(query: Query, error: unknown) => void} failed
 * @property {(query: Query, delayMs: number) => void} delayed the server asked to wait
 */

/** @typedef {{topic: string, settled: boolean}} Wish */
/** @typedef {import('./clock.js').Clock} Clock */

/** Between the starts of two requests during one stroke. */
const kPaceMs = 250;
const kTimeoutMs = 30_000;

/**
 * @template {Wish} Query
 * @template {{seq?: unknown}} Reply
 */
export class Search {
  #port;
  #clock;
  #seq = 0;
  /** @type {Query | null} */ #pending = null;
  /** @type {Query | null} */ #last = null;
  /** @type {{seq: number, query: Query, abort: AbortController} | null} */ #flight = null;
  #startedAt = -Infinity;
  #heldUntil = -Infinity;
  /** @type {number | null} */ #timer = null;

  /**
   * @param {SearchPort<Query, Reply>} port
   * @param {Clock} clock
   */
  constructor(port, clock) {
    this.#port = port;
    this.#clock = clock;
  }

  /** @param {Query} query */
  submit(query) {
    this.#last = query;
    this.#pending = query;
    if (this.#flight && this.#flight.query.topic !== query.topic) this.#giveUp();
    this.#pump();
  }

  /** Repeats the last search, as after the server came back. */
  again() {
    if (this.#last) this.submit(this.#last);
  }

  /** Forgets everything: nothing that is under way will be answered. */
  stop() {
    this.#pending = null;
    this.#last = null;
    this.#giveUp();
    this.#cancelTimer();
  }

  #giveUp() {
    this.#flight?.abort.abort();
    this.#flight = null;
  }

  #pump() {
    this.#cancelTimer();
    if (!this.#pending || this.#flight) return;
    const paced = this.#pending.settled ? -Infinity : this.#startedAt + kPaceMs;
    const wait = Math.max(paced, this.#heldUntil) - this.#clock.now();
    if (wait > 0) {
      this.#timer = this.#clock.setTimeout(() => this.#pump(), wait);
      return;
    }
    const query = this.#pending;
    this.#pending = null;
    void this.#send(query);
  }

  /** @param {Query} query */
  async #send(query) {
    const seq = ++this.#seq;
    const abort = new AbortController();
    this.#flight = { seq, query, abort };
    this.#startedAt = this.#clock.now();
    const deadline = this.#clock.setTimeout(() => {
      this.#land(seq, () => this.#port.failed(query, new TimedOut(kTimeoutMs)));
      abort.abort();
    }, kTimeoutMs);
    this.#port.started(query);
    try {
      const reply = await this.#port.send(query, seq, abort.signal);
      if (Number(reply.seq) !== seq) throw new Error(`the reply is stale (number ${reply.seq})`);
      this.#land(seq, () => this.#port.answered(query, reply));
    } catch (error) {
      this.#land(seq, () => this.#fail(query, error));
    } finally {
      this.#clock.clearTimeout(deadline);
    }
  }

  /**
   * @param {Query} query
   * @param {unknown} error
   */
  #fail(query, error) {
    if (!(error instanceof Overloaded)) return this.#port.failed(query, error);
    this.#heldUntil = this.#clock.now() + error.retryAfterMs;
    this.#pending ??= query;
    this.#port.delayed(query, error.retryAfterMs);
  }

  /**
   * Ends the request if it is still the one under way.
   * @param {number} seq
   * @param {() => void} tell
   */
  #land(seq, tell) {
    if (this.#flight?.seq !== seq) return;
    this.#flight = null;
    tell();
    this.#pump();
  }

  #cancelTimer() {
    if (this.#timer !== null) this.#clock.clearTimeout(this.#timer);
    this.#timer = null;
  }
}
