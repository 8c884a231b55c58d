// "This is it", "Why this match" and training: what goes to the server, and only when told to.

import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';
import { chooseColor, chooseSize, paintStroke, resultIds } from './support/browser.mjs';
import { FakeFeatures } from './support/fake_features.mjs';
import { browser, page, server, useFakePage } from './support/fake_page.mjs';
import { described, problem } from './support/fake_server.mjs';
import { encodePng } from './support/png.mjs';

let features = new FakeFeatures(problem, described);
useFakePage();
beforeEach(async () => {
  server.features = features = new FakeFeatures(problem, described);
  await page.goto('about:blank');
  server.queries = [];
  await page.goto(server.address);
  await page.evaluate(() => localStorage.clear());
  await page.locator('#options summary').waitFor();
});

test('a painting is answered with its strokes, the picture and the time it took', async () => {
  await chooseSize(page, 60);
  await chooseColor(page, '#0000ff');
  await paintStroke(page, [[0.25, 0.5], [0.75, 0.5]]);
  await chooseColor(page, '#ff0000');
  await paintStroke(page, [[0.5, 0.25]]);
  await page.waitForURL(/signature=/);
  await page.locator('.card-open').nth(2).focus();
  await page.keyboard.press('Enter');
  const opened = (await page.locator('#details-name').textContent()) ?? '';
  await page.getByText('keeps your query and this picture on the server as one pair').waitFor();
  assert.deepEqual(features.answers, []);
  await page.locator('#details-answer').click();
  await page.locator('#toast').getByText('Thank you').waitFor();
  /** @type {any} */
  const answer = features.answers[0];
  const { strokes, seconds, ...rest } = answer;
  assert.deepEqual(rest, { target: Number(opened.match(/\d+/)), kind: 'painted' });
  assert.ok(seconds >= 0 && seconds < 600, `${seconds}`);
  const { items, ...frame } = strokes;
  assert.deepEqual(frame, { width: 640, height: 480, background: null });
  assert.deepEqual(items.map((/** @type {any} */ { color, width }) => [color, width]), [['#0000ff', 60], ['#ff0000', 60]]);
  assert.deepEqual(items[0].points[0].map(Math.round), [160, 240]);
  for (const item of items) assert.deepEqual(Object.keys(item).sort(), ['color', 'points', 'width']);
  await page.locator('#details-answer').getByText('Thank you, it is kept').waitFor();
  await page.locator('#details-answer').click({ force: true });
  await page.keyboard.press('Escape');
  assert.equal(features.answers.length, 1);
});

test('what strokes cannot say is answered with the signature', async () => {
  await paintStroke(page, [[0.2, 0.2], [0.8, 0.2]]);
  await page.locator('#tools input[value=eraser]').check();
  await paintStroke(page, [[0.2, 0.2], [0.4, 0.2]]);
  await page.waitForURL(/signature=/);
  await answerFirst();
  const [answer] = features.answers;
  assert.equal(answer.strokes, undefined);
  assert.match(answer.signature, /^opaque-/);
  assert.equal(answer.kind, 'painted');
  assert.ok(answer.seconds >= 0);
});

test('an uploaded picture is scanned, and took no time', async () => {
  const png = encodePng(8, 8, (x, y) => [x * 20, y * 30, 90]);
  await page.locator('#file').setInputFiles({ name: 'copy.png', mimeType: 'image/png', buffer: png });
  await page.waitForURL(/signature=/);
  await answerFirst();
  const [target] = await resultIds(page);
  assert.deepEqual(features.answers, [{ signature: `opaque-${target}`, target, kind: 'scanned' }]);
});

test('a picture of the collection is its own answer: nobody is asked', async () => {
  await page.locator('#samples a').first().click();
  await page.locator('#grid > li').nth(19).waitFor();
  assert.equal(await page.locator('.card-answer').first().isHidden(), true);
  await page.locator('.card-open').first().focus();
  await page.keyboard.press('Enter');
  await page.locator('#details-like').waitFor();
  assert.equal(await page.locator('#details-answer').isHidden(), true);
});

test('an answer that the server refuses is told, and may be given again', async () => {
  features.instead = ({ url }) =>
    url.pathname === '/feedback' ? problem(403, 'read_only', 'this key may only read') : null;
  await paintStroke(page, [[0.2, 0.2], [0.8, 0.2]]);
  await page.waitForURL(/signature=/);
  await page.locator('.card-answer').first().focus();
  await page.keyboard.press('Enter');
  await page.locator('#toast').getByText('this key may only read').waitFor();
  features.instead = () => null;
  await answerFirst();
  assert.equal(features.answers.length, 1);
});

test('why a match matches is asked for by signature, drawn, and told by bin', async () => {
  await paintStroke(page, [[0.2, 0.2], [0.8, 0.2]]);
  await page.waitForURL(/signature=/);
  await page.locator('.card-open').nth(1).focus();
  await page.keyboard.press('Enter');
  const asked = server.queries.length;
  await page.locator('#why summary').click();
  await page.locator('.why-picture').waitFor();
  const { searchParams } = server.queries[asked].url;
  assert.equal(searchParams.get('explain'), 'true');
  assert.equal(searchParams.get('limit'), '20');
  assert.match(searchParams.get('signature') ?? '', /^opaque-/);
  await page.locator('#why').getByText('60 of 105 strong wavelet coefficients').waitFor();
  assert.equal(await page.locator('#why table').count(), 3);
  const rows = await page.locator('#why table').first().locator('tbody tr').allInnerTexts();
  assert.deepEqual(rows.map((row) => row.split(/\s+/)), [
    ['1', '1.00', '1', '5'], ['2', '0.50', '2', '4'], ['3', '0.33', '3', '3'], ['4', '0.25', '4', '2'], ['5', '0.20', '5', '1'],
  ]);
  const drawn = await page.locator('.why-picture').evaluate((image) => /** @type {HTMLImageElement} */ (image).naturalWidth);
  assert.equal(drawn, 384);
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction((count) => document.querySelectorAll('#why table').length === count, 3);
  assert.equal(server.queries.length, asked + 2);
});

test('a match that the signature does not find again is told', async () => {
  await paintStroke(page, [[0.2, 0.2], [0.8, 0.2]]);
  await page.waitForURL(/signature=/);
  server.onQuery = (_, answer) => {
    Object.assign(/** @type {any} */ (answer.body), { matches: [] });
    return answer;
  };
  await page.locator('.card-open').first().focus();
  await page.keyboard.press('Enter');
  await page.locator('#why summary').click();
  await page.locator('#why').getByText('does not find this picture again').waitFor();
  server.onQuery = () => problem(400, 'not_built', 'explain is not built yet');
  await page.keyboard.press('ArrowRight');
  await page.locator('#why').getByText('explain is not built yet').waitFor();
  server.onQuery = null;
});

test('training counts the answers, says what it came to, and its profile can be used', async () => {
  await paintStroke(page, [[0.2, 0.2], [0.8, 0.2]]);
  await page.waitForURL(/signature=/);
  await page.locator('#options summary').click();
  await page.locator('#train').getByText('Train on the answers').click();
  await page.locator('#train-said').getByText('there is 1 pair, and training takes at least 10').waitFor();
  await answerFirst();
  await page.locator('#train').getByText('Train on my 1 answer').click();
  await page.locator('#train-said').getByText('first in 20 % before and 50 % now').waitFor();
  assert.deepEqual(features.trained.at(-1), { path: '/profiles/mine/train', base: 'painted', kind: 'painted' });
  await page.locator('#train-use').getByText('Search with mine').click();
  await page.waitForURL(/profile=mine/);
});

test('a name that cannot be one is not sent', async () => {
  await page.locator('#options summary').click();
  await page.locator('#train-name').fill('my profile');
  await page.locator('#train').click();
  await page.locator('#train-said').getByText('letters, digits').waitFor();
  assert.deepEqual(features.trained, []);
});

test('the page raised no error and broke no rule of its security policy', () => {
  assert.deepEqual(browser.complaints, []);
});

/** With the small button of the first result. */
async function answerFirst() {
  await page.locator('.card-answer').first().focus();
  await page.keyboard.press('Enter');
  await page.locator('#toast').getByText('Thank you').waitFor();
}
