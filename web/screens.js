// The right side of the page shows one of: the first screen, results, a problem, or that the
// collection is empty; and, above results, what was asked.

import { byId, make } from './dom.js';
import { thumbnailAddress } from './api.js';
import { thumbLink } from './thumb_link.js';
import { counted, duration } from './wording.js';

/** @typedef {import('./api.js').Picture} Picture */
/** @typedef {import('./api.js').Reply} Reply */
/** @typedef {'welcome' | 'results' | 'problem' | 'empty' | 'overview' | 'duplicates'} Screen */

/** A quick answer should not make the progress line flicker. */
const kProgressDelayMs = 150;

export class Screens {
  /** @type {Screen} */ #now = 'welcome';
  #loader;
  #results;
  #panel;
  #progressTimer = 0;
  /** Whether there is a query to be shown above results or a problem. */
  #asked = false;

  /**
   * @param {import('./pictures.js').PictureLoader} loader
   * @param {import('./results.js').Results} results
   * @param {import('./options_panel.js').OptionsPanel} panel
   */
  constructor(loader, results, panel) {
    this.#loader = loader;
    this.#results = results;
    this.#panel = panel;
  }

  get now() {
    return this.#now;
  }

  /** @param {Screen} screen */
  show(screen) {
    this.#now = screen;
    for (const name of ['welcome', 'problem', 'empty', 'overview', 'duplicates']) {
      byId(name, HTMLElement).hidden = name !== screen;
    }
    for (const place of ['overview', 'duplicates']) {
      byId(`to-${place}`, HTMLElement).ariaCurrent = place === screen ? 'page' : null;
    }
    if (screen !== 'results') this.#results.hide();
    if (screen !== 'results' && screen !== 'problem') this.#asked = false;
    byId('query', HTMLElement).hidden = !this.#asked;
  }

  /** @param {boolean} busy */
  set busy(busy) {
    const line = byId('progress', HTMLElement);
    window.clearTimeout(this.#progressTimer);
    if (busy) this.#progressTimer = window.setTimeout(() => (line.hidden = false), kProgressDelayMs);
    else line.hidden = true;
    this.#results.busy = busy;
  }

  /**
   * What is searched for.
   * @param {import('./finder.js').Query} query
   */
  ask({ asked, source, profile, options }) {
    this.#asked = true;
    byId('findings-title', HTMLElement).textContent = asked.title;
    const picture = byId('asked-picture', HTMLImageElement);
    picture.hidden = asked.preview === null && source.kind !== 'id';
    if (asked.preview !== null) {
      picture.dataset.address = '';
      picture.src = asked.preview;
    } else if (source.kind === 'id') {
      void this.#loader.show(picture, thumbnailAddress(source.id));
    }
    byId('paint-over', HTMLElement).hidden = picture.hidden;
    const shared = byId('shared', HTMLElement);
    shared.hidden = asked.shared === null;
    shared.textContent = asked.shared ?? '';
    for (const input of byId('profile', HTMLElement).querySelectorAll('input')) {
      input.checked = input.value === profile;
    }
    this.#panel.show(profile, options, source.kind);
  }

  /** @param {Reply} reply */
  answer(reply) {
    this.show('results');
    const found = counted(reply.searched, 'picture', 'pictures');
    byId('summary', HTMLElement).textContent = `${found} searched in ${duration(reply.took_ms)}`;
    byId('low-information', HTMLElement).hidden = reply.query.low_information !== true;
    byId('none', HTMLElement).hidden = reply.matches.length > 0;
    this.#results.show(reply.matches);
  }

  /**
   * @param {string} title
   * @param {string} text
   * @param {boolean} again whether trying again may help
   */
  problem(title, text, again) {
    this.show('problem');
    byId('problem-title', HTMLElement).textContent = title;
    byId('problem-text', HTMLElement).textContent = text;
    byId('problem-button', HTMLElement).hidden = !again;
    byId('summary', HTMLElement).textContent = '';
    byId('low-information', HTMLElement).hidden = true;
    byId('none', HTMLElement).hidden = true;
  }

  /** @param {number} count pictures in the collection */
  count(count) {
    byId('collection', HTMLElement).textContent = counted(count, 'picture', 'pictures');
    byId('welcome-count', HTMLElement).textContent =
      count > 1 ? `all ${counted(count, 'picture', 'pictures')}` : 'every picture';
  }

  /**
   * @param {Picture[]} pictures
   * @param {(picture: Picture) => void} like
   */
  offer(pictures, like) {
    byId('samples-title', HTMLElement).hidden = pictures.length === 0;
    byId('samples', HTMLElement).replaceChildren(
      ...pictures.map((picture) => make('li', {}, thumbLink(picture, this.#loader, like))),
    );
  }
}
