// A place of the page as an address that can be shared: it stands in the fragment, which the
// browser keeps to itself, so that an opaque signature of 1 kB never meets a server's address
// limit before the page asks for it.
//
//   #id=12&profile=scanned      a picture of the collection
//   #signature=...&profile=...  a painting or a file, as the opaque string of its reply
//   &orientations=mirror&...    how the search differs from the plain one
//   #overview=24                the collection in 24 groups
//   #duplicates=near            pictures that are there more than once, at least so alike

import { kProfileName, readOptions, writeOptions } from './search_options.js';

/** @typedef {import('./search_options.js').Options} Options */
/** @typedef {({id: number} | {signature: string}) & {profile: string, options?: Options}} Shared */
/** @typedef {'exact' | 'near' | 'all'} Level */
/** @typedef {{screen: 'overview', count: number} | {screen: 'duplicates', level: Level}} Stop */

const kLongestSignature = 8000;
const kMostGroups = 100;
/** @type {Level[]} */
const kLevels = ['all', 'near', 'exact'];

/**
 * @param {Shared} search
 * @returns {string} with the leading '#'
 */
export function toFragment(search) {
  const fields = new URLSearchParams();
  if ('id' in search) fields.set('id', String(search.id));
  else fields.set('signature', search.signature);
  fields.set('profile', search.profile);
  writeOptions(search.options ?? {}, fields);
  return `#${fields}`;
}

/**
 * @param {string} fragment with or without the leading '#'
 * @returns {Shared | null} null if it is not the address of a search
 */
export function fromFragment(fragment) {
  const fields = new URLSearchParams(fragment.replace(/^#/, ''));
  const id = fields.get('id');
  const signature = fields.get('signature');
  const profile = fields.get('profile');
  const options = readOptions(fields);
  if (options === null || (profile !== null && !kProfileName.test(profile))) return null;
  if (id !== null && signature === null && /^[1-9][0-9]{0,15}$/.test(id)) {
    const number = Number(id);
    if (!Number.isSafeInteger(number)) return null;
    return { id: number, profile: profile ?? 'scanned', options };
  }
  if (signature && id === null && signature.length <= kLongestSignature) {
    return { signature, profile: profile ?? 'painted', options };
  }
  return null;
}

/** @param {Stop} stop */
export function stopToFragment(stop) {
  return stop.screen === 'overview' ? `#overview=${stop.count}` : `#duplicates=${stop.level}`;
}

/**
 * @param {string} fragment with or without the leading '#'
 * @returns {Stop | null} null if it is not the address of a screen
 */
export function stopFromFragment(fragment) {
  const [, screen, value] = fragment.match(/^#?(overview|duplicates)=([a-z]+|[1-9][0-9]{0,2})$/) ?? [];
  if (screen === 'overview') {
    const count = Number(value);
    return count >= 1 && count <= kMostGroups ? { screen, count } : null;
  }
  const level = kLevels.find((each) => each === value);
  return screen === 'duplicates' && level ? { screen, level } : null;
}
