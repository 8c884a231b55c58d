// Keys that work anywhere on the page. Keys of a single letter can be switched off, for those
// who speak to their computer or hit keys by accident (WCAG 2.1.4).

import { byId } from './dom.js';

/** @typedef {Record<string, () => void>} Actions by name of the key, "Shift+", "Ctrl+" before it */

const kSlot = 'haarmony.letter-keys';

/** @param {Actions} actions */
export function listenForShortcuts(actions) {
  const letters = byId('letter-keys', HTMLInputElement);
  letters.checked = localStorage.getItem(kSlot) !== 'off';
  letters.addEventListener('change', () => {
    localStorage.setItem(kSlot, letters.checked ? 'on' : 'off');
  });

  document.addEventListener('keydown', (event) => {
    if (event.defaultPrevented || event.altKey || document.querySelector('dialog[open]')) return;
    if (takesText(event.target)) return;
    const name = nameOfKey(event);
    if (name.length === 1 && !letters.checked) return;
    const action = actions[name];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

/** @param {KeyboardEvent} event */
function nameOfKey(event) {
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  // A sign such as "?" already says whether Shift was held.
  const shifted = event.shiftKey && (event.key.length > 1 || /[a-z]/.test(key));
  const control = event.ctrlKey || event.metaKey;
  return `${control ? 'Ctrl+' : ''}${shifted ? 'Shift+' : ''}${key}`;
}

/** @param {EventTarget | null} target */
function takesText(target) {
  if (target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement) return true;
  const textless = ['radio', 'checkbox', 'range', 'color', 'file', 'button'];
  return target instanceof HTMLInputElement && !textless.includes(target.type);
}
