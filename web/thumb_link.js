// A small picture of the collection that searches by itself when it is clicked, and is an
// ordinary link for those who want it in a tab of its own.

import { toFragment } from './address.js';
import { thumbnailAddress } from './api.js';
import { make } from './dom.js';
import { nameOf } from './wording.js';

/** @typedef {import('./api.js').Picture} Picture */

/**
 * @param {Picture} picture
 * @param {import('./pictures.js').PictureLoader} loader
 * @param {(picture: Picture) => void} like
 */
export function thumbLink(picture, loader, like) {
  const image = make('img', { alt: '', decoding: 'async' });
  void loader.show(image, thumbnailAddress(picture.id));
  const href = toFragment({ id: picture.id, profile: 'scanned' });
  const link = make('a', { className: 'card-picture', href, title: nameOf(picture) }, image);
  link.setAttribute('aria-label', `Find pictures like ${nameOf(picture)}`);
  link.addEventListener('click', (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    like(picture);
  });
  return link;
}
