// The screens about the collection as a whole: the overview and the duplicates.

import assert from 'node:assert/strict';
import { afterEach, beforeEach, test } from 'node:test';
import { paintStroke } from './support/browser.mjs';
import { FakeFeatures } from './support/fake_features.mjs';
import { browser, page, server, useFakePage } from './support/fake_page.mjs';
import { described, problem } from './support/fake_server.mjs';

let features = new FakeFeatures(problem, described);
useFakePage();
beforeEach(async () => {
  server.features = features = new FakeFeatures(problem, described);
  await open('');
});
afterEach(async () => {
  server.key = null;
  await page.evaluate(() => sessionStorage.clear());
});

test('the overview shows a picture for each group; a group opens in place, by keyboard too', async () => {
  await page.locator('#to-overview').click();
  await page.waitForURL(/#overview=24$/);
  assert.equal(await page.locator('.group').count(), 24);
  assert.equal(await page.locator('#to-overview').getAttribute('aria-current'), 'page');
  const button = page.locator('.group button').first();
  assert.equal(await button.getAttribute('aria-expanded'), 'false');
  await button.focus();
  await page.keyboard.press('Enter');
  assert.equal(await button.getAttribute('aria-expanded'), 'true');
  const inside = page.locator(`#${await button.getAttribute('aria-controls')}`);
  assert.equal(await inside.locator('a').count(), 3);
  await page.keyboard.press('Enter');
  assert.equal(await inside.isHidden(), true);
});

test('a picture of a group becomes a search, and Back returns to the overview', async () => {
  await open('#overview=12');
  await page.locator('.group').nth(11).waitFor();
  await page.locator('.group button').nth(2).click();
  const link = page.locator('.group-row:not([hidden]) a').nth(1);
  const href = (await link.getAttribute('href')) ?? '';
  await link.click();
  await page.waitForURL((url) => url.hash === href);
  await page.locator('#grid > li').nth(19).waitFor();
  assert.equal(await page.locator('#overview').isHidden(), true);
  await page.goBack();
  await page.locator('.group').nth(11).waitFor();
  assert.equal(await page.locator('#grid').isHidden(), true);
});

test('the number of groups can be chosen, and stands in the address', async () => {
  await open('#overview=30');
  await page.locator('.group').nth(29).waitFor();
  assert.equal(await page.locator('#overview-count').inputValue(), '30');
  await page.locator('#overview-count').selectOption('48');
  await page.waitForURL(/#overview=48$/);
  await page.locator('.group').nth(47).waitFor();
});

test('painting leads from the overview to results', async () => {
  await open('#overview=12');
  await page.locator('.group').nth(11).waitFor();
  await paintStroke(page, [[0.1, 0.1], [0.9, 0.9]]);
  await page.waitForURL(/signature=/);
  assert.equal(await page.locator('#overview').isHidden(), true);
  assert.equal(await page.locator('#to-overview').getAttribute('aria-current'), null);
});

test('an overview that fails, is not known, or has nothing says so', async () => {
  /** @type {[import('./support/fake_server.mjs').Answer, string][]} */
  const cases = [
    [problem(404, 'not_found', 'no /clusters'), 'This server gives no overview.'],
    [problem(400, 'not_built', 'clusters are not built yet'), 'clusters are not built yet'],
    [{ status: 200, body: { clusters: [] } }, 'There is nothing to group yet.'],
  ];
  for (const [answer, text] of cases) {
    features.instead = ({ url }) => (url.pathname === '/clusters' ? answer : null);
    await open('#overview=12');
    await page.locator('#overview').getByText(text).waitFor();
  }
});

test('duplicates are looked for, shown as they are found, and page by page', async () => {
  await page.locator('#to-duplicates').click();
  await page.waitForURL(/#duplicates=all$/);
  await page.getByText('None are known. Look for them to be sure.').waitFor();
  await page.locator('#duplicates-find').click();
  await page.getByText('2 groups and more').waitFor();
  assert.equal(await page.locator('.duplicate').count(), 2);
  await page.locator('#duplicates-more').click();
  await page.getByText(/^3 groups, as of/).waitFor();
  assert.equal(await page.locator('#duplicates-more').isHidden(), true);
  assert.deepEqual(await page.locator('.duplicate h3').allTextContents(), ['The same file', 'Nearly the same', 'Alike']);
  await page.locator('#duplicates-level').getByLabel('Near').check();
  await page.waitForURL(/#duplicates=near$/);
  await page.getByText(/^2 groups, as of/).waitFor();
  assert.deepEqual(await page.locator('.duplicate h3').allTextContents(), ['The same file', 'Nearly the same']);
});

test('with a key the job is asked for instead of listened to', async () => {
  server.key = 'secret';
  /** @type {string[]} */
  const asked = [];
  features.instead = ({ url }) => {
    asked.push(url.pathname);
    return null;
  };
  await page.goto('about:blank');
  await page.goto(`${server.address}#duplicates=all`);
  await page.locator('#key-input').fill('secret');
  await page.keyboard.press('Enter');
  await page.locator('#duplicates-find').click();
  await page.getByText('2 groups and more').waitFor();
  assert.ok(asked.includes('/jobs/7'));
  assert.equal(asked.includes('/jobs/7/events'), false);
});

test('a failed and a cancelled search are told', async () => {
  features.states = ['queued', 'failed'];
  await open('#duplicates=all');
  await page.locator('#duplicates-find').click();
  await page.getByText('The search failed: the disk is full.').waitFor();
  assert.equal(await page.locator('#duplicates-find').isEnabled(), true);
  // Events that end without an end: the job is asked for from then on.
  features.states = ['running'];
  await page.locator('#duplicates-find').click();
  await page.getByText('40 of 60 pictures compared, about 3 seconds left').waitFor();
  await page.locator('#duplicates-cancel').click();
  await page.getByText('The search was cancelled.').waitFor();
  assert.equal(await page.locator('#duplicates-running').isHidden(), true);
});

test('a picture that is no duplicate leaves its group, and each pair is remembered', async () => {
  features.found = true;
  await open('#duplicates=near');
  const group = page.locator('.duplicate').nth(1);
  await group.getByRole('button', { name: 'picture 12.png is not a duplicate' }).click();
  await page.locator('#toast').getByText('will not be shown as a duplicate').waitFor();
  assert.deepEqual(features.ignored, [[4, 12], [12, 31]]);
  assert.equal(await group.locator('.copies > li').count(), 2);
  await group.getByRole('button', { name: 'picture 4.png is not a duplicate' }).click();
  await page.waitForFunction(() => document.querySelectorAll('.duplicate').length === 1);
  assert.deepEqual(features.ignored.at(-1), [4, 31]);
});

test('nothing is deleted without a question, and nothing when it is answered with no', async () => {
  features.found = true;
  await open('#duplicates=exact');
  const remove = page.getByRole('button', { name: 'Delete picture 9.png …' });
  for (const no of ['#question-no', 'Escape']) {
    await remove.click();
    await page.getByRole('heading', { name: 'Delete picture 9.png?' }).waitFor();
    if (no === 'Escape') await page.keyboard.press('Escape');
    else await page.locator(no).click();
    await page.locator('#question').waitFor({ state: 'hidden' });
  }
  assert.deepEqual(features.deleted, []);
  await remove.click();
  await page.locator('#question-yes').click();
  await page.locator('#toast').getByText('picture 9.png is deleted').waitFor();
  assert.deepEqual(features.deleted, [9]);
  assert.equal(await page.locator('.duplicate').count(), 0);
});

test('a refusal leaves the picture where it is, and is told', async () => {
  features.found = true;
  await open('#duplicates=exact');
  features.instead = ({ method }) => (method === 'DELETE' ? problem(403, 'read_only', 'this key may only read') : null);
  await page.getByRole('button', { name: 'Delete picture 9.png …' }).click();
  await page.locator('#question-yes').click();
  await page.locator('#toast').getByText('this key may only read').waitFor();
  assert.equal(await page.locator('.copies > li').count(), 2);
});

test('duplicates that cannot be had say why', async () => {
  features.instead = ({ url }) => (url.pathname === '/duplicates' ? problem(404, 'not_found', 'there is no /duplicates') : null);
  await open('#duplicates=all');
  await page.locator('#duplicates-said').getByText('there is no /duplicates').waitFor();
});

test('a screen comes back when the server does', async () => {
  await open('#overview=12');
  await page.locator('.group').nth(11).waitFor();
  await server.stop();
  await page.locator('#overview-count').selectOption('48');
  await page.locator('#banner').waitFor();
  await server.start();
  await page.locator('.group').nth(47).waitFor();
});

test('the page raised no error and broke no rule of its security policy', () => {
  assert.deepEqual(browser.complaints, []);
});

/** @param {string} fragment */
async function open(fragment) {
  await page.goto('about:blank');
  await page.goto(server.address + fragment);
  await page.locator('#to-overview').waitFor();
}
