// Time as the page's controllers see it, so that tests can turn the hands.

/**
 * @typedef {object} Clock
 * @property {() => number} now milliseconds, never backwards
 * @property {(call: () => void, ms: number) => number} setTimeout
 * @property {(timer: number) => void} clearTimeout
 */

/** @type {Clock} */
export const wallClock = {
  now: () => performance.now(),
  setTimeout: (call, ms) => globalThis.window.setTimeout(call, ms),
  clearTimeout: (timer) => globalThis.window.clearTimeout(timer),
};
