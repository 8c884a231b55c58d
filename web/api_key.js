// The server's key, for as long as the tab lives.

const kSlot = 'haarmony.key';

/** @param {Storage} storage */
export function storedKey(storage) {
  return storage.getItem(kSlot);
}

/**
 * @param {Storage} storage
 * @param {string} key
 */
export function storeKey(storage, key) {
  storage.setItem(kSlot, key);
}
