// The canvas with every tool and every kind of pointer, looked at pixel by pixel.

import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';
import { chooseColor, chooseSize, paintStroke, pixelAt } from './support/browser.mjs';
import { browser, page, server, useFakePage } from './support/fake_page.mjs';

const kBlue = [0, 0, 255, 255];
const kRed = [255, 0, 0, 255];
const kNone = [0, 0, 0, 0];

useFakePage();
beforeEach(async () => {
  await page.goto('about:blank');
  await page.goto(server.address);
  await page.locator('#samples li').first().waitFor();
  await chooseColor(page, '#0000ff');
});

test('the brush paints where the mouse goes, and nowhere else', async () => {
  await chooseSize(page, 40);
  await paintStroke(page, [[0.2, 0.5], [0.8, 0.5]]);
  for (const x of [0.2, 0.5, 0.79]) assert.deepEqual(await pixelAt(page, [x, 0.5]), kBlue);
  assert.deepEqual(await pixelAt(page, [0.5, 0.7]), kNone);
  assert.deepEqual(await pixelAt(page, [0.9, 0.5]), kNone);
  assert.equal(await page.locator('#invitation').isHidden(), true);
});

test('a stroke that leaves the canvas goes on and ends outside', async () => {
  await paintStroke(page, [[0.5, 0.5], [1.2, 0.5]]);
  assert.deepEqual(await pixelAt(page, [0.99, 0.5]), kBlue);
  await page.mouse.move(400, 400);
  await paintStroke(page, [[0.2, 0.2]]);
  assert.deepEqual(await pixelAt(page, [0.2, 0.2]), kBlue);
});

test('undo and redo walk through the strokes, by button and by key', async () => {
  await paintStroke(page, [[0.2, 0.2], [0.3, 0.2]]);
  await chooseColor(page, '#ff0000');
  await paintStroke(page, [[0.2, 0.2], [0.3, 0.2]]);
  await page.locator('#undo').click();
  assert.deepEqual(await pixelAt(page, [0.25, 0.2]), kBlue);
  await page.keyboard.press('Control+z');
  assert.deepEqual(await pixelAt(page, [0.25, 0.2]), kNone);
  assert.equal(await page.locator('#undo').isDisabled(), true);
  await page.keyboard.press('Control+Shift+Z');
  assert.deepEqual(await pixelAt(page, [0.25, 0.2]), kBlue);
  await page.keyboard.press('Control+y');
  assert.deepEqual(await pixelAt(page, [0.25, 0.2]), kRed);
  assert.equal(await page.locator('#redo').isDisabled(), true);
});

test('fill covers the area under the cursor up to its edges', async () => {
  await chooseSize(page, 30);
  await paintStroke(page, [[0, 0.5], [1, 0.5]]);
  await chooseColor(page, '#ff0000');
  await page.keyboard.press('g');
  await paintStroke(page, [[0.5, 0.2]]);
  assert.deepEqual(await pixelAt(page, [0.01, 0.01]), kRed);
  assert.deepEqual(await pixelAt(page, [0.5, 0.5]), kBlue);
  assert.deepEqual(await pixelAt(page, [0.5, 0.9]), kNone);
  await page.keyboard.press('Control+z');
  assert.deepEqual(await pixelAt(page, [0.01, 0.01]), kNone);
});

test('no pale rim stays between a stroke and the fill beside it', async () => {
  await chooseSize(page, 60);
  await paintStroke(page, [[0.5, 0.5]]);
  await chooseColor(page, '#ff0000');
  await page.keyboard.press('g');
  await paintStroke(page, [[0.1, 0.1]]);
  const translucent = await page.locator('#canvas').evaluate((element) => {
    const canvas = /** @type {HTMLCanvasElement} */ (element);
    const pixels = canvas.getContext('2d')?.getImageData(0, 0, canvas.width, canvas.height).data;
    return [...(pixels ?? [])].filter((byte, i) => i % 4 === 3 && byte < 255).length;
  });
  assert.equal(translucent, 0);
});

test('the eraser makes the canvas unpainted again', async () => {
  await chooseSize(page, 60);
  await paintStroke(page, [[0.2, 0.5], [0.8, 0.5]]);
  await page.keyboard.press('e');
  await paintStroke(page, [[0.5, 0.3], [0.5, 0.7]]);
  assert.deepEqual(await pixelAt(page, [0.5, 0.5]), kNone);
  assert.deepEqual(await pixelAt(page, [0.25, 0.5]), kBlue);
});

test('the eyedropper and Alt with any tool pick the colour of the painting', async () => {
  await paintStroke(page, [[0.5, 0.5]]);
  await chooseColor(page, '#ff0000');
  await page.keyboard.press('i');
  await paintStroke(page, [[0.5, 0.5]]);
  assert.equal(await page.locator('#custom-color').inputValue(), '#0000ff');
  assert.equal(await page.locator('input[name=tool]:checked').inputValue(), 'brush');
  await chooseColor(page, '#ff0000');
  await page.keyboard.down('Alt');
  await paintStroke(page, [[0.5, 0.5]]);
  await page.keyboard.up('Alt');
  assert.equal(await page.locator('#custom-color').inputValue(), '#0000ff');
  assert.deepEqual(await pixelAt(page, [0.5, 0.5]), kBlue);
});

test('clear empties the canvas, and can be undone', async () => {
  await paintStroke(page, [[0.5, 0.5]]);
  await page.keyboard.press('Shift+Delete');
  assert.deepEqual(await pixelAt(page, [0.5, 0.5]), kNone);
  await page.locator('#invitation').waitFor();
  await page.keyboard.press('Control+z');
  assert.deepEqual(await pixelAt(page, [0.5, 0.5]), kBlue);
});

test('another shape stretches the painting with it, and can be undone', async () => {
  await paintStroke(page, [[0.5, 0.5]]);
  await page.locator('#shape').selectOption('portrait');
  assert.deepEqual(await canvasSize(), [480, 640]);
  assert.deepEqual(await pixelAt(page, [0.5, 0.5]), kBlue);
  await page.locator('#undo').click();
  assert.deepEqual(await canvasSize(), [640, 480]);
  assert.equal(await page.locator('#shape').inputValue(), 'landscape');
});

test('the keyboard alone can paint, in several strokes', async () => {
  await page.locator('#canvas').focus();
  await page.keyboard.press('Space');
  for (let i = 0; i < 5; ++i) await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Space');
  assert.deepEqual(await pixelAt(page, [0.5, 0.5]), kBlue);
  assert.deepEqual(await pixelAt(page, [0.5 + 60 / 640, 0.5]), kBlue);
  for (let i = 0; i < 3; ++i) await page.keyboard.press('Shift+ArrowDown');
  assert.deepEqual(await pixelAt(page, [0.5 + 60 / 640, 0.5 + 144 / 480]), kNone);
  await page.keyboard.press('Enter');
  await page.keyboard.press('Escape');
  assert.deepEqual(await pixelAt(page, [0.5 + 60 / 640, 0.5 + 144 / 480]), kBlue);
  await page.keyboard.press('Control+z');
  assert.deepEqual(await pixelAt(page, [0.5 + 60 / 640, 0.5 + 144 / 480]), kNone);
  assert.deepEqual(await pixelAt(page, [0.5, 0.5]), kBlue);
});

test('keys change the size of the brush, and letters can be switched off', async () => {
  await page.keyboard.press(']');
  assert.equal(await page.locator('#size').inputValue(), '60');
  await page.keyboard.press('[');
  assert.equal(await page.locator('#size').inputValue(), '48');
  await page.keyboard.press('?');
  await page.locator('#letter-keys').uncheck();
  await page.keyboard.press('Escape');
  await page.keyboard.press('e');
  assert.equal(await page.locator('input[name=tool]:checked').inputValue(), 'brush');
  await page.locator('#help-button').click();
  await page.locator('#letter-keys').check();
  await page.keyboard.press('Escape');
  await page.keyboard.press('e');
  assert.equal(await page.locator('input[name=tool]:checked').inputValue(), 'eraser');
});

test('pressure narrows a pen, its other end erases', async () => {
  await chooseSize(page, 100);
  await pointer('pen', 1, [['pointerdown', 0.3, 0.5, 1], ['pointerup', 0.3, 0.5, 0]]);
  await pointer('pen', 1, [['pointerdown', 0.7, 0.5, 0.1], ['pointerup', 0.7, 0.5, 0]]);
  assert.deepEqual(await pixelAt(page, [0.3 + 45 / 640, 0.5]), kBlue);
  assert.deepEqual(await pixelAt(page, [0.7 + 45 / 640, 0.5]), kNone);
  assert.deepEqual(await pixelAt(page, [0.7, 0.5]), kBlue);
  await pointer('pen', 1, [['pointerdown', 0.7, 0.5, 1, 5], ['pointerup', 0.7, 0.5, 0, 5]]);
  assert.deepEqual(await pixelAt(page, [0.7, 0.5]), kNone);
});

test('a second finger does not disturb the first', async () => {
  await pointer('touch', 1, [['pointerdown', 0.2, 0.2, 1]]);
  await pointer('touch', 2, [['pointerdown', 0.8, 0.8, 1], ['pointerup', 0.8, 0.8, 0]]);
  await pointer('touch', 1, [['pointermove', 0.4, 0.2, 1], ['pointerup', 0.4, 0.2, 0]]);
  assert.deepEqual(await pixelAt(page, [0.39, 0.2]), kBlue);
  assert.deepEqual(await pixelAt(page, [0.8, 0.8]), kNone);
});

test('a stroke that the system takes away leaves nothing', async () => {
  await pointer('touch', 1, [
    ['pointerdown', 0.2, 0.2, 1],
    ['pointermove', 0.5, 0.5, 1],
    ['pointercancel', 0.5, 0.5, 0],
  ]);
  assert.deepEqual(await pixelAt(page, [0.2, 0.2]), kNone);
  assert.equal(await page.locator('#undo').isDisabled(), true);
});

test('a picture of the results can be painted over', async () => {
  await page.locator('#samples a').first().click();
  await page.locator('#paint-over').click();
  await page.waitForFunction(() => /** @type {HTMLButtonElement} */ (document.getElementById('undo')).disabled === false);
  assert.equal((await pixelAt(page, [0.5, 0.5]))[3], 255);
});

test('the page raised no error and broke no rule of its security policy', () => {
  assert.deepEqual(browser.complaints, []);
});

function canvasSize() {
  return page.locator('#canvas').evaluate((element) => {
    const { width, height } = /** @type {HTMLCanvasElement} */ (element);
    return [width, height];
  });
}

/**
 * Pointer events as a pen or a finger sends them; the protocol of the browser has no pen.
 * @param {string} pointerType
 * @param {number} pointerId
 * @param {[string, number, number, number, number?][]} steps type, place, pressure, button
 */
async function pointer(pointerType, pointerId, steps) {
  await page.locator('#canvas').evaluate(
    (element, { pointerType, pointerId, steps }) => {
      const canvas = /** @type {HTMLCanvasElement} */ (element);
      canvas.setPointerCapture = () => {}; // the browser knows no such pointer
      const box = canvas.getBoundingClientRect();
      for (const [type, x, y, pressure, button = 0] of steps) {
        canvas.dispatchEvent(
          new PointerEvent(type, {
            pointerType,
            pointerId,
            pressure,
            button,
            clientX: box.left + x * box.width,
            clientY: box.top + y * box.height,
            bubbles: true,
            cancelable: true,
          }),
        );
      }
    },
    { pointerType, pointerId, steps },
  );
}
