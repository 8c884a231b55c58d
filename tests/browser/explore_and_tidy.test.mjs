// The ways around a collection with everything real: turned pictures, words, explanations, the
// overview, duplicates and answers. Needs HAARMONY_BIN, the folder of the executables.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { chooseSize, keepScreenshot, paintStroke, resultIds } from './support/browser.mjs';
import { browser, page, pictures, server, skip, useGalleryPage } from './support/gallery_page.mjs';

const kPictures = 40;
const kTwins = 2;

useGalleryPage(kPictures, kTwins);

test('a mirrored copy is found when mirrored pictures count, and said to be one', { skip }, async () => {
  await page.goto(server.address);
  await page.locator('#samples li').first().waitFor();
  const { id } = pictures[20];
  await page.locator('#file').setInputFiles({ name: 'mirror.png', mimeType: 'image/png', buffer: await mirrored(id) });
  await page.waitForURL(/signature=/);
  await page.locator('#options summary').click();
  await page.locator('#option-orientations').selectOption('mirror');
  await page.waitForURL(/orientations=mirror/);
  assert.equal((await resultIds(page))[0], id);
  assert.equal(await page.locator('.card-turn').first().textContent(), 'mirrored');
  await keepScreenshot(page, 'real-mirrored');
});

test('why it matches is drawn and counted', { skip }, async () => {
  await page.locator('.card-open').first().focus();
  await page.keyboard.press('Enter');
  await page.locator('#why summary').click();
  await page.waitForFunction(() => {
    const drawn = document.querySelector('.why-picture');
    return drawn instanceof HTMLImageElement && drawn.naturalWidth === 3 * 128 && drawn.naturalHeight === 128;
  });
  const names = await page.locator('#why caption b').allTextContents();
  assert.deepEqual(names, ['Y', 'I', 'Q']);
  const text = (await page.locator('#why-body > p').first().textContent()) ?? '';
  const [, matched, all] = (text.match(/^(\d+) of (\d+) /) ?? []).map(Number);
  assert.ok(matched > all / 2 && matched <= all, text);
  await keepScreenshot(page, 'real-why');
  await page.keyboard.press('Escape');
});

test('a word of a name narrows the search to it', { skip }, async () => {
  await page.locator('#option-text').fill('twin');
  await page.keyboard.press('Enter');
  await page.waitForURL(/text=twin/);
  assert.equal((await resultIds(page)).length, kTwins);
  await page.locator('#options-reset').click();
  await page.locator('#grid > li').nth(19).waitFor();
});

test('a combination, a part, a shape and a border are all understood', { skip }, async () => {
  await page.locator('#option-combine label').first().click();
  await page.waitForURL(/combine=/);
  await page.locator('#option-aspect').selectOption('some');
  await page.waitForURL(/aspect=some/);
  await page.locator('#option-autocrop').check();
  await page.waitForURL(/autocrop=true/);
  await page.locator('#option-partial').check();
  await page.waitForURL(/partial=true/);
  assert.equal(await page.locator('#problem').isHidden(), true);
  assert.match((await page.locator('.card-picture').first().getAttribute('title')) ?? '', /combined rank/);
});

test('the overview holds every picture once', { skip }, async () => {
  await page.goto('about:blank');
  await page.goto(`${server.address}#overview=12`);
  await page.locator('.group').nth(11).waitFor();
  const sizes = await page.locator('.group > :last-child').evaluateAll((labels) =>
    labels.map((label) => Number.parseInt(label.textContent ?? '', 10)),
  );
  assert.equal(sizes.reduce((sum, size) => sum + size, 0), kPictures + kTwins);
  await page.locator('.group button').first().click();
  await keepScreenshot(page, 'real-overview');
});

test('copies are found by the job; a pair that is none is not shown again', { skip }, async () => {
  await page.locator('#to-duplicates').click();
  await page.locator('#duplicates-find').click();
  await page.locator('#duplicates-said').getByText('as of').waitFor();
  await page.locator('#duplicates-level').getByLabel('Exact').check();
  await page.locator('.duplicate').nth(kTwins - 1).waitFor();
  assert.equal(await page.locator('.duplicate').count(), kTwins);
  await keepScreenshot(page, 'real-duplicates');
  await page.getByRole('button', { name: 'is not a duplicate' }).first().click();
  await page.locator('#toast').getByText('will not be shown').waitFor();
  await page.reload();
  await page.getByText(/^1 group/).waitFor();
});

test('a copy can be deleted, and is found no more', { skip }, async () => {
  await page.getByRole('button', { name: /^Delete twin/ }).click();
  await page.locator('#question-yes').click();
  await page.locator('#toast').getByText('is deleted').waitFor();
  const { items } = await (await fetch(`${server.address}images?limit=1000`)).json();
  assert.equal(items.length, kPictures + kTwins - 1);
});

test('an answer is kept as the server reads it', { skip }, async () => {
  await page.goto('about:blank');
  await page.goto(server.address);
  await page.locator('#samples li').first().waitFor();
  await chooseSize(page, 120);
  await paintStroke(page, [[0.1, 0.3], [0.9, 0.6]]);
  await page.waitForURL(/signature=/);
  await page.locator('.card-answer').first().focus();
  await page.keyboard.press('Enter');
  await page.locator('#toast').getByText('Thank you').waitFor();
});

test('the page raised no error and broke no rule of its security policy', { skip }, () => {
  assert.deepEqual(browser?.complaints, []);
});

/**
 * A picture of the collection with left and right exchanged.
 * @param {number} id
 */
async function mirrored(id) {
  const address = await page.evaluate(async (id) => {
    const image = new Image();
    image.src = `images/${id}/original`;
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
    const context = canvas.getContext('2d');
    if (!context) throw new Error('no context');
    context.scale(-1, 1);
    context.drawImage(image, -canvas.width, 0);
    return canvas.toDataURL('image/png');
  }, id);
  return Buffer.from(address.split(',')[1], 'base64');
}
