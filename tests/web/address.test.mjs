import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fromFragment, toFragment } from '../../web/address.js';

test('an address gives back the search it was made from', () => {
  for (const search of [
    { id: 1, profile: 'scanned' },
    { id: 9007199254740991, profile: 'my-profile.2' },
    { signature: 'AbC_-09+/==&id=7#?%', profile: 'painted' },
  ]) {
    assert.deepEqual(fromFragment(toFragment(search)), search, toFragment(search));
  }
});

test('the profile may be left out', () => {
  assert.deepEqual(fromFragment('#id=7'), { id: 7, profile: 'scanned' });
  assert.deepEqual(fromFragment('signature=xyz'), { signature: 'xyz', profile: 'painted' });
});

test('what is no address of a search is none', () => {
  for (const fragment of [
    '', '#', '#top', '#id=', '#id=0', '#id=-3', '#id=1.5', '#id=1e3', '#id=9007199254740992',
    '#signature=', '#id=1&signature=x', '#id=1&profile=a%20b', '#id=1&profile=',
    `#signature=${'x'.repeat(8001)}`,
  ]) {
    assert.equal(fromFragment(fragment), null, fragment);
  }
});
