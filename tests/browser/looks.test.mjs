// How the page fits: narrow and wide, light and dark, by keyboard, for screen readers.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { keepScreenshot, openBrowser, paintStroke } from './support/browser.mjs';
import { FakeServer } from './support/fake_server.mjs';

const server = new FakeServer();
before(() => server.start());
after(() => server.stop());

/** @typedef {import('playwright-core').Page} Page */

/** @type {[string, import('./support/browser.mjs').BrowserContextOptions][]} */
const kViews = [
  ['desktop-light', { viewport: { width: 1440, height: 900 }, colorScheme: 'light' }],
  ['desktop-dark', { viewport: { width: 1440, height: 900 }, colorScheme: 'dark' }],
  ['tablet', { viewport: { width: 820, height: 1100 }, colorScheme: 'light' }],
  ['phone', { viewport: { width: 360, height: 740 }, colorScheme: 'light', hasTouch: true }],
  ['phone-dark', { viewport: { width: 360, height: 740 }, colorScheme: 'dark', hasTouch: true }],
  ['phone-on-its-side', { viewport: { width: 740, height: 360 }, hasTouch: true }],
];

for (const [name, options] of kViews) {
  test(`nothing sticks out and every text can be read: ${name}`, async () => {
    const { page, complaints, close } = await openBrowser(options);
    try {
      await page.goto(server.address);
      await page.locator('#samples img').first().waitFor();
      await fitsAndReads(page, `${name}, first screen`);
      await paintStroke(page, [[0.1, 0.2], [0.9, 0.8]]);
      await page.waitForURL(/signature=/); // the last results, not those of half a stroke
      await fitsAndReads(page, `${name}, results`);
      await keepScreenshot(page, `look-${name}`);
      await page.locator('.card-picture').nth(1).click();
      await page.locator('#asked-picture').waitFor();
      await fitsAndReads(page, `${name}, like a picture`);
      await page.locator('.card-open').first().focus();
      await page.keyboard.press('Enter');
      await page.locator('#details').waitFor();
      await fitsAndReads(page, `${name}, details`);
      await page.locator('#why summary').click();
      await page.locator('.why-picture').waitFor();
      await fitsAndReads(page, `${name}, why`);
      await keepScreenshot(page, `why-${name}`);
      await page.keyboard.press('Escape');
      await page.locator('#help-button').click();
      await fitsAndReads(page, `${name}, help`);
      await page.keyboard.press('Escape');
      await page.locator('#options summary').click();
      await page.locator('#option-orientations').selectOption('all');
      await page.locator('#option-combine').getByLabel('painted_lab').check();
      await page.waitForURL(/combine=painted_lab/);
      await fitsAndReads(page, `${name}, options`);
      await page.locator('#combine-by-row').scrollIntoViewIfNeeded();
      await keepScreenshot(page, `options-${name}`);
      await page.locator('#to-overview').click();
      await page.locator('.group button').nth(1).click();
      await fitsAndReads(page, `${name}, overview`);
      await keepScreenshot(page, `overview-${name}`);
      await page.locator('#to-duplicates').click();
      await page.locator('#duplicates-find').click();
      await page.locator('.duplicate').first().waitFor();
      await fitsAndReads(page, `${name}, duplicates`);
      await keepScreenshot(page, `duplicates-${name}`);
      await page.getByRole('button', { name: 'Delete' }).first().click();
      await page.locator('#question').waitFor();
      await fitsAndReads(page, `${name}, question`);
      assert.deepEqual(complaints, []);
    } finally {
      await close();
    }
  });
}

test('on a phone the canvas stays in view while the results scroll', async () => {
  const { page, close } = await openBrowser({ viewport: { width: 360, height: 740 }, hasTouch: true });
  try {
    await page.goto(server.address);
    await paintStroke(page, [[0.1, 0.2], [0.9, 0.8]]);
    await page.waitForURL(/signature=/); // the last results, not those of half a stroke
    await page.locator('#grid > li').nth(19).scrollIntoViewIfNeeded();
    const box = await page.locator('#canvas').boundingBox();
    assert.ok(box && box.y >= 0 && box.y + box.height < 740 / 2 + 60, JSON.stringify(box));
  } finally {
    await close();
  }
});

test('a finger paints and does not scroll the page', async () => {
  const { page, context, close } = await openBrowser({
    viewport: { width: 360, height: 740 },
    hasTouch: true,
  });
  try {
    await page.goto(server.address);
    await page.locator('#samples li').first().waitFor();
    const box = await page.locator('#canvas').boundingBox();
    assert.ok(box);
    const devtools = await context.newCDPSession(page);
    const at = (/** @type {number} */ share) => [
      { x: box.x + box.width / 2, y: box.y + box.height * share },
    ];
    await devtools.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: at(0.9) });
    for (const share of [0.7, 0.5, 0.3, 0.1]) {
      await devtools.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: at(share) });
    }
    await devtools.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    await page.locator('#grid > li').nth(19).waitFor();
    assert.equal(await page.evaluate(() => scrollY), 0);
    assert.equal(await page.locator('#undo').isEnabled(), true);
  } finally {
    await close();
  }
});

test('the Tab key reaches every control, and shows where it is', async () => {
  const { page, close } = await openBrowser();
  try {
    await page.goto(server.address);
    await page.locator('#samples li').first().waitFor();
    await page.locator('#options summary').click();
    await page.locator('#home').focus();
    const reached = new Set(['home']);
    for (let i = 0; i < 80; ++i) {
      await page.keyboard.press('Tab');
      const { id, outlined } = await page.evaluate(() => {
        const focused = document.activeElement ?? document.body;
        const marked = [focused, focused.closest('label'), focused.nextElementSibling];
        return {
          id: focused.id || focused.getAttribute('name') || focused.className || focused.tagName,
          outlined: marked.some((e) => e && getComputedStyle(e).outlineStyle === 'solid'),
        };
      });
      if (id === 'BODY') break;
      assert.ok(outlined, `no focus is seen on ${id}`);
      reached.add(id);
    }
    for (const id of [
      'home', 'help-button', 'tool', 'canvas', 'color', 'custom-color', 'size', 'shape', 'match',
      'live', 'file', 'surprise', 'example', 'card-picture', 'to-overview', 'to-duplicates',
      'option-profile', 'option-orientations', 'option-text', 'option-partial', 'train',
    ]) {
      assert.ok(reached.has(id), `${id} is not reached: ${[...reached]}`);
    }
  } finally {
    await close();
  }
});

test('every control has a name for screen readers', async () => {
  const { page, context, close } = await openBrowser();
  try {
    await page.goto(server.address);
    await page.locator('#samples li').first().waitFor();
    await page.locator('#samples a').first().click();
    await page.locator('#grid > li').nth(19).waitFor();
    const devtools = await context.newCDPSession(page);
    const { nodes } = await devtools.send('Accessibility.getFullAXTree');
    const controls = nodes.filter(
      ({ role, ignored }) =>
        !ignored &&
        ['button', 'link', 'radio', 'slider', 'switch', 'combobox', 'application', 'ColorWell'].includes(role?.value),
    );
    assert.ok(controls.length > 60, `only ${controls.length} controls`);
    const nameless = controls.filter(({ name }) => !name?.value);
    assert.deepEqual(nameless.map(({ role }) => role?.value), []);
    await page.getByRole('status').getByText('20 results, best').waitFor({ state: 'attached' });
  } finally {
    await close();
  }
});

test('with reduced motion nothing glides', async () => {
  const { page, close } = await openBrowser({ reducedMotion: 'reduce' });
  try {
    await page.goto(server.address);
    await page.locator('#samples a').first().click();
    await page.locator('#grid > li').nth(19).waitFor();
    await page.locator('.card-picture').nth(5).click();
    await page.waitForFunction(() => document.querySelector('#grid > li .share')?.textContent === '100 %');
    assert.equal(await page.evaluate(() => document.getAnimations().length), 0);
  } finally {
    await close();
  }
});

/**
 * @param {Page} page
 * @param {string} where
 */
async function fitsAndReads(page, where) {
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  assert.ok(wide <= 0, `${where}: the page is ${wide} px too wide`);
  assert.deepEqual(await page.evaluate(overlaps), [], `${where}: parts lie over each other`);
  assert.deepEqual(await page.evaluate(faintTexts), [], `${where}: contrast below WCAG AA`);
}

/** Controls of the painting side that lie over the results side. Runs in the page. */
function overlaps() {
  const findings = document.querySelector('.findings')?.getBoundingClientRect();
  if (!findings || scrollY > 0) return []; // where they are stacked, results scroll below
  const parts = [...document.querySelectorAll('.studio canvas, .studio .tool, .studio .custom, .studio .button')];
  return parts
    .filter((part) => part.checkVisibility()) // not in a closed fold
    .filter((part) => {
      const box = part.getBoundingClientRect();
      return box.right > findings.left && box.bottom > findings.top && box.top < findings.bottom;
    })
    .map((part) => part.id || part.className);
}

/**
 * Texts in view whose contrast with the plain colour behind them is below 4.5 (3 for large
 * ones). Texts over pictures and disabled controls are left out. Runs in the page.
 */
function faintTexts() {
  /** @param {string} css rgb(...) or color(srgb ...) */
  const parse = (css) => {
    const numbers = (css.match(/[\d.]+/g) ?? []).map(Number);
    const rgb = numbers.slice(0, 3).map((c) => (css.startsWith('color(') ? c * 255 : c));
    return { rgb, alpha: numbers.length > 3 ? numbers[3] : 1 };
  };
  /** @param {number[]} rgb */
  const luminance = (rgb) => {
    const [r, g, b] = rgb.map((byte) => {
      const c = byte / 255;
      return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const faint = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const dialog = document.querySelector('dialog[open]');
  while (walker.nextNode()) {
    const element = walker.currentNode.parentElement;
    const text = walker.currentNode.textContent?.trim();
    if (!element || !text || !element.checkVisibility() || element.closest('.unseen, noscript')) continue;
    if (dialog && !dialog.contains(element)) continue;
    if (element.matches(':disabled, :disabled *') || element.closest('.invitation')) continue;
    const style = getComputedStyle(element);
    let behind = null;
    for (let at = /** @type {Element | null} */ (element); at && !behind; at = at.parentElement) {
      const { rgb, alpha } = parse(getComputedStyle(at).backgroundColor);
      if (alpha === 1) behind = rgb;
    }
    const [a, b] = [luminance(parse(style.color).rgb), luminance(behind ?? [255, 255, 255])];
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    const large = parseFloat(style.fontSize) >= 24;
    if (contrast < (large ? 3 : 4.5)) faint.push(`${text.slice(0, 40)}: ${contrast.toFixed(2)}`);
  }
  return faint;
}
