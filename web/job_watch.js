// Follows a job of the server until it ends: by its events, or by asking again and again where
// events cannot be had. An EventSource cannot send a key.

import { Refused } from './failures.js';

/**
 * @typedef {object} Job
 * @property {number | string} id
 * @property {'queued' | 'running' | 'done' | 'failed' | 'cancelled'} state
 * @property {Record<string, number>} [counts]
 * @property {number | null} [total]
 * @property {number | null} [eta_s]
 * @property {unknown[]} [errors]
 */
/**
 * @typedef {object} EventLine what the page uses of an EventSource
 * @property {(kind: string, listener: (event: any) => void) => void} addEventListener
 * @property {() => void} close
 */

const kPollMs = 1000;
/** The names of the events that carry a job; the second is the last. */
const kEvents = ['progress', 'end'];

/** @param {Job} job */
export function hasEnded({ state }) {
  return state === 'done' || state === 'failed' || state === 'cancelled';
}

export class JobWatch {
  #parts;
  #over = false;
  /** @type {EventLine | null} */ #line = null;
  /** @type {number | null} */ #timer = null;

  /**
   * @param {object} parts
   * @param {() => Promise<Job>} parts.ask
   * @param {(() => EventLine) | null} parts.listen null: there are no events to be had
   * @param {import('./clock.js').Clock} parts.clock
   * @param {(job: Job) => void} parts.tell of each change; the last one has ended
   * @param {(error: unknown) => void} parts.failed the job cannot be followed any more
   */
  constructor(parts) {
    this.#parts = parts;
    if (parts.listen) this.#hear(parts.listen());
    else void this.#poll();
  }

  /** Hears no more of it; the job goes on. */
  stop() {
    this.#over = true;
    this.#line?.close();
    if (this.#timer !== null) this.#parts.clock.clearTimeout(this.#timer);
  }

  /** @param {EventLine} line */
  #hear(line) {
    this.#line = line;
    for (const kind of kEvents) {
      line.addEventListener(kind, (event) => {
        const job = jobIn(event.data);
        if (job) this.#take(job);
      });
    }
    line.addEventListener('error', () => {
      // The line may have ended with the job, or broken: asking tells which.
      line.close();
      this.#line = null;
      void this.#poll();
    });
  }

  async #poll() {
    if (this.#over) return;
    try {
      const job = await this.#parts.ask();
      this.#take(job);
    } catch (error) {
      // Only a refusal is final; a server that is away comes back, and the job with it.
      if (error instanceof Refused && !this.#over) {
        this.stop();
        this.#parts.failed(error);
      }
    }
    if (!this.#over) this.#timer = this.#parts.clock.setTimeout(() => void this.#poll(), kPollMs);
  }

  /** @param {Job} job */
  #take(job) {
    if (this.#over) return;
    if (hasEnded(job)) this.stop();
    this.#parts.tell(job);
  }
}

/**
 * @param {unknown} data
 * @returns {Job | null}
 */
function jobIn(data) {
  try {
    const job = JSON.parse(String(data));
    return typeof job?.state === 'string' ? job : null;
  } catch {
    return null;
  }
}
