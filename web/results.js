// The pictures found, best first, in row-major order. A card that stays is moved, not made
// anew, so that results glide to their new places while somebody paints.

import { thumbnailAddress } from './api.js';
import { toFragment } from './address.js';
import { byId, icon, make } from './dom.js';
import { likely, nameOf, percent, turned } from './wording.js';

/** @typedef {import('./api.js').Match} Match */
/**
 * @typedef {object} CardPort
 * @property {(match: Match) => void} like
 * @property {(index: number) => void} open
 * @property {(match: Match) => void} answer this is the picture that was looked for
 */

const kGlideMs = 180;

export class Results {
  #grid = byId('grid', HTMLOListElement);
  /** @type {Map<number, Card>} */ #cards = new Map();
  /** @type {Match[]} */ matches = [];
  #loader;
  #port;

  /**
   * @param {import('./pictures.js').PictureLoader} loader
   * @param {CardPort} port
   */
  constructor(loader, port) {
    this.#loader = loader;
    this.#port = port;
  }

  /** @param {Match[]} matches */
  show(matches) {
    const places = this.#places();
    this.matches = matches;
    const cards = this.#cardsFor(matches, places);
    this.#cards = new Map(matches.map((match, i) => [match.id, cards[i]]));
    cards.forEach((card, i) => card.fill(matches[i], i, this.#port));
    const focused = document.activeElement;
    cards.forEach((card, i) => {
      const at = this.#grid.children[i];
      if (at !== card.element) this.#grid.insertBefore(card.element, at ?? null);
    });
    while (this.#grid.children.length > cards.length) this.#grid.lastElementChild?.remove();
    this.#grid.hidden = false;
    // An element that is moved loses the focus.
    if (focused instanceof HTMLElement && this.#grid.contains(focused)) {
      focused.focus({ preventScroll: true });
    }
    this.#glide(places);
  }

  /**
   * The card of a picture that is still there, else one that has become free, else a new one.
   * @param {Match[]} matches
   * @param {Map<Card, DOMRect>} places loses the cards that change their picture
   */
  #cardsFor(matches, places) {
    const ids = new Set(matches.map(({ id }) => id));
    const free = [...this.#cards].filter(([id]) => !ids.has(id)).map(([, card]) => card);
    for (const card of free) places.delete(card);
    return matches.map(({ id }) => this.#cards.get(id) ?? free.pop() ?? new Card(this.#loader));
  }

  /** @param {boolean} answerable whether a match can be called the one that was looked for */
  set answerable(answerable) {
    this.#grid.classList.toggle('answerable', answerable);
  }

  hide() {
    this.#grid.hidden = true;
  }

  /** @param {boolean} busy */
  set busy(busy) {
    this.#grid.setAttribute('aria-busy', String(busy));
  }

  /** @returns {Map<Card, DOMRect>} */
  #places() {
    if (this.#grid.hidden || matchMedia('(prefers-reduced-motion: reduce)').matches) {
      return new Map();
    }
    const cards = [...this.#cards.values()];
    return new Map(cards.map((card) => [card, card.element.getBoundingClientRect()]));
  }

  /** @param {Map<Card, DOMRect>} places */
  #glide(places) {
    for (const card of this.#cards.values()) {
      const from = places.get(card);
      if (!from) continue;
      const to = card.element.getBoundingClientRect();
      const [dx, dy] = [from.left - to.left, from.top - to.top];
      if (dx === 0 && dy === 0) continue;
      card.element.animate(
        [{ transform: `translate(${dx}px, ${dy}px)` }, { transform: 'none' }],
        { duration: kGlideMs, easing: 'cubic-bezier(.2, .7, .2, 1)' },
      );
    }
  }
}

class Card {
  #link = make('a', { className: 'card-picture' });
  #open = make('button', { type: 'button', className: 'card-open' }, icon('open'));
  #answer = make('button', { type: 'button', className: 'card-answer' }, icon('found'));
  #turn = make('span', { className: 'card-turn' });
  #meter = make('span', { className: 'meter' });
  #share = make('span', { className: 'share' });
  #loader;

  /** @param {import('./pictures.js').PictureLoader} loader */
  constructor(loader) {
    this.#loader = loader;
    const caption = make('p', { className: 'caption' }, this.#meter, this.#share);
    caption.setAttribute('aria-hidden', 'true'); // the link says it
    this.element = make('li', { className: 'card' }, this.#link, this.#answer, this.#open, caption);
  }

  /**
   * @param {Match} match
   * @param {number} index
   * @param {CardPort} port
   */
  fill(match, index, { like, open, answer }) {
    const name = nameOf(match);
    const similarity = percent(match.similarity);
    const turn = turned(match.orientation);
    if (this.element.dataset.id !== String(match.id)) this.#picture(match.id);
    this.#link.href = toFragment({ id: match.id, profile: 'scanned' });
    const known = [name, turn, ...furtherScores(match)].filter((text) => text !== '');
    this.#link.title = `${known.join(', ')}: find more like this`;
    const said = [`${match.rank}. ${name}`, `${similarity} similar`, turn].filter((text) => text !== '');
    this.#link.setAttribute('aria-label', `${said.join(', ')}. Find more like it`);
    this.#turn.textContent = turn;
    this.#turn.hidden = turn === '';
    this.#link.onclick = (event) => {
      // With a modifier it is an ordinary link, for a tab of its own.
      if (event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return;
      event.preventDefault();
      like(match);
    };
    this.#open.title = `Open ${name}`;
    this.#open.setAttribute('aria-label', `Open ${name}`);
    this.#open.onclick = () => open(index);
    this.#answer.title = 'This is it';
    this.#answer.setAttribute('aria-label', `This is it: ${name} is what I was looking for`);
    this.#answer.onclick = () => answer(match);
    this.#meter.style.setProperty('--similarity', String(match.similarity));
    this.#share.textContent = similarity;
  }

  /**
   * A new image: one that is reused would show its old picture until the new one is here.
   * @param {number} id
   */
  #picture(id) {
    this.element.dataset.id = String(id);
    const image = make('img', { alt: '', decoding: 'async', draggable: false });
    this.#link.replaceChildren(image, this.#turn);
    void this.#loader.show(image, thumbnailAddress(id));
  }
}

/**
 * The scores that not every search has.
 * @param {Match} match
 * @returns {string[]}
 */
function furtherScores({ combined_rank: combined, probability }) {
  const scores = [];
  if (combined !== undefined) scores.push(`combined rank ${Math.round(combined * 10) / 10}`);
  if (probability !== undefined) scores.push(`${likely(probability)} likely to be meant`);
  return scores;
}
