import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Sampler } from '../../web/sampler.js';

/**
 * A collection of `count` pictures, listed in pages.
 * @param {number} count
 */
function collection(count) {
  const pictures = Array.from({ length: count }, (_, i) => ({ id: i + 1 }));
  const calls = { count: 0 };
  /** @param {number} limit @param {string | null} cursor */
  const list = async (limit, cursor) => {
    ++calls.count;
    const from = Number(cursor ?? 0);
    const next = from + limit < pictures.length ? String(from + limit) : null;
    return { items: pictures.slice(from, from + limit), next_cursor: next };
  };
  return { list, calls };
}

/** @param {{id: number}[]} drawn */
const ids = (drawn) => drawn.map(({ id }) => id);

test('draws different pictures, no more than there are', async () => {
  const sampler = new Sampler(collection(5).list, () => 0.5);
  assert.deepEqual(ids(await sampler.draw(9)).sort(), [1, 2, 3, 4, 5]);
  assert.equal(new Set(ids(await sampler.draw(3))).size, 3);
});

test('avoids pictures that are shown already, unless there are no others', async () => {
  const sampler = new Sampler(collection(3).list, () => 0);
  assert.deepEqual(ids(await sampler.draw(3, [1, 2])), [3]);
  assert.deepEqual(ids(await sampler.draw(1, [1, 2, 3])), [1]);
});

test('rows whose file could not be read are not offered', async () => {
  const items = [{ id: 1, thumbnail: null }, { id: 2, thumbnail: '/images/2/thumbnail' }];
  const sampler = new Sampler(async () => ({ items, next_cursor: null }), () => 0);
  assert.deepEqual(ids(await sampler.draw(5)), [2]);
});

test('each draw reads one page more, until the end', async () => {
  const { list, calls } = collection(450);
  const sampler = new Sampler(list, () => 0.999999);
  assert.deepEqual(ids(await sampler.draw(1)), [200]);
  assert.deepEqual(ids(await sampler.draw(1)), [400]);
  assert.deepEqual(ids(await sampler.draw(1)), [450]);
  await sampler.draw(1);
  assert.equal(calls.count, 3);
});

test('an empty collection gives none, and is read again once it is forgotten', async () => {
  const { list, calls } = collection(0);
  const sampler = new Sampler(list, () => 0);
  assert.deepEqual(await sampler.draw(3), []);
  await sampler.draw(3);
  assert.equal(calls.count, 1);
  sampler.forget();
  await sampler.draw(3);
  assert.equal(calls.count, 2);
});
