// What can go wrong between the page and the server, one class for each thing that the page
// does about it.

/** The server said no: an application/problem+json, or a status without one. */
export class Refused extends Error {
  /**
   * @param {number} status
   * @param {string} detail one sentence for people
   * @param {string} code stable name, empty if there is none
   */
  constructor(status, detail, code) {
    super(detail);
    this.name = 'Refused';
    this.status = status;
    this.code = code;
  }
}

/** It wants a key, or another one. */
export class KeyWanted extends Error {
  name = 'KeyWanted';
}

/** It is busy and says when to come again. */
export class Overloaded extends Error {
  /** @param {number} retryAfterMs */
  constructor(retryAfterMs) {
    super(`the server is busy for ${retryAfterMs} ms`);
    this.name = 'Overloaded';
    this.retryAfterMs = retryAfterMs;
  }
}

/** No answer at all, or one from a proxy whose server is gone. */
export class Unreachable extends Error {
  name = 'Unreachable';
}

/** No answer in time. */
export class TimedOut extends Error {
  /** @param {number} ms */
  constructor(ms) {
    super(`no answer within ${ms / 1000} seconds`);
    this.name = 'TimedOut';
  }
}
