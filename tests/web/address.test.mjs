import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fromFragment, stopFromFragment, stopToFragment, toFragment } from '../../web/address.js';

/** @typedef {import('../../web/address.js').Shared} Shared */
/** @typedef {import('../../web/address.js').Stop} Stop */

test('an address gives back the search it was made from', () => {
  for (const search of /** @type {Shared[]} */ ([
    { id: 1, profile: 'scanned', options: {} },
    { id: 9007199254740991, profile: 'my-profile.2', options: { orientations: 'all' } },
    { signature: 'AbC_-09+/==&id=7#?%', profile: 'painted', options: {} },
    {
      signature: 'x',
      profile: 'painted',
      options: {
        orientations: 'mirror', autocrop: true, partial: true, aspect: 'some', text: 'a & b=c',
        tags: 'one,two', combine: ['lab', 'rgb'], combineBy: 'worst',
      },
    },
  ])) {
    assert.deepEqual(fromFragment(toFragment(search)), search, toFragment(search));
  }
});

test('the plain search leaves no trace in its address', () => {
  assert.equal(toFragment({ id: 7, profile: 'scanned', options: {} }), '#id=7&profile=scanned');
  assert.equal(toFragment({ id: 7, profile: 'scanned' }), '#id=7&profile=scanned');
});

test('the profile may be left out', () => {
  assert.deepEqual(fromFragment('#id=7'), { id: 7, profile: 'scanned', options: {} });
  assert.deepEqual(fromFragment('signature=xyz'), { signature: 'xyz', profile: 'painted', options: {} });
});

test('what is no address of a search is none', () => {
  for (const fragment of [
    '', '#', '#top', '#id=', '#id=0', '#id=-3', '#id=1.5', '#id=1e3', '#id=9007199254740992',
    '#signature=', '#id=1&signature=x', '#id=1&profile=a%20b', '#id=1&profile=',
    `#signature=${'x'.repeat(8001)}`, '#overview=24', '#id=1&orientations=none',
    '#id=1&autocrop=false', '#id=1&aspect=3', '#id=1&text=', `#id=1&tags=${'x'.repeat(501)}`,
    '#id=1&combine=', '#id=1&combine=a,a', '#id=1&combine=a%20b', '#id=1&combine=a,b,c,d,e,f,g,h',
    '#id=1&combine_by=mean',
  ]) {
    assert.equal(fromFragment(fragment), null, fragment);
  }
});

test('a screen has an address', () => {
  for (const stop of /** @type {Stop[]} */ ([
    { screen: 'overview', count: 1 },
    { screen: 'overview', count: 100 },
    { screen: 'duplicates', level: 'all' },
    { screen: 'duplicates', level: 'near' },
  ])) {
    assert.deepEqual(stopFromFragment(stopToFragment(stop)), stop);
  }
});

test('what is no address of a screen is none', () => {
  for (const fragment of [
    '', '#', '#overview', '#overview=', '#overview=0', '#overview=101', '#overview=1e1', '#overview=all',
    '#duplicates', '#duplicates=', '#duplicates=far', '#duplicates=3', '#id=1',
  ]) {
    assert.equal(stopFromFragment(fragment), null, fragment);
  }
});
