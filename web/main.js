// The page, put together: every part is made here and told of the others.

import { Api, thumbnailAddress } from './api.js';
import { storeKey, storedKey } from './api_key.js';
import { fitInto } from './canvas/rect.js';
import { Painting } from './canvas/painting.js';
import { wallClock } from './clock.js';
import { Connection } from './connection.js';
import { Details } from './details.js';
import { byId } from './dom.js';
import { Easel } from './easel.js';
import { mosaic, paintMosaic } from './example.js';
import { KeyWanted, Unreachable } from './failures.js';
import { Finder } from './finder.js';
import { Journey } from './journey.js';
import { KeyDialog } from './key_dialog.js';
import { Notices } from './notices.js';
import { Palette } from './palette.js';
import { PictureLoader } from './pictures.js';
import { Results } from './results.js';
import { Sampler } from './sampler.js';
import { Screens } from './screens.js';
import { listenForShortcuts } from './shortcuts.js';
import { Toolbox } from './toolbox.js';
import { listenForPictures } from './upload.js';
import { nameOf } from './wording.js';

const kSamples = 8;
const kPreviewSide = 160;
/** How often the number of pictures is asked for: an empty collection is being watched. */
const kStatusMs = 15_000;
const kEmptyStatusMs = 2_000;

const api = new Api((address, options) => fetch(address, options));
api.key = storedKey(sessionStorage);
const notices = new Notices();
const painting = new Painting(byId('canvas', HTMLCanvasElement));
const toolbox = new Toolbox();
const palette = new Palette();
const easel = new Easel(painting, toolbox, palette, notices.announce);
const loader = new PictureLoader(api);
const results = new Results(loader, {
  like: (match) => find(() => finder.like(match)),
  open: (index) => details.open(results.matches, index),
});
const details = new Details(api, loader, (match) => find(() => finder.like(match)));
const screens = new Screens(loader, results);
const connection = new Connection(() => api.alive(), wallClock, Math.random);
const journey = new Journey(arrive);
const sampler = new Sampler((limit, cursor) => api.pictures(limit, cursor), Math.random);
const live = byId('live', HTMLInputElement);
const keyDialog = new KeyDialog({
  use: (key) => {
    api.key = key;
    storeKey(sessionStorage, key);
    resume();
  },
  decline: () => {
    screens.problem('This server wants a key', 'Without it nothing can be searched.', true);
  },
});
const finder = new Finder({
  api,
  painting,
  screens,
  journey,
  notices,
  connection,
  clock: wallClock,
  askForKey: () => keyDialog.ask(api.key !== null),
});

/** A search that somebody chose, as against one that follows the brush: show its start. */
function find(/** @type {() => void} */ start) {
  example.abort();
  start();
  const findings = byId('findings', HTMLElement);
  if (findings.getBoundingClientRect().top < 0) findings.scrollIntoView();
}

// Painting searches.

/** Restoring a painting from the history is no new search of its own. */
let restoring = false;
painting.addEventListener('change', (event) => {
  if (restoring) return;
  const { settled } = /** @type {CustomEvent<{settled: boolean}>} */ (event).detail;
  if (!painting.empty) {
    if (live.checked) finder.painting(settled);
  } else if (settled && finder.query?.topic === 'painting') {
    goHome();
  }
});

function match() {
  if (painting.empty) notices.tell('Paint something first, or use a picture.');
  else find(() => finder.painting(true));
}

byId('match', HTMLButtonElement).addEventListener('click', match);
live.addEventListener('change', () => {
  notices.announce(live.checked ? 'Searching while you paint' : 'Searching when you press Match');
  if (live.checked && !painting.empty) finder.painting(true);
});

// Pictures search.

listenForPictures((file) => void searchByFile(file));

async function searchByFile(/** @type {File} */ file) {
  const preview = await previewOf(file);
  find(() => finder.file(file, preview));
}

/** A small copy for the page, null where the browser cannot read the file: the server may. */
async function previewOf(/** @type {File} */ file) {
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

byId('profile', HTMLFieldSetElement).addEventListener('change', (event) => {
  if (event.target instanceof HTMLInputElement) finder.compareAs(event.target.value);
});

byId('paint-over', HTMLButtonElement).addEventListener('click', () =>
  attempt(async () => {
    const image = byId('asked-picture', HTMLImageElement);
    await image.decode();
    easel.place(image, image.naturalWidth, image.naturalHeight);
    byId('canvas', HTMLCanvasElement).focus();
  }),
);

// The first screen.

let example = new AbortController();

byId('surprise', HTMLButtonElement).addEventListener('click', () =>
  attempt(async () => {
    const [picture] = await sampler.draw(1, results.matches.map(({ id }) => id));
    if (picture) find(() => finder.like(picture));
  }),
);

byId('example', HTMLButtonElement).addEventListener('click', () =>
  attempt(async () => {
    const [picture] = await sampler.draw(1);
    if (!picture) return;
    const bitmap = await loader.decode(thumbnailAddress(picture.id));
    example.abort();
    example = new AbortController();
    const { signal } = example;
    painting.clear();
    await paintMosaic(painting, mosaic(bitmap), signal);
    if (signal.aborted) return;
    finder.painting(true);
    notices.tell(`Painted from memory of ${nameOf(picture)}`);
  }),
);
byId('canvas', HTMLCanvasElement).addEventListener('pointerdown', () => example.abort(), {
  capture: true,
});

function goHome() {
  finder.stop();
  journey.home();
  welcome();
}

function welcome() {
  screens.show(known === 0 ? 'empty' : 'welcome');
  void attempt(async () => {
    screens.offer(await sampler.draw(kSamples), (picture) => find(() => finder.like(picture)));
  });
}

byId('home', HTMLAnchorElement).addEventListener('click', (event) => {
  if (event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  goHome();
});

// Addresses.

/** @param {import('./journey.js').Visit | null} visit */
function arrive(visit) {
  example.abort();
  if (!visit) {
    finder.stop();
    welcome();
    return;
  }
  if (visit.entry?.painting) void restore(visit.entry.painting);
  finder.visit(visit);
}

/** @param {string} kept data: address of the painting of that entry */
async function restore(kept) {
  if (!painting.empty && finder.keep() === kept) return;
  const image = new Image();
  image.src = kept;
  await image.decode();
  restoring = true;
  easel.place(image, image.naturalWidth, image.naturalHeight);
  restoring = false;
}

byId('share', HTMLButtonElement).addEventListener('click', async () => {
  try {
    await navigator.clipboard.writeText(location.href);
    notices.tell('Link copied');
  } catch {
    // Browsers give the clipboard to secure origins only.
    notices.tell('Copy the link from the address bar: this browser keeps its clipboard closed');
  }
});

// The server.

/** Pictures in the collection, as far as known. */
let known = -1;
let statusTimer = 0;

async function look() {
  window.clearTimeout(statusTimer);
  if (!document.hidden && !connection.lost) {
    await attempt(async () => {
      const { images } = await api.status();
      screens.count(images);
      const filled = known === 0 && images > 0;
      known = images;
      if (images === 0 && screens.now === 'welcome') screens.show('empty');
      if (filled) {
        sampler.forget();
        if (screens.now === 'empty') repeat();
      }
    });
  }
  const delay = screens.now === 'empty' ? kEmptyStatusMs : kStatusMs;
  statusTimer = window.setTimeout(() => void look(), delay);
}

/** Shows again what should be on the screen, now that the server answers. */
function repeat() {
  if (finder.query) finder.again();
  else welcome();
}

function resume() {
  void look();
  repeat();
}

/** Runs what needs the server; where it is not there, or wants a key, says so. */
async function attempt(/** @type {() => Promise<void>} */ run) {
  try {
    await run();
    connection.recover();
  } catch (error) {
    if (error instanceof Unreachable) connection.lose();
    else if (error instanceof KeyWanted) {
      if (!keyDialog.declined) keyDialog.ask(api.key !== null);
    } else notices.tell(error instanceof Error ? error.message : String(error));
  }
}

connection.addEventListener('lost', () => {
  notices.warn('The server does not answer. Your painting is safe; this page keeps trying.');
});
connection.addEventListener('back', () => {
  notices.clear();
  notices.tell('The server is back');
  resume();
});
byId('banner-button', HTMLButtonElement).addEventListener('click', () => void connection.ask());
byId('problem-button', HTMLButtonElement).addEventListener('click', () => {
  keyDialog.forgive();
  repeat();
});
window.addEventListener('online', () => void connection.ask());
document.addEventListener('visibilitychange', () => void look());

// Keys.

const help = byId('help', HTMLDialogElement);
byId('help-button', HTMLButtonElement).addEventListener('click', () => help.showModal());
listenForShortcuts({
  b: () => toolbox.take('brush'),
  e: () => toolbox.take('eraser'),
  g: () => toolbox.take('fill'),
  i: () => toolbox.take('pick'),
  '[': () => toolbox.smaller(),
  ']': () => toolbox.larger(),
  'Ctrl+z': () => painting.undo(),
  'Ctrl+Shift+z': () => painting.redo(),
  'Ctrl+y': () => painting.redo(),
  'Shift+Delete': () => painting.clear(),
  m: match,
  l: () => live.click(),
  '?': () => help.showModal(),
});

arrive(journey.here());
void look();
