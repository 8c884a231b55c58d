// A search as an address that can be shared: it stands in the fragment, which the browser
// keeps to itself, so that an opaque signature of 1 kB never meets a server's address limit
// before the page asks for it.
//
//   #id=12&profile=scanned      a picture of the collection
//   #signature=...&profile=...  a painting or a file, as the opaque string of its reply

/** @typedef {{id: number, profile: string} | {signature: string, profile: string}} Shared */

const kProfileName = /^[A-Za-z0-9_.-]{1,64}$/;
const kLongestSignature = 8000;

/**
 * @param {Shared} search
 * @returns {string} with the leading '#'
 */
export function toFragment(search) {
  const fields = new URLSearchParams();
  if ('id' in search) fields.set('id', String(search.id));
  else fields.set('signature', search.signature);
  fields.set('profile', search.profile);
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
  if (profile !== null && !kProfileName.test(profile)) return null;
  if (id !== null && signature === null && /^[1-9][0-9]{0,15}$/.test(id)) {
    const number = Number(id);
    if (!Number.isSafeInteger(number)) return null;
    return { id: number, profile: profile ?? 'scanned' };
  }
  if (signature && id === null && signature.length <= kLongestSignature) {
    return { signature, profile: profile ?? 'painted' };
  }
  return null;
}
