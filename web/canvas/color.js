// Colours as the page passes them around: "#rrggbb" outside, [r, g, b, a] bytes inside.

/** @typedef {[number, number, number, number]} Rgba bytes, straight (not premultiplied) */

/**
 * @param {string} hex "#rrggbb"
 * @returns {Rgba} opaque
 */
export function fromHex(hex) {
  if (!isHex(hex)) throw new RangeError(`not a colour of the form #rrggbb: ${hex}`);
  const value = Number.parseInt(hex.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255, 255];
}

/**
 * @param {ArrayLike<number>} rgb the first three are read
 * @returns {string} "#rrggbb", lower case
 */
export function toHex(rgb) {
  const value = (rgb[0] << 16) | (rgb[1] << 8) | rgb[2];
  return `#${value.toString(16).padStart(6, '0')}`;
}

/** @param {string} text */
export function isHex(text) {
  return /^#[0-9a-f]{6}$/i.test(text);
}

/**
 * Relative luminance (WCAG 2): 0 for black, 1 for white. Tells whether a mark on top of a
 * colour should be dark or light.
 * @param {string} hex
 */
export function luminance(hex) {
  const [r, g, b] = fromHex(hex).map((byte) => {
    const c = byte / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
