// What the page says and does when something is wrong: each trouble is made for real.

import assert from 'node:assert/strict';
import { afterEach, beforeEach, test } from 'node:test';
import { openBrowser, paintStroke } from './support/browser.mjs';
import { browser, page, server, useFakePage } from './support/fake_page.mjs';
import { problem } from './support/fake_server.mjs';

useFakePage();
beforeEach(async () => {
  server.count = 60;
  await page.goto('about:blank');
  await page.goto(server.address);
  await page.locator('#samples li').first().waitFor();
});
afterEach(async () => {
  server.onQuery = null;
  server.key = null;
  await page.evaluate(() => sessionStorage.clear());
});

test('an empty collection says how to fill it, and the page notices when it is filled', async () => {
  server.count = 0;
  await page.goto('about:blank');
  await page.goto(server.address);
  await page.getByText('The collection is empty.').waitFor();
  await page.getByText('script/server FOLDER').waitFor();
  await page.getByText('haarmony-ingest --db FILE PATH').waitFor();
  server.count = 12;
  await page.locator('#samples li').first().waitFor();
  assert.equal(await page.locator('#collection').textContent(), '12 pictures');
});

test('painting in an empty collection searches as soon as there is something', async () => {
  server.count = 0;
  await page.goto('about:blank');
  await page.goto(server.address);
  await page.getByText('The collection is empty.').waitFor();
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  server.count = 12;
  await page.locator('#grid > li').nth(11).waitFor();
});

test('a lost server is told, and found again without help', async () => {
  await server.stop();
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  await page.locator('#banner').getByText('The server does not answer').waitFor();
  await server.start();
  await page.locator('#grid > li').nth(19).waitFor();
  await page.locator('#banner').waitFor({ state: 'hidden' });
});

test('the button of the banner does not wait for the next attempt', async (t) => {
  // Where the clock stands still no attempt is made by itself; it stands in all of a browser.
  const { page: frozen, close } = await openBrowser();
  t.after(close);
  await frozen.clock.install({ time: 0 });
  await frozen.goto(server.address);
  await frozen.locator('#samples li').first().waitFor();
  await frozen.locator('#live').uncheck();
  await paintStroke(frozen, [[0.1, 0.1], [0.9, 0.9]]);
  await frozen.clock.pauseAt(3_600_000);
  await server.stop();
  await frozen.locator('#match').click();
  await frozen.locator('#banner').waitFor();
  await server.start();
  // By the keyboard: where the clock stands still the banner may stand halfway in.
  await frozen.locator('#banner-button').press('Enter');
  await frozen.locator('#grid > li').nth(19).waitFor();
});

test('the results stay while the server is away', async () => {
  await page.locator('#samples a').first().click();
  await page.locator('#grid > li').nth(19).waitFor();
  await server.stop();
  await page.locator('.card-picture').nth(4).click();
  await page.locator('#banner').waitFor();
  assert.equal(await page.locator('#grid > li').count(), 20);
  assert.equal(await page.locator('#grid').isVisible(), true);
  await server.start();
  await page.locator('#banner').waitFor({ state: 'hidden' });
});

test('a file that is no picture is refused in the words of the server', async () => {
  server.onQuery = () => problem(415, 'unsupported', 'the bytes look like text/plain');
  const file = { name: 'notes.txt', mimeType: 'text/plain', buffer: Buffer.from('no picture') };
  await page.locator('#file').setInputFiles(file);
  await page.getByRole('heading', { name: 'This picture cannot be read' }).waitFor();
  await page.locator('#problem').getByText('the bytes look like text/plain').waitFor();
  assert.equal(await page.locator('#problem-button').isHidden(), true);
  server.onQuery = null;
  await page.locator('#file').setInputFiles(file);
  await page.locator('#grid > li').nth(19).waitFor();
  assert.equal(await page.locator('#problem').isHidden(), true);
});

test('too large, broken and vanished pictures are told apart', async () => {
  const file = { name: 'a.png', mimeType: 'image/png', buffer: Buffer.from('x') };
  for (const [status, title] of /** @type {[number, string][]} */ ([
    [413, 'This picture is too large'],
    [422, 'This picture cannot be read'],
    [403, 'The server does not allow this'],
  ])) {
    server.onQuery = () => problem(status, 'code', `detail of ${status}`);
    await page.locator('#file').setInputFiles(file);
    await page.getByRole('heading', { name: title }).waitFor();
    await page.locator('#problem').getByText(`detail of ${status}`).waitFor();
  }
  server.onQuery = null;
  await page.goto(`${server.address}#id=999`);
  await page.getByRole('heading', { name: 'This picture is no longer in the collection' }).waitFor();
});

test('an address that the server cannot read says so', async () => {
  server.onQuery = () => problem(400, 'bad_signature', 'the signature is cut off');
  await page.goto(`${server.address}#signature=abc`);
  await page.getByRole('heading', { name: 'This address cannot be read' }).waitFor();
});

test('a failure of the server can be tried again', async () => {
  server.onQuery = () => problem(500, 'internal', 'something broke');
  await page.locator('#samples a').first().click();
  await page.locator('#problem').getByText('something broke').waitFor();
  server.onQuery = null;
  await page.locator('#problem-button').click();
  await page.locator('#grid > li').nth(19).waitFor();
});

test('a busy server is asked again when it said', async () => {
  let calls = 0;
  server.onQuery = (_, answer) =>
    ++calls > 1 ? answer : { ...problem(503, 'busy', 'queue full'), headers: { 'Retry-After': '1' } };
  await page.locator('#samples a').first().click();
  await page.locator('#grid > li').nth(19).waitFor();
  assert.equal(calls, 2);
});

test('a server with a key asks for it, refuses a wrong one, and keeps a right one', async () => {
  server.key = 'secret';
  await page.goto('about:blank');
  await page.goto(server.address);
  await page.getByRole('heading', { name: 'This server wants a key' }).waitFor();
  await page.locator('#key-input').fill('wrong');
  await page.keyboard.press('Enter');
  await page.getByRole('heading', { name: 'The server does not know this key' }).waitFor();
  await page.locator('#key-input').fill('secret');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => {
    const image = document.querySelector('#samples img');
    return image instanceof HTMLImageElement && image.src.startsWith('blob:') && image.naturalWidth > 0;
  });
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  await page.waitForURL(/signature=/);
  await page.reload();
  await page.locator('#grid > li').nth(19).waitFor();
  assert.equal(await page.locator('#key').isVisible(), false);
  const stored = await page.evaluate(() => [...Object.values(sessionStorage), ...Object.values(localStorage)]);
  assert.deepEqual(stored, ['secret']);
});

test('without a key the page says so, and asks again only when told to', async () => {
  server.key = 'secret';
  await page.goto('about:blank');
  await page.goto(server.address);
  await page.locator('#key-cancel').click();
  await page.locator('#problem').getByText('Without it nothing can be searched').waitFor();
  assert.equal(await page.locator('#key').isVisible(), false);
  await page.locator('#problem-button').click();
  await page.locator('#key').waitFor();
});

test('the page raised no error and broke no rule of its security policy', () => {
  assert.deepEqual(browser.complaints, []);
});
