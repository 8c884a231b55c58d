// What the screens about the collection say, without a page.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { kindOf } from '../../web/answers.js';
import { endOf, progressOf } from '../../web/duplicates.js';
import { outcome } from '../../web/training.js';

const kBefore = { median_rank: 4, rank_1: 0.25, top_20: 0.8 };
const kAfter = { median_rank: 1.5, rank_1: 0.5, top_20: 0.95 };

test('training is told with what it was before, and whether it is stored', () => {
  const held = { pairs: 20, before: kBefore, after: kAfter };
  const better = outcome({ held_back: held, better: true, stored: true }, 'mine');
  assert.match(better, /^On 20 answers held back, .*first in 25 % before and 50 % now/);
  assert.match(better, /80 % and 95 %; its median rank went from 4 to 1.5\. Stored as mine\.$/);
  const worse = outcome({ held_back: held, better: false, stored: false }, 'mine');
  assert.match(worse, /Not stored: it would be worse than before\.$/);
  assert.match(outcome({ held_back: held, better: true, stored: false }, 'mine'), / Not stored\.$/);
});

test('without pairs held back there is nothing to compare', () => {
  const text = outcome({ held_back: { pairs: 0, before: kBefore, after: kAfter }, stored: true }, 'x');
  assert.equal(text, 'No answer could be held back to compare. Stored as x.');
});

test('progress says what is known', () => {
  assert.equal(progressOf({ id: 1, state: 'queued' }), 'Waiting for its turn …');
  assert.equal(progressOf({ id: 1, state: 'running' }), '0 pictures compared');
  const job = /** @type {const} */ ({ id: 1, state: 'running', counts: { seen: 1200 }, total: 3000, eta_s: 2.2 });
  assert.equal(progressOf(job), '1,200 of 3,000 pictures compared, about 3 seconds left');
});

test('an end that is none is told with its first reason', () => {
  assert.equal(endOf({ id: 1, state: 'cancelled' }), 'The search was cancelled.');
  assert.equal(endOf({ id: 1, state: 'failed' }), 'The search failed.');
  assert.equal(endOf({ id: 1, state: 'failed', errors: ['disk full'] }), 'The search failed: disk full.');
  assert.equal(endOf({ id: 1, state: 'failed', errors: [{ detail: 'disk full' }] }), 'The search failed: disk full.');
});

test('a file is scanned, a painting painted, an address what it compares by', () => {
  const query = (/** @type {string} */ kind, /** @type {string} */ profile) =>
    kindOf(/** @type {any} */ ({ source: { kind }, profile }));
  assert.equal(query('file', 'painted'), 'scanned');
  assert.equal(query('painting', 'scanned'), 'painted');
  assert.equal(query('signature', 'scanned'), 'scanned');
  assert.equal(query('signature', 'painted'), 'painted');
  assert.equal(kindOf(null), 'painted');
});
