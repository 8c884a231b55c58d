// Numbers and names as the page says them.

const kCount = new Intl.NumberFormat('en');

/** @param {number} count */
export function grouped(count) {
  return kCount.format(count);
}

/**
 * @param {number} count
 * @param {string} one
 * @param {string} many
 */
export function counted(count, one, many) {
  return `${grouped(count)} ${count === 1 ? one : many}`;
}

/** @param {number} similarity in [0, 1] */
export function percent(similarity) {
  // Only the picture itself is 100 %: anything else would claim too much.
  const rounded = Math.round(similarity * 100);
  return `${similarity < 1 ? Math.min(99, rounded) : 100} %`;
}

/** @param {number} probability */
export function likely(probability) {
  if (probability >= 0.01 && probability < 0.995) return `${Math.round(probability * 100)} %`;
  return probability < 0.01 ? 'less than 1 %' : 'more than 99 %';
}

/** How a query has to be turned to be the match; empty if not at all. */
const kTurns = new Map([
  ['mirror_x', 'mirrored'],
  ['mirror_y', 'flipped'],
  ['turn_90', 'turned 90°'],
  ['turn_180', 'upside down'],
  ['turn_270', 'turned 270°'],
  ['transpose', 'mirrored, 270°'],
  ['anti_transpose', 'mirrored, 90°'],
]);

/** @param {string | undefined} orientation */
export function turned(orientation = 'identity') {
  return kTurns.get(orientation) ?? (orientation === 'identity' ? '' : orientation.replaceAll('_', ' '));
}

/** @param {number} ms */
export function duration(ms) {
  if (ms < 1) return 'less than a millisecond';
  if (ms < 10) return `${ms.toFixed(1)} ms`;
  if (ms < 1000) return `${Math.round(ms)} ms`;
  return `${(ms / 1000).toFixed(1)} s`;
}

/**
 * The file's name of a picture's address, readable.
 * @param {{id: number, uri?: string | null}} picture
 */
export function nameOf({ id, uri }) {
  const last = (uri ?? '').replace(/[?#].*$/, '').split('/').pop() ?? '';
  return decoded(last) || `Picture ${id}`;
}

/**
 * Percent-encoded bytes that are not UTF-8 stay as they are.
 * @param {string} text
 */
export function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}
