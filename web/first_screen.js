// The first screen: an invitation, pictures to start from, and an example that paints itself.

import { thumbnailAddress } from './api.js';
import { byId } from './dom.js';
import { mosaic, paintMosaic } from './example.js';
import { nameOf } from './wording.js';

/** @typedef {import('./api.js').Picture} Picture */

const kSamples = 8;

export class FirstScreen {
  #parts;
  #example = new AbortController();

  /**
   * @param {object} parts
   * @param {import('./sampler.js').Sampler} parts.sampler
   * @param {import('./pictures.js').PictureLoader} parts.loader
   * @param {import('./screens.js').Screens} parts.screens
   * @param {import('./canvas/painting.js').Painting} parts.painting
   * @param {import('./notices.js').Notices} parts.notices
   * @param {import('./server_watch.js').ServerWatch} parts.watch
   * @param {(picture: Picture) => void} parts.like
   * @param {() => void} parts.match searches for the painting
   */
  constructor(parts) {
    this.#parts = parts;
    const { watch } = parts;
    byId('surprise', HTMLButtonElement).addEventListener('click', () => {
      void watch.attempt(() => this.#surprise());
    });
    byId('example', HTMLButtonElement).addEventListener('click', () => {
      void watch.attempt(() => this.#paintExample());
    });
  }

  show() {
    const { screens, watch, sampler, like } = this.#parts;
    screens.show(watch.empty ? 'empty' : 'welcome');
    void watch.attempt(async () => screens.offer(await sampler.draw(kSamples), like));
  }

  /** Somebody takes the brush, or looks elsewhere: the example stops where it is. */
  interrupt() {
    this.#example.abort();
  }

  async #surprise() {
    const [picture] = await this.#parts.sampler.draw(1);
    if (picture) this.#parts.like(picture);
  }

  async #paintExample() {
    const { sampler, loader, painting, notices, match } = this.#parts;
    const [picture] = await sampler.draw(1);
    if (!picture) return;
    const bitmap = await loader.decode(thumbnailAddress(picture.id));
    this.interrupt();
    this.#example = new AbortController();
    const { signal } = this.#example;
    painting.clear();
    await paintMosaic(painting, mosaic(bitmap), signal);
    if (signal.aborted) return;
    match();
    notices.tell(`Painted from memory of ${nameOf(picture)}`);
  }
}
