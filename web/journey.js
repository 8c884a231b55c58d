// The browser's history: one entry for each search, so that Back and Forward work and the
// address can be shared. The entries of this tab also keep what the address cannot say: the
// painting itself, or the name of a file.

import { fromFragment, stopFromFragment, stopToFragment, toFragment } from './address.js';

/** @typedef {import('./address.js').Shared} Shared */
/** @typedef {import('./address.js').Stop} Stop a screen that is no search */
/**
 * @typedef {object} Entry
 * @property {string} topic searches of the same topic share an entry
 * @property {string} title
 * @property {string | null} preview data: address of the query picture
 * @property {string | null} painting data: address of the painting that was searched for
 */
/** @typedef {{shared: Shared, entry: Entry | null}} Visit an entry is null for an address from elsewhere */

export class Journey {
  /** @param {(place: Visit | Stop | null) => void} arrive null: the first screen */
  constructor(arrive) {
    window.addEventListener('popstate', () => arrive(this.here()));
  }

  /** @returns {Visit | Stop | null} */
  here() {
    const stop = stopFromFragment(location.hash);
    if (stop) return stop;
    const shared = fromFragment(location.hash);
    return shared && { shared, entry: /** @type {Entry | null} */ (history.state) };
  }

  /**
   * @param {Shared} shared
   * @param {Entry} entry
   */
  record(shared, entry) {
    const here = /** @type {Entry | null} */ (history.state);
    const same = here?.topic === entry.topic;
    if (same) history.replaceState(entry, '', toFragment(shared));
    else history.pushState(entry, '', toFragment(shared));
  }

  /**
   * One entry for each screen, however it is set.
   * @param {Stop} stop
   */
  stop(stop) {
    const fragment = stopToFragment(stop);
    if (location.hash === fragment) return;
    if (stopFromFragment(location.hash)?.screen === stop.screen) history.replaceState(null, '', fragment);
    else history.pushState(null, '', fragment);
  }

  /** Back to the first screen, as a step that can be undone. */
  home() {
    if (location.hash !== '') history.pushState(null, '', location.pathname + location.search);
  }
}
