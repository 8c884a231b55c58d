// The main job with everything real: a gallery is painted by the project's own generator,
// ingested, served; somebody paints a coarse sketch of one of its pictures with the mouse,
// and finds it. Needs HAARMONY_BIN, the folder of the executables.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { chooseColor, chooseSize, keepScreenshot, paintStroke, resultIds } from './support/browser.mjs';
import { browser, page, pictures, server, skip, useGalleryPage } from './support/gallery_page.mjs';

const kPictures = 60;
const kColumns = 6;
const kRows = 4;

useGalleryPage(kPictures);

test('the first screen counts the gallery and offers some of it', { skip }, async () => {
  await page.goto(server.address);
  await page.locator('#collection').getByText(`${kPictures} pictures`).waitFor();
  await page.waitForFunction(() => {
    const images = [...document.querySelectorAll('#samples img')];
    return images.length === 8 && images.every((i) => /** @type {HTMLImageElement} */ (i).naturalWidth > 0);
  });
  await keepScreenshot(page, 'first-screen');
});

test('a sketch in a few blobs finds its picture among the first three', { skip }, async (t) => {
  /** @type {number[]} */
  const ranks = [];
  for (const place of [3, Math.floor(kPictures / 2), kPictures - 4]) {
    const target = pictures[place].id;
    await page.goto('about:blank');
    await page.goto(server.address);
    await paintSketchOf(target);
    const found = await resultIds(page);
    assert.equal(found.length, 20);
    ranks.push(1 + found.indexOf(target));
    await keepScreenshot(page, `painted-${ranks.length}`);
  }
  t.diagnostic(`ranks ${ranks}`);
  assert.ok(ranks.every((rank) => rank >= 1 && rank <= 3), `ranks ${ranks}`);
});

test('undo and redo change the results there and back', { skip }, async () => {
  const painted = await resultIds(page);
  const address = page.url();
  for (let i = 0; i < kColumns * 2; ++i) await page.keyboard.press('Control+z');
  await allAnswered();
  assert.notEqual(page.url(), address);
  assert.notDeepEqual(await resultIds(page), painted);
  for (let i = 0; i < kColumns * 2; ++i) await page.keyboard.press('Control+Shift+Z');
  await allAnswered();
  assert.equal(page.url(), address);
  assert.deepEqual(await resultIds(page), painted);
});

test('a result becomes the next query and finds itself first', { skip }, async () => {
  const found = await resultIds(page);
  await page.locator('.card-picture').nth(7).click();
  await page.waitForURL(new RegExp(`#id=${found[7]}&`));
  assert.equal((await resultIds(page))[0], found[7]);
  assert.equal(await page.locator('#grid .share').first().textContent(), '100 %');
  await keepScreenshot(page, 'more-like-this');
});

test('a shared address shows the same results in another tab', { skip }, async () => {
  for (const step of ['of a picture', 'of a painting']) {
    if (step === 'of a painting') {
      const now = page.url();
      await page.goBack();
      await page.waitForURL((url) => url.href !== now);
      await page.getByRole('heading', { name: 'Like your painting' }).waitFor();
    }
    const found = await resultIds(page);
    const other = await page.context().newPage();
    await other.goto(page.url());
    await other.getByText('You opened a shared search').waitFor();
    await other.locator('#grid > li').nth(19).waitFor();
    assert.deepEqual(await resultIds(other), found, step);
    await other.close();
  }
});

test('an uploaded file of the collection is found, and opens as the original', { skip }, async () => {
  const [file] = server.files.slice(10);
  await page.locator('#file').setInputFiles(file);
  const name = file.split('/').pop() ?? '';
  await page.getByRole('heading', { name: `Like ${name}` }).waitFor();
  assert.equal(await page.locator('#grid .share').first().textContent(), '100 %');
  await page.locator('.card-open').first().focus();
  await page.keyboard.press('Enter');
  await page.locator('#details').getByRole('heading', { name }).waitFor();
  await page.locator('#details-original').waitFor();
  await page.locator('#details-picture[src$="/original"]').waitFor();
  await keepScreenshot(page, 'details');
  await page.keyboard.press('Escape');
});

test('a file that is no picture is refused with the reason', { skip }, async () => {
  const file = { name: 'notes.png', mimeType: 'image/png', buffer: Buffer.from('only words\n') };
  await page.locator('#file').setInputFiles(file);
  await page.getByRole('heading', { name: 'This picture cannot be read' }).waitFor();
  assert.notEqual(await page.locator('#problem-text').textContent(), '');
  await keepScreenshot(page, 'refused');
});

test('when the daemon is killed the page says so, and goes on when it is back', { skip }, async () => {
  await page.goto('about:blank');
  await page.goto(server.address);
  await page.locator('#samples li').first().waitFor();
  await server.stop('SIGKILL');
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  await page.locator('#banner').getByText('The server does not answer').waitFor();
  await keepScreenshot(page, 'server-gone');
  await server.start();
  await page.locator('#grid > li').nth(19).waitFor();
  await page.locator('#banner').waitFor({ state: 'hidden' });
});

test('the page raised no error and broke no rule of its security policy', { skip }, async () => {
  assert.deepEqual(browser?.complaints, []);
  const answer = await fetch(server.address);
  assert.match(answer.headers.get('content-security-policy') ?? '', /default-src 'self'/);
});

/**
 * Paints the mean colours of a picture as blobs, row by row, with real strokes.
 * @param {number} target
 */
async function paintSketchOf(target) {
  const colors = await coarseColors(target);
  const { width, height } = await page.locator('#canvas').evaluate((element) => {
    const canvas = /** @type {HTMLCanvasElement} */ (element);
    return { width: canvas.width / 6, height: canvas.height / 4 };
  });
  await chooseSize(page, Math.ceil(Math.hypot(width, height) * 0.8));
  for (const [i, color] of colors.entries()) {
    const [x, y] = [((i % kColumns) + 0.5) / kColumns, (Math.floor(i / kColumns) + 0.5) / kRows];
    await chooseColor(page, color);
    await paintStroke(page, [[x - 0.03, y - 0.02], [x + 0.03, y + 0.02]]);
  }
  await allAnswered();
}

/** A search starts in the same moment as its stroke ends: when none is under way, all are done. */
async function allAnswered() {
  await page.locator('#grid[aria-busy="false"]').waitFor();
}

/**
 * @param {number} id
 * @returns {Promise<string[]>} mean colours of 6 x 4 cells, row by row
 */
function coarseColors(id) {
  return page.evaluate(
    async ({ id, columns, rows }) => {
      const image = new Image();
      image.src = `images/${id}/thumbnail`;
      await image.decode();
      const canvas = document.createElement('canvas');
      canvas.width = columns * 20;
      canvas.height = rows * 20;
      const context = canvas.getContext('2d');
      if (!context) throw new Error('no context');
      context.drawImage(image, 0, 0, canvas.width, canvas.height);
      const colors = [];
      for (let cell = 0; cell < columns * rows; ++cell) {
        const [x, y] = [(cell % columns) * 20, Math.floor(cell / columns) * 20];
        const { data } = context.getImageData(x, y, 20, 20);
        const hex = [0, 1, 2].map((channel) => {
          let sum = 0;
          for (let i = channel; i < data.length; i += 4) sum += data[i];
          return Math.round(sum / 400).toString(16).padStart(2, '0');
        });
        colors.push(`#${hex.join('')}`);
      }
      return colors;
    },
    { id, columns: kColumns, rows: kRows },
  );
}
