// The page, put together: every part is made here and told of the others.

import { Api } from './api.js';
import { storeKey, storedKey } from './api_key.js';
import { Painting } from './canvas/painting.js';
import { wallClock } from './clock.js';
import { Connection } from './connection.js';
import { Details } from './details.js';
import { byId } from './dom.js';
import { Easel } from './easel.js';
import { Features } from './features.js';
import { Finder } from './finder.js';
import { FirstScreen } from './first_screen.js';
import { Journey } from './journey.js';
import { KeyDialog } from './key_dialog.js';
import { Notices } from './notices.js';
import { OptionsPanel } from './options_panel.js';
import { Palette } from './palette.js';
import { PictureLoader } from './pictures.js';
import { Results } from './results.js';
import { Sampler } from './sampler.js';
import { Screens } from './screens.js';
import { ServerWatch } from './server_watch.js';
import { listenForShortcuts } from './shortcuts.js';
import { Toolbox } from './toolbox.js';
import { listenForPictures, previewOf } from './upload.js';

/** @typedef {import('./api.js').Picture} Picture */
/** @typedef {import('./journey.js').Visit} Visit */
/** @typedef {import('./address.js').Stop} Stop */

const api = new Api((address, options) => fetch(address, options));
api.key = storedKey(sessionStorage);
const notices = new Notices();
const connection = new Connection(() => api.alive(), wallClock, Math.random);
const sampler = new Sampler((limit, cursor) => api.pictures(limit, cursor), Math.random);

const canvas = byId('canvas', HTMLCanvasElement);
const painting = new Painting(canvas);
const toolbox = new Toolbox();
const easel = new Easel(painting, toolbox, new Palette(), notices.announce);
const live = byId('live', HTMLInputElement);

const loader = new PictureLoader(api);
const like = (/** @type {Picture} */ picture) => find(() => finder.like(picture));
const results = new Results(loader, {
  like,
  open: (index) => details.open(results.matches, index),
  answer: (match) => void features.answers.give(match),
});
const panel = new OptionsPanel();
const screens = new Screens(loader, results, panel);
const journey = new Journey(arrive);

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
const watch = new ServerWatch({ api, connection, keyDialog, notices, counted, back: resume });
const features = new Features({
  ...{ api, painting, finder, loader, screens, results, panel, notices, watch, like },
  clock: wallClock,
  go: (stop) => {
    firstScreen.interrupt();
    journey.stop(stop);
    arrive(stop);
  },
});
const details = new Details(api, loader, like, features);
const firstScreen = new FirstScreen({
  sampler,
  loader,
  screens,
  painting,
  notices,
  watch,
  like,
  match: () => finder.painting(true),
});

/**
 * A search that somebody chose, as against one that follows the brush: show its start.
 * @param {() => void} start
 */
function find(start) {
  firstScreen.interrupt();
  start();
  const findings = byId('findings', HTMLElement);
  if (findings.getBoundingClientRect().top < 0) findings.scrollIntoView();
}

// A painting searches.

/** Bringing a painting back from the history is no search of its own. */
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
canvas.addEventListener('pointerdown', () => firstScreen.interrupt(), { capture: true });
byId('match', HTMLButtonElement).addEventListener('click', match);
live.addEventListener('change', () => {
  notices.announce(live.checked ? 'Searching while you paint' : 'Searching when you press Match');
  if (live.checked && !painting.empty) finder.painting(true);
});

function match() {
  if (painting.empty) notices.tell('Paint something first, or use a picture.');
  else find(() => finder.painting(true));
}

// A picture searches.

listenForPictures(async (file) => {
  const preview = await previewOf(file);
  find(() => finder.file(file, preview));
});
byId('paint-over', HTMLButtonElement).addEventListener('click', () =>
  watch.attempt(async () => {
    const image = byId('asked-picture', HTMLImageElement);
    await image.decode();
    easel.place(image, image.naturalWidth, image.naturalHeight);
    canvas.focus();
  }),
);
byId('profile', HTMLFieldSetElement).addEventListener('change', (event) => {
  if (event.target instanceof HTMLInputElement) finder.compareAs(event.target.value);
});

// An address searches.

/** @param {Visit | Stop | null} place */
function arrive(place) {
  firstScreen.interrupt();
  if (place && 'shared' in place) {
    if (place.entry?.painting) void restore(place.entry.painting);
    finder.visit(place);
    return;
  }
  finder.stop();
  if (place) features.open(place);
  else firstScreen.show();
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

function goHome() {
  finder.stop();
  journey.home();
  firstScreen.show();
}

byId('home', HTMLAnchorElement).addEventListener('click', (event) => {
  if (event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  goHome();
});
byId('share', HTMLButtonElement).addEventListener('click', async () => {
  try {
    await navigator.clipboard.writeText(location.href);
    notices.tell('Link copied');
  } catch {
    // Browsers give the clipboard to secure origins only.
    notices.tell('Copy the link from the address bar: this browser keeps its clipboard closed');
  }
});

// The server comes and goes, and fills.

/**
 * @param {number} count
 * @param {boolean} filled
 */
function counted(count, filled) {
  screens.count(count);
  if (count === 0 && screens.now === 'welcome') screens.show('empty');
  if (!filled) return;
  sampler.forget();
  if (screens.now === 'empty') repeat();
}

/** Asks again for what should be on the screen. */
function repeat() {
  const place = journey.here();
  if (finder.query) finder.again();
  else if (place && 'screen' in place) features.open(place);
  else firstScreen.show();
}

function resume() {
  void watch.look();
  void features.look();
  repeat();
}

byId('problem-button', HTMLButtonElement).addEventListener('click', () => {
  keyDialog.forgive();
  repeat();
});

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
void watch.look();
void features.look();
