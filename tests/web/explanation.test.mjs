import assert from 'node:assert/strict';
import { test } from 'node:test';
import { rowsOf, tally } from '../../web/explanation.js';

const kChannel = {
  channel: 'Y',
  average: { query: 0.5, target: 0.4, weight: 5 },
  distance: 1.5,
  bins: [
    { bin: 1, weight: 0.83, matched: 3, missed: 1 },
    { bin: 2, weight: 1, matched: 0, missed: 0 },
    { bin: 3, weight: 0.525, matched: 0, missed: 7 },
  ],
};

test('a bin that the query has nothing in makes no row', () => {
  assert.deepEqual(rowsOf(kChannel), [
    { bin: 1, weight: '0.83', matched: 3, missed: 1 },
    { bin: 3, weight: '0.53', matched: 0, missed: 7 },
  ]);
});

test('matched and all are counted over bins and channels', () => {
  assert.deepEqual(tally({ channels: [kChannel, kChannel] }), { matched: 6, all: 22 });
  assert.deepEqual(tally({ channels: [] }), { matched: 0, all: 0 });
});
