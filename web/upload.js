// A picture from outside as the query: chosen, dropped or pasted.

import { fitInto } from './canvas/rect.js';
import { byId } from './dom.js';

const kPreviewSide = 160;

/**
 * A small copy for the page, null where the browser cannot read the file: the server may.
 * @param {File} file
 * @returns {Promise<string | null>} data: address
 */
export async function previewOf(file) {
  try {
    const bitmap = await createImageBitmap(file);
    const canvas = document.createElement('canvas');
    Object.assign(canvas, fitInto(bitmap.width, bitmap.height, kPreviewSide));
    canvas.getContext('2d')?.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
    return canvas.toDataURL('image/png');
  } catch {
    return null;
  }
}

/** @param {(file: File) => void} use */
export function listenForPictures(use) {
  const input = byId('file', HTMLInputElement);
  input.addEventListener('change', () => {
    const file = input.files?.[0];
    input.value = ''; // so that the same file can be chosen again
    if (file) use(file);
  });

  document.addEventListener('paste', (event) => {
    const file = event.clipboardData?.files[0];
    if (!file) return;
    event.preventDefault();
    use(file);
  });

  listenForDrops(use);
}

/** @param {(file: File) => void} use */
function listenForDrops(use) {
  const zone = byId('drop-zone', HTMLElement);
  /** @param {DragEvent} event */
  const carriesFile = (event) => event.dataTransfer?.types.includes('Files') ?? false;

  document.addEventListener('dragover', (event) => {
    if (!carriesFile(event)) return;
    event.preventDefault(); // this is what allows the drop
    zone.hidden = false;
  });
  document.addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) zone.hidden = true; // left the window
  });
  document.addEventListener('drop', (event) => {
    zone.hidden = true;
    const file = event.dataTransfer?.files[0];
    if (!carriesFile(event)) return;
    event.preventDefault(); // else the browser leaves the page for the file
    if (file) use(file);
  });
}
