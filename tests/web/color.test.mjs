import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fromHex, luminance, toHex } from '../../web/canvas/color.js';
import { moveCursor } from '../../web/canvas/keyboard_brush.js';
import { nearestShape, sizeOfShape } from '../../web/canvas/shapes.js';

test('colours come back from their text', () => {
  for (const hex of ['#000000', '#00000f', '#0a0b0c', '#ff8000', '#ffffff']) {
    assert.equal(toHex(fromHex(hex)), hex);
  }
  assert.deepEqual(fromHex('#Ff8001'), [255, 128, 1, 255]);
  assert.throws(() => fromHex('#fff'), /#rrggbb: #fff/);
});

test('luminance is 0 for black, 1 for white, and green outshines blue', () => {
  assert.equal(luminance('#000000'), 0);
  assert.ok(Math.abs(luminance('#ffffff') - 1) < 1e-12);
  assert.ok(luminance('#00ff00') > luminance('#0000ff'));
});

test('the keyboard cursor moves by keys and stays on the canvas', () => {
  const canvas = { width: 100, height: 50 };
  const keys = { shiftKey: false, altKey: false };
  assert.deepEqual(moveCursor({ x: 50, y: 25 }, { key: 'ArrowRight', ...keys }, canvas), { x: 62, y: 25 });
  assert.deepEqual(moveCursor({ x: 50, y: 25 }, { key: 'ArrowUp', ...keys, altKey: true }, canvas), { x: 50, y: 23 });
  assert.deepEqual(moveCursor({ x: 50, y: 25 }, { key: 'ArrowLeft', ...keys, shiftKey: true }, canvas), { x: 2, y: 25 });
  assert.deepEqual(moveCursor({ x: 95, y: 45 }, { key: 'ArrowDown', ...keys }, canvas), { x: 95, y: 50 });
  assert.equal(moveCursor({ x: 1, y: 1 }, { key: 'a', ...keys }, canvas), null);
});

test('each shape is the nearest to itself, and areas are alike', () => {
  for (const name of ['landscape', 'wide', 'square', 'portrait']) {
    const { width, height } = sizeOfShape(name);
    assert.equal(nearestShape(width, height), name);
    assert.ok(Math.abs((width * height) / (640 * 480) - 1) < 0.02, name);
  }
  assert.equal(nearestShape(4000, 1000), 'wide');
  assert.throws(() => sizeOfShape('round'), /round/);
});
