// Chromium as the tests start it, and the gestures that they share.

import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('playwright-core').BrowserContextOptions} BrowserContextOptions */

const kArtifacts = fileURLToPath(new URL('../../../build/artifacts/', import.meta.url));

const kArguments = [
  '--no-sandbox',
  '--disable-dev-shm-usage',
  '--disable-gpu',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

/**
 * A browser with a profile of its own, and one page in it.
 * @param {BrowserContextOptions} [options]
 */
export async function openBrowser(options = {}) {
  mkdirSync(kArtifacts, { recursive: true });
  const profile = mkdtempSync(join(tmpdir(), 'haarmony-browser-'));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: kArguments,
    viewport: { width: 1280, height: 800 },
    ...options,
  });
  const page = context.pages()[0] ?? (await context.newPage());
  page.setDefaultTimeout(20_000);
  /** @type {string[]} errors of scripts, and what the content security policy stopped */
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('console', (message) => {
    const text = message.text();
    // A status of 400 or more is logged as well; the tests that cause one look for its effect.
    if (message.type() === 'error' && !text.startsWith('Failed to load resource')) {
      complaints.push(text);
    }
  });
  const close = async () => {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  };
  return { context, page, complaints, close };
}

/**
 * A picture of the page at rest: thumbnails loaded, nothing gliding.
 * @param {Page} page
 * @param {string} name
 */
export async function keepScreenshot(page, name) {
  await page.waitForFunction(() => {
    const visible = [...document.images].filter((image) => image.checkVisibility() && image.src !== '');
    return document.getAnimations().length === 0 && visible.every((image) => image.complete);
  });
  await page.screenshot({ path: `${kArtifacts}${name}.png` });
}

/** @typedef {[number, number]} Share a place on the canvas, in [0, 1] each way */

/**
 * One stroke with the mouse.
 * @param {Page} page
 * @param {Share[]} points
 */
export async function paintStroke(page, points) {
  const box = await page.locator('#canvas').boundingBox();
  if (!box) throw new Error('the canvas is not on the page');
  const places = points.map(([x, y]) => [box.x + x * box.width, box.y + y * box.height]);
  await page.mouse.move(places[0][0], places[0][1]);
  await page.mouse.down();
  for (const [x, y] of places.slice(1)) await page.mouse.move(x, y, { steps: 4 });
  await page.mouse.up();
}

/**
 * @param {Page} page
 * @param {string} hex
 */
export async function chooseColor(page, hex) {
  await page.locator('#custom-color').fill(hex);
}

/**
 * @param {Page} page
 * @param {number} size
 */
export async function chooseSize(page, size) {
  await page.locator('#size').fill(String(size));
}

/**
 * The canvas's pixel at a place.
 * @param {Page} page
 * @param {Share} place
 * @returns {Promise<number[]>} r, g, b, a
 */
export function pixelAt(page, [x, y]) {
  return page.locator('#canvas').evaluate(
    (canvas, share) => {
      const { width, height } = /** @type {HTMLCanvasElement} */ (canvas);
      const context = /** @type {HTMLCanvasElement} */ (canvas).getContext('2d');
      if (!context) throw new Error('no context');
      const [left, top] = [Math.floor(share.x * width), Math.floor(share.y * height)];
      return [...context.getImageData(left, top, 1, 1).data];
    },
    { x, y },
  );
}

/**
 * Ids of the results in their order.
 * @param {Page} page
 * @returns {Promise<number[]>}
 */
export function resultIds(page) {
  return page
    .locator('#grid > li')
    .evaluateAll((cards) => cards.map((card) => Number(/** @type {HTMLElement} */ (card).dataset.id)));
}
