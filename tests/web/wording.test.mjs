import assert from 'node:assert/strict';
import { test } from 'node:test';
import { counted, duration, likely, nameOf, percent, turned } from '../../web/wording.js';

test('counts take the singular for one', () => {
  assert.equal(counted(0, 'picture', 'pictures'), '0 pictures');
  assert.equal(counted(1, 'picture', 'pictures'), '1 picture');
  assert.equal(counted(1234567, 'picture', 'pictures'), '1,234,567 pictures');
});

test('only the picture itself is 100 % similar', () => {
  assert.deepEqual([1, 0.999, 0.5, 0].map(percent), ['100 %', '99 %', '50 %', '0 %']);
});

test('durations have the digits that matter', () => {
  assert.deepEqual([0.2, 1.234, 12.6, 2345].map(duration), [
    'less than a millisecond', '1.2 ms', '13 ms', '2.3 s',
  ]);
});

test('a picture is called by its file', () => {
  assert.equal(nameOf({ id: 1, uri: 'file:///a/b/My%20photo%C3%A9.jpg' }), 'My photoé.jpg');
  assert.equal(nameOf({ id: 1, uri: 'https://example.org/cat.png?size=2#top' }), 'cat.png');
  assert.equal(nameOf({ id: 1, uri: 'file:///a/caf%E9.jpg' }), 'caf%E9.jpg');
  assert.equal(nameOf({ id: 7, uri: 'https://example.org/' }), 'Picture 7');
  assert.equal(nameOf({ id: 7 }), 'Picture 7');
  assert.equal(nameOf({ id: 7, uri: null }), 'Picture 7');
});

test('a turn is told from the query to the match, and none not at all', () => {
  assert.deepEqual(['identity', undefined].map(turned), ['', '']);
  const all = ['mirror_x', 'mirror_y', 'turn_90', 'turn_180', 'turn_270', 'transpose', 'anti_transpose'];
  assert.equal(new Set(all.map(turned)).size, 7);
  assert.equal(turned('mirror_x'), 'mirrored');
  assert.equal(turned('turn_90'), 'turned 90°');
  assert.equal(turned('new_symmetry'), 'new symmetry');
});

/** What each symmetry does to a pixel of an image, x to the right and y down. */
const kSymmetries = new Map([
  ['mirrored', (/** @type {number[]} */ [x, y]) => [-x, y]],
  ['90°', (/** @type {number[]} */ [x, y]) => [-y, x]],
  ['270°', (/** @type {number[]} */ [x, y]) => [y, -x]],
]);

test('the words for a transposition, done one after the other, are that transposition', () => {
  for (const [name, place] of /** @type {[string, number[]][]} */ ([
    ['transpose', [2, 1]],
    ['anti_transpose', [-2, -1]],
  ])) {
    const done = turned(name)
      .split(', ')
      .reduce((at, word) => /** @type {(at: number[]) => number[]} */ (kSymmetries.get(word))(at), [1, 2]);
    assert.deepEqual(done, place, name);
  }
});

test('nothing is certain and nothing impossible', () => {
  assert.deepEqual([0, 0.004, 0.5, 0.994, 0.999].map(likely), [
    'less than 1 %', 'less than 1 %', '50 %', '99 %', 'more than 99 %',
  ]);
});
