import assert from 'node:assert/strict';
import { test } from 'node:test';
import { countOptions, optionsFor, parametersOf, readOptions, writeOptions } from '../../web/search_options.js';

/** @typedef {import('../../web/search_options.js').Options} Options */

/** @type {Options} */
const kAll = {
  orientations: 'all', autocrop: true, partial: true, aspect: 'much', text: 'lake',
  tags: 'a,b', combine: ['lab', 'painted'], combineBy: 'worst',
};

test('the plain search sends nothing', () => {
  assert.deepEqual(parametersOf({}, 'painted'), []);
});

test('each option goes under the name that the interface has for it', () => {
  assert.deepEqual(Object.fromEntries(parametersOf(kAll, 'painted')), {
    orientations: 'all', autocrop: 'true', partial: 'true', aspect_weight: '20', text: 'lake',
    tags: 'a,b', combine: 'painted,lab', combine_by: 'worst',
  });
});

test('the chosen profile comes first in a combination, once, and alone it is none', () => {
  assert.deepEqual(parametersOf({ combine: ['a', 'b'] }, 'b'), [['combine', 'b,a']]);
  assert.deepEqual(parametersOf({ combine: ['b'], combineBy: 'worst' }, 'b'), []);
});

test('a matter of some weight weighs less than one of much', () => {
  const weight = (/** @type {Options} */ options) => Number(new Map(parametersOf(options, 'p')).get('aspect_weight'));
  assert.ok(weight({ aspect: 'some' }) > 0);
  assert.ok(weight({ aspect: 'some' }) < weight({ aspect: 'much' }));
});

test('only a picture at hand can be a part of another', () => {
  for (const kind of /** @type {const} */ (['painting', 'file'])) assert.equal(optionsFor(kAll, kind), kAll);
  for (const kind of /** @type {const} */ (['id', 'signature'])) {
    assert.equal(optionsFor(kAll, kind).partial, undefined);
    assert.equal(optionsFor(kAll, kind).tags, 'a,b');
  }
});

test('what was written is read again', () => {
  for (const options of [{}, kAll, { text: 'ä&=#' }, { combine: ['x'] }]) {
    const fields = new URLSearchParams();
    writeOptions(/** @type {Options} */ (options), fields);
    assert.deepEqual(readOptions(new URLSearchParams(fields.toString())), options);
  }
});

test('the count is of things that somebody chose', () => {
  assert.equal(countOptions({}), 0);
  assert.equal(countOptions(kAll), 7);
});
