// The search options: what is sent, what stands in the address, what the results say, and what
// is offered at all.

import assert from 'node:assert/strict';
import { afterEach, beforeEach, test } from 'node:test';
import { paintStroke } from './support/browser.mjs';
import { FakeFeatures } from './support/fake_features.mjs';
import { browser, page, server, useFakePage } from './support/fake_page.mjs';
import { described, problem } from './support/fake_server.mjs';
import { encodePng } from './support/png.mjs';

useFakePage();
beforeEach(async () => {
  server.features = new FakeFeatures(problem, described);
  await open('');
});
afterEach(() => {
  server.onQuery = null;
});

test('the plain search sends no option, and says that none is in use', async () => {
  await paint();
  const sent = [...lastQuery().keys()].sort();
  assert.deepEqual(sent, ['limit', 'profile', 'seq']);
  assert.equal(await page.locator('#options-count').isHidden(), true);
});

test('each option is sent, stands in the address, and is set again from there', async () => {
  await paint();
  await page.locator('#options summary').click();
  await page.locator('#option-orientations').selectOption('all');
  await page.locator('#option-aspect').selectOption('much');
  await page.locator('#option-autocrop').check();
  await page.locator('#option-text').fill('old lake');
  await page.keyboard.press('Enter');
  await page.locator('#option-tags').fill('a,b');
  await page.keyboard.press('Enter');
  await page.locator('#option-combine').getByLabel('painted_lab').check();
  await page.locator('#option-combine-by').selectOption('worst');
  await page.waitForURL(/combine_by=worst/);
  const fields = Object.fromEntries(lastQuery());
  const options = {
    orientations: 'all', aspect_weight: '20', autocrop: 'true', text: 'old lake', tags: 'a,b',
    combine: 'painted,painted_lab', combine_by: 'worst',
  };
  assert.deepEqual({ ...fields, ...options }, fields);
  assert.equal(await page.locator('#options-count').textContent(), '6');

  const other = await page.context().newPage();
  await other.goto(page.url());
  await other.locator('#grid > li').nth(19).waitFor();
  assert.deepEqual({ ...Object.fromEntries(lastQuery()), ...options }, Object.fromEntries(lastQuery()));
  assert.equal(await other.locator('#option-text').inputValue(), 'old lake');
  assert.equal(await other.locator('#option-orientations').inputValue(), 'all');
  assert.equal(await other.locator('#option-autocrop').isChecked(), true);
  await other.close();

  await page.locator('#options-reset').click();
  await page.waitForURL((url) => !url.hash.includes('combine'));
  assert.deepEqual([...lastQuery().keys()].sort(), ['limit', 'profile', 'seq']);
  assert.equal(await page.evaluate(() => document.activeElement?.tagName), 'SUMMARY');
});

test('a part is asked for with a picture at hand, never with one of the collection', async () => {
  await page.locator('#options summary').click();
  await page.locator('#option-partial').check();
  const png = encodePng(8, 8, (x, y) => [x * 20, y * 30, 90]);
  await page.locator('#file').setInputFiles({ name: 'part.png', mimeType: 'image/png', buffer: png });
  await page.waitForURL(/partial=true/);
  assert.equal(lastQuery().get('partial'), 'true');
  await page.locator('.card-picture').nth(3).click();
  await page.waitForURL(/#id=\d+&profile=scanned$/);
  assert.equal(lastQuery().has('partial'), false);
  assert.equal(await page.locator('#partial-row').isHidden(), true);
  await page.goBack();
  await page.getByText('which an address cannot carry').waitFor();
});

test('a profile can be chosen from those that are indexed', async () => {
  await paint();
  await page.locator('#options summary').click();
  const names = await page.locator('#option-profile option').allTextContents();
  assert.deepEqual(names, ['painted', 'scanned', 'painted_lab', 'scanned_rgb']);
  await page.locator('#option-profile').selectOption('painted_lab');
  await page.waitForURL(/profile=painted_lab/);
  assert.equal(lastQuery().get('profile'), 'painted_lab');
  assert.equal(await page.locator('#option-combine').getByText('painted_lab').count(), 0);
  await paintStroke(page, [[0.1, 0.9], [0.9, 0.9]]);
  await page.waitForURL(/profile=painted_lab/);
  assert.equal(lastQuery().get('profile'), 'painted_lab');
});

test('results say how they are turned, what they rank together, and how likely they are', async () => {
  await open('#id=5&orientations=all&combine=painted_lab');
  await page.locator('#grid > li').nth(19).waitFor();
  const turns = await page.locator('.card-turn').evaluateAll((badges) =>
    badges.slice(0, 4).map((badge) => /** @type {HTMLElement} */ (badge).hidden || badge.textContent),
  );
  assert.deepEqual(turns, [true, 'mirrored', 'turned 90°', 'mirrored, 90°']);
  const link = page.locator('.card-picture').nth(1);
  assert.equal(
    await link.getAttribute('title'),
    'picture 6.png, mirrored, combined rank 2.5, 80 % likely to be meant: find more like this',
  );
  assert.match((await link.getAttribute('aria-label')) ?? '', /96 % similar, mirrored\./);
  await page.locator('.card-open').nth(1).focus();
  await page.keyboard.press('Enter');
  const facts = await page.locator('#details-facts').innerText();
  assert.match(facts, /Combined rank\s+2\.5/);
  assert.match(facts, /Probability\s+80 %/);
  assert.match(facts, /Orientation\s+mirrored/);
});

test('words that no picture has are told, and are no empty collection', async () => {
  server.onQuery = (_, answer) => {
    Object.assign(/** @type {any} */ (answer.body), { matches: [], searched: 0 });
    return answer;
  };
  await open('#id=5&text=nowhere');
  await page.getByText('No picture has these words and tags.').waitFor();
  assert.equal(await page.locator('#collection').textContent(), '60 pictures');
});

test('an older server is offered nothing that it does not know', async () => {
  for (const features of [null, new FakeFeatures(problem, described)]) {
    server.features = features;
    if (features) Object.assign(features, { options: [], paths: {} });
    await open('');
    await paint();
    assert.equal(await page.locator('#options').isHidden(), true);
    assert.equal(await page.locator('#to-overview').isHidden(), true);
    assert.equal(await page.locator('#to-duplicates').isHidden(), true);
    await page.locator('.card-open').first().focus();
    await page.keyboard.press('Enter');
    await page.locator('#details').waitFor();
    assert.equal(await page.locator('#why').isHidden(), true);
    assert.equal(await page.locator('#details-answer').isHidden(), true);
    assert.equal(await page.locator('#train').isHidden(), true);
    await page.keyboard.press('Escape');
  }
});

test('one option alone is offered alone', async () => {
  Object.assign(server.features ?? {}, { options: ['tags'], paths: {} });
  await open('');
  await page.locator('#options summary').click();
  const shown = await page.locator('#options-rows > *').evaluateAll((rows) =>
    rows.filter((row) => row.checkVisibility()).map((row) => row.id),
  );
  assert.deepEqual(shown, ['tags-row']);
});

test('an option that the server refuses is told in its words', async () => {
  server.onQuery = () => problem(400, 'not_built', 'orientations=all is not built yet');
  await open('#id=5&orientations=all');
  await page.locator('#problem').getByText('orientations=all is not built yet').waitFor();
});

test('the page raised no error and broke no rule of its security policy', () => {
  assert.deepEqual(browser.complaints, []);
});

/** @param {string} fragment */
async function open(fragment) {
  await page.goto('about:blank');
  server.queries = [];
  await page.goto(server.address + fragment);
  await page.locator('#collection').getByText('60 pictures').waitFor({ state: 'attached' });
  await page.waitForLoadState('networkidle');
}

async function paint() {
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  await page.waitForURL(/signature=/);
}

function lastQuery() {
  return server.queries[server.queries.length - 1].url.searchParams;
}
