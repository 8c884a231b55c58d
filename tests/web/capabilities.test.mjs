import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Capabilities } from '../../web/capabilities.js';

const kDescription = {
  paths: {
    '/query': {
      get: {
        parameters: [
          { $ref: '#/components/parameters/orientations' },
          { $ref: '#/components/parameters/missing' },
          { name: 'partial', in: 'query', schema: { type: 'boolean' } },
          { name: 'autocrop', in: 'query', schema: { enum: [false] } },
        ],
      },
    },
    '/feedback': { post: {} },
  },
  components: { parameters: { orientations: { name: 'orientations', schema: { enum: ['none', 'mirror'] } } } },
};

test('an option that is described is taken, with the values that it lists', () => {
  const capabilities = new Capabilities(kDescription);
  assert.equal(capabilities.takes('partial', true), true);
  assert.equal(capabilities.takes('orientations', 'mirror'), true);
  assert.equal(capabilities.takes('orientations', 'all'), false);
  assert.equal(capabilities.takes('orientations'), true);
  assert.equal(capabilities.takes('autocrop', true), false);
  assert.equal(capabilities.takes('text'), false);
  assert.equal(capabilities.takes('missing'), false);
});

test('an address answers the methods that it lists', () => {
  const capabilities = new Capabilities(kDescription);
  assert.equal(capabilities.answers('/feedback', 'post'), true);
  assert.equal(capabilities.answers('/feedback'), false);
  assert.equal(capabilities.answers('/clusters'), false);
});

test('a server that describes nothing can do nothing more', () => {
  for (const description of [null, {}, { paths: {} }, { paths: { '/query': { get: {} } } }]) {
    const capabilities = new Capabilities(/** @type {import('../../web/capabilities.js').Description | null} */ (description));
    assert.equal(capabilities.takes('orientations'), false);
    assert.equal(capabilities.answers('/clusters'), false);
  }
});
