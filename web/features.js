// What this server offers beyond the plain search. It is asked for its description once; each
// part of the page then shows itself, or stays away.

import { Answers, kindOf } from './answers.js';
import { Capabilities } from './capabilities.js';
import { byId } from './dom.js';
import { Duplicates } from './duplicates.js';
import { Refused } from './failures.js';
import { Overview } from './overview.js';
import { Question } from './question.js';
import { StrokeLog } from './stroke_log.js';
import { Training } from './training.js';
import { Why } from './why.js';

/** @typedef {import('./address.js').Stop} Stop */
/** @typedef {import('./api.js').Picture} Picture */
/** @typedef {import('./options_panel.js').Profile} Profile */

/** Groups of an overview that nobody chose. */
export const kGroups = 24;

export class Features {
  #parts;
  #known = false;
  #capabilities = new Capabilities(null);

  /**
   * @param {object} parts
   * @param {import('./api.js').Api} parts.api
   * @param {import('./canvas/painting.js').Painting} parts.painting
   * @param {import('./finder.js').Finder} parts.finder
   * @param {import('./pictures.js').PictureLoader} parts.loader
   * @param {import('./screens.js').Screens} parts.screens
   * @param {import('./results.js').Results} parts.results
   * @param {import('./options_panel.js').OptionsPanel} parts.panel
   * @param {import('./notices.js').Notices} parts.notices
   * @param {import('./server_watch.js').ServerWatch} parts.watch
   * @param {import('./clock.js').Clock} parts.clock
   * @param {(picture: Picture) => void} parts.like
   * @param {(stop: Stop) => void} parts.go to another screen
   */
  constructor(parts) {
    this.#parts = parts;
    const { api, painting, finder, loader, panel, notices, watch, clock, like, go } = parts;
    const log = new StrokeLog(painting, clock);
    this.answers = new Answers({ api, finder, log, notices, watch, storage: localStorage });
    this.why = new Why({ api, finder, watch });
    this.overview = new Overview({
      ...{ api, loader, watch, like },
      chosen: (count) => go({ screen: 'overview', count }),
    });
    this.duplicates = new Duplicates({
      ...{ api, loader, watch, notices, clock, like },
      question: new Question(),
      events: (address) => new EventSource(address),
      chosen: (level) => go({ screen: 'duplicates', level }),
    });
    this.training = new Training({
      ...{ api, answers: this.answers, watch },
      subject: () => ({ base: finder.profile, kind: kindOf(finder.query) }),
      use: (profile) => {
        finder.compareAs(profile);
        void this.#listProfiles(this.#capabilities);
      },
    });
    finder.addEventListener('change', () => this.#refresh());
    panel.addEventListener('change', (event) => {
      finder.narrow(/** @type {CustomEvent} */ (event).detail);
    });
    panel.addEventListener('profile', (event) => {
      finder.compareAs(/** @type {CustomEvent} */ (event).detail);
    });
    for (const [id, stop] of /** @type {[string, Stop][]} */ ([
      ['to-overview', { screen: 'overview', count: kGroups }],
      ['to-duplicates', { screen: 'duplicates', level: 'all' }],
    ])) {
      byId(id, HTMLAnchorElement).addEventListener('click', (event) => {
        if (event.ctrlKey || event.metaKey || event.shiftKey) return;
        event.preventDefault();
        go(stop);
      });
    }
  }

  /** Asks what there is, unless that is known. */
  async look() {
    if (this.#known) return;
    await this.#parts.watch.attempt(async () => {
      const description = await orNothing(this.#parts.api.json('openapi.json', {}));
      this.#known = true;
      await this.#offer(new Capabilities(description));
    });
  }

  /** @param {Stop} stop */
  open(stop) {
    this.#parts.screens.show(stop.screen);
    window.scrollTo(0, 0);
    if (stop.screen === 'overview') void this.overview.open(stop.count);
    else void this.duplicates.open(stop.level);
  }

  /** After each answer of a search. */
  #refresh() {
    this.#parts.results.answerable = this.answers.possible;
    this.training.refresh();
  }

  /** @param {Capabilities} capabilities */
  async #offer(capabilities) {
    this.#capabilities = capabilities;
    byId('to-overview', HTMLElement).hidden = !capabilities.answers('/clusters');
    byId('to-duplicates', HTMLElement).hidden = !capabilities.answers('/duplicates');
    this.answers.offer(capabilities);
    this.why.offer(capabilities);
    this.duplicates.offer(capabilities);
    this.training.offer(capabilities);
    this.#refresh();
    await this.#listProfiles(capabilities);
  }

  /** @param {Capabilities} capabilities */
  async #listProfiles(capabilities) {
    /** @type {{items: Profile[]} | null} */
    const list = capabilities.answers('/profiles') ? await orNothing(this.#parts.api.json('profiles', {})) : null;
    this.#parts.panel.offer(capabilities, list?.items ?? []);
  }
}

/**
 * @template T
 * @param {Promise<T>} asked
 * @returns {Promise<T | null>} null where the server has no such thing
 */
async function orNothing(asked) {
  try {
    return await asked;
  } catch (error) {
    if (error instanceof Refused) return null;
    throw error;
  }
}
