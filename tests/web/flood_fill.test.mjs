import assert from 'node:assert/strict';
import { test } from 'node:test';
import { floodFill } from '../../web/canvas/flood_fill.js';

/** @typedef {import('../../web/canvas/flood_fill.js').Raster} Raster */
/** @typedef {import('../../web/canvas/color.js').Rgba} Rgba */

/** @type {Rgba} */
const kRed = [255, 0, 0, 255];
const kNone = [0, 0, 0, 0];

/**
 * A raster from rows of letters.
 * @param {string[]} rows
 * @param {Record<string, number[]>} colors
 * @returns {Raster}
 */
function drawn(rows, colors) {
  const data = Uint8ClampedArray.from(rows.flatMap((row) => [...row].flatMap((c) => colors[c])));
  return { width: rows[0].length, height: rows.length, data };
}

/**
 * @param {Raster} raster
 * @param {number} x
 * @param {number} y
 */
function pixel({ width, data }, x, y) {
  return [...data.subarray((y * width + x) * 4, (y * width + x) * 4 + 4)];
}

/**
 * The region by its definition: pixels near the seed join until none joins any more.
 * @param {Raster} raster
 * @param {number} seedX
 * @param {number} seedY
 * @param {number} tolerance
 */
function slowRegion(raster, seedX, seedY, tolerance) {
  const { width, height } = raster;
  /** @param {number} x @param {number} y */
  const weighed = (x, y) => {
    const [r, g, b, a] = pixel(raster, x, y);
    return [(r * a) / 255, (g * a) / 255, (b * a) / 255, a];
  };
  const seed = weighed(seedX, seedY);
  /** @param {number} x @param {number} y */
  const near = (x, y) => weighed(x, y).every((c, i) => Math.abs(c - seed[i]) <= tolerance);
  const region = new Set([`${seedX},${seedY}`]);
  for (let grew = true; grew; ) {
    grew = false;
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        if (region.has(`${x},${y}`) || !near(x, y)) continue;
        const beside = [[x - 1, y], [x + 1, y], [x, y - 1], [x, y + 1]];
        if (beside.some(([i, j]) => region.has(`${i},${j}`))) {
          region.add(`${x},${y}`);
          grew = true;
        }
      }
    }
  }
  return region;
}

/** @param {number} seed */
function random(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

test('fills what the definition says, on random opaque mazes', () => {
  const next = random(7);
  for (let round = 0; round < 60; ++round) {
    const [width, height] = [1 + Math.floor(next() * 24), 1 + Math.floor(next() * 24)];
    const levels = [0, 20, 90, 200];
    const data = new Uint8ClampedArray(width * height * 4);
    for (let i = 0; i < width * height; ++i) {
      const grey = levels[Math.floor(next() * (1 + (round % 4)))];
      data.set([grey, grey, 0, 255], i * 4);
    }
    const before = { width, height, data: data.slice() };
    const after = { width, height, data };
    const [x, y] = [Math.floor(next() * width), Math.floor(next() * height)];
    const tolerance = [0, 19, 20, 75, 255][round % 5];
    floodFill(after, x, y, kRed, tolerance);
    const region = slowRegion(before, x, y, tolerance);
    for (let j = 0; j < height; ++j) {
      for (let i = 0; i < width; ++i) {
        const expected = region.has(`${i},${j}`) ? kRed : pixel(before, i, j);
        assert.deepEqual(pixel(after, i, j), expected, `round ${round} at ${i}, ${j}`);
      }
    }
  }
});

test('does not pass a diagonal wall', () => {
  const raster = drawn(['.#.', '#..', '...'], { '.': kNone, '#': [0, 0, 0, 255] });
  floodFill(raster, 0, 0, kRed, 0);
  assert.deepEqual(pixel(raster, 0, 0), kRed);
  assert.deepEqual(pixel(raster, 1, 1), kNone);
});

test('every unpainted pixel is alike, whatever colour it hides', () => {
  const raster = drawn(['ab'], { a: [9, 200, 3, 0], b: [250, 0, 77, 0] });
  floodFill(raster, 0, 0, kRed, 0);
  assert.deepEqual([pixel(raster, 0, 0), pixel(raster, 1, 0)], [kRed, kRed]);
});

test('puts the colour under the soft edge that borders the region', () => {
  const raster = drawn(['.s#'], { '.': kNone, s: [0, 0, 255, 128], '#': [0, 0, 255, 255] });
  const touched = floodFill(raster, 0, 0, kRed, 32);
  assert.deepEqual(pixel(raster, 1, 0), [127, 0, 128, 255]);
  assert.deepEqual(pixel(raster, 2, 0), [0, 0, 255, 255]);
  assert.deepEqual(touched, { x: 0, y: 0, width: 2, height: 1 });
});

test('tells the rectangle that changed, and nothing if nothing did', () => {
  const rows = ['......', '.####.', '.#..#.', '.####.', '......'];
  const raster = drawn(rows, { '.': kNone, '#': [0, 0, 0, 255] });
  assert.deepEqual(floodFill(raster, 2, 2, kRed, 0), { x: 1, y: 1, width: 4, height: 3 });
  assert.equal(floodFill(raster, 2, 2, kRed, 0), null);
});

test('refuses a seed outside', () => {
  const raster = drawn(['..'], { '.': kNone });
  assert.throws(() => floodFill(raster, 2, 0, kRed, 0), /\(2, 0\) is outside 2 x 1/);
});
