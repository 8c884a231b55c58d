// Searches as the server sees them: what is asked, how often, and which answer is shown.

import assert from 'node:assert/strict';
import { afterEach, beforeEach, test } from 'node:test';
import { chooseColor, chooseSize, paintStroke, resultIds } from './support/browser.mjs';
import { browser, page, server, useFakePage } from './support/fake_page.mjs';
import { decodePng, encodePng } from './support/png.mjs';

useFakePage({ permissions: ['clipboard-read', 'clipboard-write'] });
beforeEach(async () => {
  await page.goto('about:blank');
  await page.goto(server.address);
  await page.locator('#samples li').first().waitFor();
  server.queries = [];
  server.mostInFlight = 0;
});
afterEach(() => {
  server.onQuery = null;
});

test('the first screen offers pictures of the collection and says how many there are', async () => {
  assert.equal(await page.locator('#samples li').count(), 8);
  await page.getByText('all 60 pictures').waitFor();
});

test('a stroke searches: a small PNG in which the unpainted is transparent', async () => {
  await chooseColor(page, '#0000ff');
  await paintStroke(page, [[0.1, 0.25], [0.9, 0.25]]);
  await waitForAddress(/signature=/); // written for the finished stroke
  const { method, url, headers, body } = server.queries[server.queries.length - 1];
  assert.equal(method, 'POST');
  assert.equal(headers['content-type'], 'image/png');
  assert.equal(url.searchParams.get('profile'), 'painted');
  assert.equal(url.searchParams.get('limit'), '20');
  const { width, height, data } = decodePng(body);
  assert.deepEqual([width, height], [160, 120]);
  assert.deepEqual([...data.slice((30 * 160 + 80) * 4, (30 * 160 + 80) * 4 + 4)], [0, 0, 255, 255]);
  assert.equal(data[(100 * 160 + 80) * 4 + 3], 0);
});

test('results stand best first with their similarity, and say what was searched', async () => {
  await page.locator('#samples a').first().click();
  const ids = await shownResults(20);
  const first = server.queries[0].url.searchParams.get('id');
  assert.deepEqual(ids, Array.from({ length: 20 }, (_, i) => 1 + ((Number(first) - 1 + i) % 60)));
  const shares = await page.locator('#grid .share').allTextContents();
  assert.deepEqual(shares.slice(0, 3), ['100 %', '96 %', '92 %']);
  assert.equal(await page.locator('#summary').textContent(), '60 pictures searched in 1.3 ms');
});

test('results follow the brush before it is lifted', async () => {
  const box = await canvasBox();
  await page.mouse.move(box.x + 20, box.y + 20);
  await page.mouse.down();
  await page.mouse.move(box.x + 200, box.y + 100, { steps: 5 });
  await shownResults(20);
  await page.mouse.up();
});

test('one request is out at a time, and the last answer is for the last stroke', async () => {
  /** @type {(() => void)[]} */
  const held = [];
  server.onQuery = (_, answer) => new Promise((resolve) => held.push(() => resolve(answer)));
  for (const y of [0.1, 0.3, 0.5, 0.7, 0.9]) await paintStroke(page, [[0.1, y], [0.9, y]]);
  await waitUntil(() => held.length === 1);
  held[0]();
  await waitUntil(() => held.length === 2);
  held[1]();
  await waitForAddress(/signature=/);
  assert.equal(server.mostInFlight, 1);
  assert.equal(server.queries.length, 2);
  const seqs = server.queries.map(({ url }) => Number(url.searchParams.get('seq')));
  assert.ok(seqs[1] > seqs[0], `${seqs}`);
  const rows = decodePng(server.queries[1].body);
  for (const y of [0.1, 0.3, 0.5, 0.7, 0.9]) {
    const at = (Math.round(y * rows.height) * rows.width + rows.width / 2) * 4;
    assert.equal(rows.data[at + 3], 255, `stroke at ${y}`);
  }
});

test('an answer that comes after another search was chosen is not shown', async () => {
  /** @type {(() => void)[]} */
  const held = [];
  server.onQuery = (call, answer) =>
    call.method === 'POST'
      ? new Promise((resolve) => held.push(() => resolve(answer)))
      : answer;
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  await waitUntil(() => held.length === 1);
  await page.locator('#samples a').first().click();
  const ids = await shownResults(20);
  held[0]();
  await waitUntil(() => server.inFlight === 0);
  await page.locator('#live').focus();
  assert.deepEqual(await resultIds(page), ids);
  assert.match(page.url(), /#id=/);
});

test('with live search off only Match searches', async () => {
  await page.locator('#live').uncheck();
  await page.locator('#match').click();
  await page.locator('#toast').getByText('Paint something first').waitFor();
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  await paintStroke(page, [[0.1, 0.9], [0.9, 0.1]]);
  assert.equal(server.queries.length, 0);
  await page.keyboard.press('m');
  await shownResults(20);
  assert.equal(server.queries.length, 1);
});

test('a result becomes the next query, and Back and Forward walk through the searches', async () => {
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  await waitForAddress(/signature=/);
  const painted = await shownResults(20);
  await page.locator('.card-picture').nth(3).click();
  await waitForAddress(new RegExp(`#id=${painted[3]}&profile=scanned`));
  await page.locator('.card-picture').nth(5).click();
  await waitForAddress(new RegExp(`#id=${painted[8]}&`));
  await page.goBack();
  await waitForFirst(painted[3]);
  await page.goBack();
  await page.getByText('Like your painting').waitFor();
  await waitUntil(() => server.queries[server.queries.length - 1].url.searchParams.has('signature'));
  await page.goForward();
  await waitForFirst(painted[3]);
  await page.goBack();
  await page.goBack();
  await page.locator('#welcome').waitFor();
});

test('Back brings the painting of that search to the canvas again', async () => {
  await chooseColor(page, '#0000ff');
  await chooseSize(page, 100);
  await paintStroke(page, [[0.5, 0.5]]);
  await waitForAddress(/signature=/);
  await page.locator('.card-picture').nth(2).click();
  await waitForAddress(/#id=/);
  await page.locator('#clear').click();
  assert.equal(await page.locator('#invitation').isVisible(), true);
  await page.goBack();
  await page.locator('#invitation').waitFor({ state: 'hidden' });
  await page.reload();
  await page.locator('#invitation').waitFor({ state: 'hidden' });
  await page.getByText('Like your painting').waitFor();
  assert.equal(await page.locator('#shared').isHidden(), true);
});

test('a shared address shows the same results elsewhere, and says that it is shared', async () => {
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  await waitForAddress(/signature=/);
  await page.locator('#share').click();
  await page.locator('#toast').getByText('Link copied').waitFor();
  const address = await page.evaluate(() => navigator.clipboard.readText());
  assert.equal(address, page.url());
  const signature = new URLSearchParams(new URL(address).hash.slice(1)).get('signature');
  const other = await browser.context.newPage();
  await other.goto(address);
  await other.getByText('You opened a shared search').waitFor();
  const { url, method } = server.queries[server.queries.length - 1];
  assert.equal(method, 'GET');
  assert.equal(url.searchParams.get('signature'), signature);
  assert.equal(url.searchParams.get('profile'), 'painted');
  await other.close();
});

test('a card that stays keeps its element and focus, and each shows its own picture', async () => {
  await page.locator('#samples a').first().click();
  const before = await shownResults(20);
  await page.locator('.card-picture').nth(4).focus();
  await page.evaluate(() => Object.assign(document.activeElement ?? {}, { marked: true }));
  await page.keyboard.press('Enter');
  await waitForFirst(before[4]);
  const { marked, id } = await page.evaluate(() => {
    const focused = /** @type {any} */ (document.activeElement);
    return { marked: focused.marked, id: focused.parentElement.dataset.id };
  });
  assert.deepEqual([marked, id], [true, String(before[4])]);
  const shown = await page
    .locator('#grid img')
    .evaluateAll((images) => images.map((image) => image.getAttribute('src')));
  const ids = await resultIds(page);
  assert.deepEqual(shown, ids.map((each) => `images/${each}/thumbnail`));
});

test('the profile can be chosen, and stands in the address', async () => {
  await page.locator('#samples a').first().click();
  await waitForAddress(/profile=scanned/);
  await page.locator('#profile input[value=painted]').check();
  await waitForAddress(/#id=\d+&profile=painted/);
  assert.equal(server.queries[1].url.searchParams.get('profile'), 'painted');
  await page.goBack();
  await page.locator('#welcome').waitFor();
});

test('a chosen file is sent as it is and compared as a picture', async () => {
  const png = encodePng(12, 8, (x, y) => [x * 20, y * 30, 90]);
  await page.locator('#file').setInputFiles({ name: 'cliff.png', mimeType: 'image/png', buffer: png });
  await page.getByRole('heading', { name: 'Like cliff.png' }).waitFor();
  const { body, headers, url } = server.queries[0];
  assert.match(String(headers['content-type']), /^multipart\/form-data/);
  assert.ok(body.includes(png));
  assert.ok(body.includes('name="file"; filename="cliff.png"'));
  assert.equal(url.searchParams.get('profile'), 'scanned');
  await page.locator('#asked-picture').waitFor();
  await waitForAddress(/signature=.*profile=scanned/);
});

test('a dropped and a pasted picture are searched for', async () => {
  for (const kind of ['drop', 'paste']) {
    const png = encodePng(6, 6, (x) => [x * 40, 0, kind.length]);
    await page.evaluate(
      ({ kind, bytes }) => {
        const transfer = new DataTransfer();
        transfer.items.add(new File([Uint8Array.from(bytes)], `${kind}.png`, { type: 'image/png' }));
        const event =
          kind === 'drop'
            ? new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true })
            : new ClipboardEvent('paste', { clipboardData: transfer, bubbles: true, cancelable: true });
        document.body.dispatchEvent(event);
      },
      { kind, bytes: [...png] },
    );
    await page.getByRole('heading', { name: `Like ${kind}.png` }).waitFor();
    assert.ok(server.queries[server.queries.length - 1].body.includes(png), kind);
  }
});

test('a result opens large, with its facts, and leads on', async () => {
  await page.locator('#samples a').first().click();
  const ids = await shownResults(20);
  const odd = ids.findIndex((id) => id % 2 === 1 && id % 3 === 0);
  await page.locator('.card-open').nth(odd).focus();
  await page.keyboard.press('Enter');
  const dialog = page.locator('#details');
  await dialog.getByRole('heading', { name: `picture ${ids[odd]}.png` }).waitFor();
  await dialog.getByText('64 × 48 pixels').waitFor();
  await dialog.getByText('multiple').waitFor();
  await page.locator(`#details-picture[src="images/${ids[odd]}/original"]`).waitFor();
  assert.equal(await page.locator('#details-original').getAttribute('href'), `images/${ids[odd]}/original`);
  await page.keyboard.press('ArrowRight');
  await dialog.getByRole('heading', { name: `picture ${ids[odd + 1]}.png` }).waitFor();
  await page.locator('#details-note').waitFor();
  assert.equal(await page.locator('#details-original').isHidden(), true);
  await page.locator('#details-like').click();
  await waitForAddress(new RegExp(`#id=${ids[odd + 1]}&`));
});

test('surprise me searches by a picture that is not shown', async () => {
  await page.locator('#surprise').click();
  await waitForAddress(/#id=\d+/);
  await shownResults(20);
});

test('the example paints by itself and can be interrupted', async () => {
  await page.locator('#example').click();
  await page.locator('#toast').getByText('Painted from memory of').waitFor();
  await shownResults(20);
  const { data } = decodePng(server.queries[server.queries.length - 1].body);
  const painted = data.filter((byte, i) => i % 4 === 3 && byte === 255).length;
  assert.ok(painted > (data.length / 4) * 0.95, `${painted} of ${data.length / 4} pixels`);
});

test('clearing the canvas leads back to the first screen', async () => {
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  await shownResults(20);
  await page.locator('#clear').click();
  await page.locator('#welcome').waitFor();
  assert.equal(new URL(page.url()).hash, '');
});

test('a flat painting is told to need a second colour', async () => {
  server.onQuery = (_, answer) => {
    /** @type {any} */ (answer.body).query.low_information = true;
    return answer;
  };
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  await page.getByText('A second colour tells them apart').waitFor();
});

test('the page raised no error and broke no rule of its security policy', () => {
  assert.deepEqual(browser.complaints, []);
});

/** @param {number} count */
async function shownResults(count) {
  await page.waitForFunction(
    (n) => document.querySelectorAll('#grid:not([hidden]) > li').length === n,
    count,
  );
  return resultIds(page);
}

/** @param {number} id */
function waitForFirst(id) {
  return page.locator(`#grid > li:first-child[data-id="${id}"]`).waitFor();
}

/** @param {RegExp} pattern */
function waitForAddress(pattern) {
  return page.waitForURL(pattern);
}

async function canvasBox() {
  const box = await page.locator('#canvas').boundingBox();
  assert.ok(box);
  return box;
}

/** @param {() => boolean} condition in this process: what the server has seen */
async function waitUntil(condition) {
  const end = Date.now() + 20_000;
  while (!condition()) {
    assert.ok(Date.now() < end, `still not: ${condition}`);
    await new Promise((resolve) => setImmediate(resolve));
  }
}
