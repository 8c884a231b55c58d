// Pictures of the server in <img> elements. An <img> cannot send a key, so with a key in use
// the page fetches the bytes itself.

/** @typedef {import('./api.js').Api} Api */

export class PictureLoader {
  #api;

  /** @param {Api} api */
  constructor(api) {
    this.#api = api;
  }

  /**
   * @param {HTMLImageElement} image
   * @param {string} address
   */
  async show(image, address) {
    if (image.dataset.address === address) return;
    image.dataset.address = address;
    image.classList.remove('missing');
    image.onerror = () => image.classList.add('missing');
    if (this.#api.key === null) {
      image.src = address;
      return;
    }
    try {
      const bytes = await this.#api.bytes(address);
      if (image.dataset.address !== address) return; // it shows another picture by now
      const local = URL.createObjectURL(bytes);
      image.onload = () => URL.revokeObjectURL(local);
      image.src = local;
    } catch {
      image.classList.add('missing');
    }
  }

  /**
   * @param {string} address
   * @returns {Promise<ImageBitmap>}
   */
  async decode(address) {
    return createImageBitmap(await this.#api.bytes(address));
  }

  /**
   * Opens a picture in a tab of its own although it needs a key.
   * @param {string} address
   */
  async openWithKey(address) {
    const local = URL.createObjectURL(await this.#api.bytes(address));
    window.open(local, '_blank', 'noopener');
  }

  get needsKey() {
    return this.#api.key !== null;
  }
}
