import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Extent, fitInto } from '../../web/canvas/rect.js';
import { Stroke } from '../../web/canvas/stroke.js';

/** @typedef {import('../../web/canvas/stroke.js').Piece} Piece */

/**
 * @param {number[][]} points x, y and perhaps pressure
 * @param {number} size
 */
function pieces(points, size = 10) {
  const pen = points.map(([x, y, pressure = 1]) => ({ x, y, pressure }));
  const stroke = new Stroke(size, pen[0]);
  return [stroke.dot(), ...pen.slice(1).flatMap((p) => stroke.extend(p)), ...stroke.finish()];
}

test('a stroke is one unbroken line from its first to its last point', () => {
  const drawn = pieces([[0, 0], [40, 0], [40, 40], [0, 40], [-30, 7]]);
  drawn.slice(1).forEach((piece, i) => {
    assert.deepEqual([piece.x0, piece.y0], [drawn[i].x1, drawn[i].y1], `piece ${i + 1}`);
  });
  assert.deepEqual([drawn[0].x0, drawn[0].y0], [0, 0]);
  const last = drawn[drawn.length - 1];
  assert.ok(Math.hypot(last.x1 + 30, last.y1 - 7) < 1e-9, `${last.x1}, ${last.y1}`);
});

test('pieces are short, so that a bend shows no corner', () => {
  for (const { x0, y0, x1, y1 } of pieces([[0, 0], [100, 0], [100, 100]])) {
    assert.ok(Math.hypot(x1 - x0, y1 - y0) <= 3.0001);
  }
});

test('the smoothed line stays inside the corners it cuts', () => {
  for (const { x1, y1 } of pieces([[0, 0], [100, 0], [100, 100]])) {
    assert.ok(x1 >= 0 && x1 <= 100 && y1 >= 0 && y1 <= 100, `${x1}, ${y1}`);
  }
});

test('a straight stroke stays straight', () => {
  for (const { y1 } of pieces([[0, 5], [10, 5], [50, 5], [51, 5]])) assert.equal(y1, 5);
});

test('a tap is a dot of the full brush', () => {
  assert.deepEqual(pieces([[7, 8]], 12), [{ x0: 7, y0: 8, x1: 7, y1: 8, width: 12 }]);
});

test('pressure narrows the line, down to three tenths', () => {
  assert.equal(pieces([[0, 0, 1]], 20)[0].width, 20);
  assert.equal(pieces([[0, 0, 0]], 20)[0].width, 6);
  const widths = pieces([[0, 0, 0], [100, 0, 1]], 20).map(({ width }) => width);
  widths.slice(1).forEach((width, i) => assert.ok(width >= widths[i]));
});

test('an extent holds the whole width of the line and stays on the canvas', () => {
  const extent = new Extent();
  assert.equal(extent.within(100, 100), null);
  extent.add({ x0: 10, y0: 20, x1: 30, y1: 20, width: 10 });
  assert.deepEqual(extent.within(100, 100), { x: 4, y: 14, width: 32, height: 12 });
  assert.deepEqual(extent.within(20, 18), { x: 4, y: 14, width: 16, height: 4 });
  assert.equal(extent.within(3, 3), null);
});

test('a picture is made to fit, never larger, never empty', () => {
  assert.deepEqual(fitInto(640, 480, 160), { width: 160, height: 120 });
  assert.deepEqual(fitInto(30, 60, 160), { width: 30, height: 60 });
  assert.deepEqual(fitInto(5000, 2, 100), { width: 100, height: 1 });
});
