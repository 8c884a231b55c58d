import assert from 'node:assert/strict';
import { test } from 'node:test';
import { StrokeLog } from '../../web/stroke_log.js';
import { FakeClock } from './fake_clock.mjs';

/** @typedef {import('../../web/canvas/painting.js').Step} Step */

/** A painting of which only the events are real. */
class Canvas extends EventTarget {
  empty = true;
  drawing = false;
  width = 640;
  height = 480;

  begin() {
    this.drawing = true;
    this.dispatchEvent(new Event('change'));
  }

  /**
   * @param {Step} step
   * @param {boolean} [empty] after it
   */
  step(step, empty = false) {
    this.drawing = false;
    this.empty = empty;
    this.dispatchEvent(Object.assign(new Event('step'), { detail: step }));
  }

  /** @param {string | null} color */
  stroke(color) {
    this.begin();
    this.step(stroke(color));
  }
}

/**
 * @param {string | null} color
 * @param {number[]} [pressures]
 * @returns {Step}
 */
function stroke(color, pressures = [1, 1]) {
  return { kind: 'stroke', color, size: 40, trace: pressures.map((pressure, i) => ({ x: i * 10.04, y: 5, pressure })) };
}

function bench() {
  const canvas = new Canvas();
  const clock = new FakeClock();
  return { canvas, clock, log: new StrokeLog(canvas, clock) };
}

test('strokes are told as the interface takes them, in painting order', () => {
  const { canvas, log } = bench();
  assert.equal(log.strokes(), null);
  canvas.stroke('#0000ff');
  canvas.step(stroke('#ff0000', [0, 0.5, 1]));
  assert.deepEqual(log.strokes(), {
    width: 640,
    height: 480,
    background: null,
    items: [
      { points: [[0, 5], [10, 5]], width: 40, color: '#0000ff' },
      { points: [[0, 5], [10, 5], [20.1, 5]], width: [12, 26, 40], color: '#ff0000' },
    ],
  });
});

test('time runs from the beginning of the first stroke', async () => {
  const { canvas, clock, log } = bench();
  assert.equal(log.seconds(), null);
  await clock.pass(5000);
  canvas.begin();
  await clock.pass(2000);
  canvas.step(stroke('#0000ff'));
  await clock.pass(3500);
  canvas.stroke('#0000ff');
  assert.equal(log.seconds(), 5.5);
});

test('an empty canvas starts over', async () => {
  const { canvas, clock, log } = bench();
  canvas.stroke('#0000ff');
  await clock.pass(9000);
  canvas.step({ kind: 'other' }, true);
  assert.equal(log.seconds(), null);
  canvas.stroke('#00ff00');
  await clock.pass(1000);
  assert.equal(log.seconds(), 1);
  assert.deepEqual(log.strokes()?.items.map(({ color }) => color), ['#00ff00']);
});

test('undo takes a stroke back, redo brings it again, a new one forgets it', () => {
  const { canvas, log } = bench();
  const colors = () => log.strokes()?.items.map(({ color }) => color) ?? [];
  canvas.stroke('#000001');
  canvas.stroke('#000002');
  canvas.step({ kind: 'undo' });
  assert.deepEqual(colors(), ['#000001']);
  canvas.step({ kind: 'redo' });
  assert.deepEqual(colors(), ['#000001', '#000002']);
  canvas.step({ kind: 'undo' });
  canvas.stroke('#000003');
  canvas.step({ kind: 'redo' });
  assert.deepEqual(colors(), ['#000001', '#000003']);
});

test('undoing the clearing brings the strokes before it back', () => {
  const { canvas, log } = bench();
  canvas.stroke('#000001');
  canvas.step({ kind: 'other' }, true);
  assert.equal(log.strokes(), null);
  canvas.step({ kind: 'undo' });
  assert.equal(log.strokes()?.items.length, 1);
});

test('what is no stroke of a brush cannot be told as strokes', () => {
  for (const step of [stroke(null), /** @type {Step} */ ({ kind: 'other' })]) {
    const { canvas, log } = bench();
    canvas.stroke('#000001');
    canvas.step(step);
    canvas.stroke('#000002');
    assert.equal(log.strokes(), null);
    assert.notEqual(log.seconds(), null);
  }
});
