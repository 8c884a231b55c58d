// How a search may differ from the plain one. Only what differs is kept, so that the plain
// search is {}, sends nothing, and leaves no trace in its address.

/**
 * @typedef {object} Options
 * @property {'mirror' | 'all'} [orientations] how the picture may be turned
 * @property {true} [autocrop] near-uniform borders of the query do not count
 * @property {true} [partial] the query may be a part of the picture
 * @property {'some' | 'much'} [aspect] how much the shape of the picture counts
 * @property {string} [text] words that the stored picture must have
 * @property {string} [tags] separated by commas; all must match
 * @property {string[]} [combine] profiles whose ranks count beside those of the chosen one
 * @property {'worst'} [combineBy] of the ranks, else their mean
 */

/** How the server is asked for an aspect: its weight beside those of the coefficients. At
    `some`, a picture twice as wide loses about as much as by five strong coefficients. */
const kAspectWeights = { some: 5, much: 20 };
export const kProfileName = /^[A-Za-z0-9_.-]{1,64}$/;
const kMostCombined = 7;
const kLongestWords = 500;

/**
 * As the parameters of a query.
 * @param {Options} options
 * @param {string} profile
 * @returns {[string, string][]}
 */
export function parametersOf(options, profile) {
  /** @type {[string, string][]} */
  const found = [];
  if (options.orientations) found.push(['orientations', options.orientations]);
  if (options.autocrop) found.push(['autocrop', 'true']);
  if (options.partial) found.push(['partial', 'true']);
  if (options.aspect) found.push(['aspect_weight', String(kAspectWeights[options.aspect])]);
  if (options.text) found.push(['text', options.text]);
  if (options.tags) found.push(['tags', options.tags]);
  const others = (options.combine ?? []).filter((name) => name !== profile);
  if (others.length > 0) {
    found.push(['combine', [profile, ...others].join(',')]);
    if (options.combineBy) found.push(['combine_by', options.combineBy]);
  }
  return found;
}

/**
 * What can be said of a source: only what is at hand as a picture may be part of another.
 * @param {Options} options
 * @param {import('./api.js').Source['kind']} kind
 * @returns {Options}
 */
export function optionsFor(options, kind) {
  if (kind === 'painting' || kind === 'file') return options;
  const { partial, ...rest } = options;
  return rest;
}

/**
 * @param {Options} options
 * @param {URLSearchParams} fields of an address
 */
export function writeOptions(options, fields) {
  const { orientations, autocrop, partial, aspect, text, tags, combine, combineBy } = options;
  if (orientations) fields.set('orientations', orientations);
  if (autocrop) fields.set('autocrop', 'true');
  if (partial) fields.set('partial', 'true');
  if (aspect) fields.set('aspect', aspect);
  if (text) fields.set('text', text);
  if (tags) fields.set('tags', tags);
  if (combine?.length) fields.set('combine', combine.join(','));
  if (combine?.length && combineBy) fields.set('combine_by', combineBy);
}

/**
 * @param {URLSearchParams} fields of an address
 * @returns {Options | null} null if they say something that no search means
 */
export function readOptions(fields) {
  /** @type {Record<string, unknown>} */
  const found = {};
  /** @type {[string, string, string[]][]} */
  const words = [
    ['orientations', 'orientations', ['mirror', 'all']],
    ['aspect', 'aspect', ['some', 'much']],
    ['combine_by', 'combineBy', ['worst']],
  ];
  for (const [field, name, values] of words) {
    const value = fields.get(field);
    if (value === null) continue;
    if (!values.includes(value)) return null;
    found[name] = value;
  }
  for (const name of ['autocrop', 'partial']) {
    const value = fields.get(name);
    if (value === null) continue;
    if (value !== 'true') return null;
    found[name] = true;
  }
  for (const name of ['text', 'tags']) {
    const value = fields.get(name);
    if (value === null) continue;
    if (value === '' || value.length > kLongestWords) return null;
    found[name] = value;
  }
  const combine = fields.get('combine');
  if (combine !== null) {
    found.combine = combine.split(',');
    if (!isCombination(/** @type {string[]} */ (found.combine))) return null;
  }
  return found;
}

/**
 * How many things differ from the plain search.
 * @param {Options} options
 */
export function countOptions(options) {
  return Object.keys(options).filter((name) => name !== 'combineBy').length;
}

/** @param {string[]} names */
function isCombination(names) {
  if (names.length > kMostCombined || new Set(names).size !== names.length) return false;
  return names.every((name) => kProfileName.test(name));
}
