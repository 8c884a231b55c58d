import assert from 'node:assert/strict';
import { test } from 'node:test';
import { counted, duration, nameOf, percent } from '../../web/wording.js';

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
