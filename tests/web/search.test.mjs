import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Overloaded } from '../../web/failures.js';
import { Search } from '../../web/search.js';
import { FakeClock, settle } from './fake_clock.mjs';

/** @typedef {{name: string, topic: string, settled: boolean}} Query */
/** @typedef {{seq: unknown, text?: string}} Reply */

/** A search whose server answers when the test says so. */
function bench() {
  /** @type {string[]} */
  const log = [];
  /** @type {{query: Query, seq: number, signal: AbortSignal, answer: (reply: Reply) => void, fail: (error: unknown) => void}[]} */
  const calls = [];
  const clock = new FakeClock();
  /** @type {import('../../web/search.js').SearchPort<Query, Reply>} */
  const port = {
    send: (query, seq, signal) =>
      new Promise((answer, fail) => calls.push({ query, seq, signal, answer, fail })),
    started: (query) => log.push(`started ${query.name}`),
    answered: (query, reply) => log.push(`answered ${query.name}: ${reply.text}`),
    failed: (query, error) => log.push(`failed ${query.name}: ${error}`),
    delayed: (query, ms) => log.push(`delayed ${query.name} by ${ms}`),
  };
  return { log, calls, clock, search: new Search(port, clock) };
}

/**
 * @param {string} name
 * @param {Partial<Query>} [rest]
 * @returns {Query}
 */
function wish(name, rest) {
  return { name, topic: 'painting', settled: true, ...rest };
}

test('one request is out at a time, and the latest wish follows it', async () => {
  const { search, calls, log } = bench();
  for (const name of ['a', 'b', 'c', 'd']) search.submit(wish(name));
  assert.deepEqual(calls.map(({ query }) => query.name), ['a']);
  calls[0].answer({ seq: calls[0].seq, text: 'A' });
  await settle();
  assert.deepEqual(calls.map(({ query }) => query.name), ['a', 'd']);
  calls[1].answer({ seq: calls[1].seq, text: 'D' });
  await settle();
  assert.deepEqual(log, ['started a', 'answered a: A', 'started d', 'answered d: D']);
});

test('a wish about something else does not wait, and the old answer is dropped', async () => {
  const { search, calls, log } = bench();
  search.submit(wish('painting'));
  search.submit(wish('picture', { topic: 'id:5' }));
  assert.equal(calls[0].signal.aborted, true);
  assert.equal(calls.length, 2);
  calls[1].answer({ seq: calls[1].seq, text: 'new' });
  await settle();
  calls[0].answer({ seq: calls[0].seq, text: 'old' });
  await settle();
  assert.deepEqual(log, ['started painting', 'started picture', 'answered picture: new']);
});

test('a request that was given up does not report its failure', async () => {
  const { search, calls, log } = bench();
  search.submit(wish('painting'));
  search.submit(wish('picture', { topic: 'id:5' }));
  calls[0].fail(new Error('aborted'));
  await settle();
  assert.deepEqual(log, ['started painting', 'started picture']);
});

test('a reply with another number is not shown', async () => {
  const { search, calls, log } = bench();
  search.submit(wish('a'));
  calls[0].answer({ seq: calls[0].seq + 1, text: 'somebody else' });
  await settle();
  assert.equal(log.length, 2);
  assert.match(log[1], /^failed a: .*stale.*2/);
});

test('numbers rise, and a number that comes back as text is the same', async () => {
  const { search, calls, log } = bench();
  search.submit(wish('a'));
  calls[0].answer({ seq: String(calls[0].seq), text: 'A' });
  await settle();
  search.submit(wish('b'));
  assert.ok(calls[1].seq > calls[0].seq);
  assert.equal(log[1], 'answered a: A');
});

test('wishes in the middle of a stroke are paced, the end of the stroke is not', async () => {
  const { search, calls, clock } = bench();
  search.submit(wish('first', { settled: false }));
  calls[0].answer({ seq: 1 });
  await settle();
  search.submit(wish('second', { settled: false }));
  search.submit(wish('third', { settled: false }));
  assert.equal(calls.length, 1);
  await clock.pass(249);
  assert.equal(calls.length, 1);
  await clock.pass(1);
  assert.deepEqual(calls.map(({ query }) => query.name), ['first', 'third']);
  calls[1].answer({ seq: 2 });
  await settle();
  search.submit(wish('end'));
  assert.equal(calls.length, 3);
});

test('a busy server is left alone for as long as it asks', async () => {
  const { search, calls, clock, log } = bench();
  search.submit(wish('a'));
  calls[0].fail(new Overloaded(2000));
  await settle();
  assert.equal(log[1], 'delayed a by 2000');
  await clock.pass(1999);
  assert.equal(calls.length, 1);
  await clock.pass(1);
  assert.equal(calls[1].query.name, 'a');
});

test('after the wait the newest wish goes out, not the one that was refused', async () => {
  const { search, calls, clock } = bench();
  search.submit(wish('a'));
  calls[0].fail(new Overloaded(2000));
  await settle();
  search.submit(wish('b'));
  assert.equal(calls.length, 1);
  await clock.pass(2000);
  assert.deepEqual(calls.map(({ query }) => query.name), ['a', 'b']);
});

test('a failure is told, and the wish that waited goes out', async () => {
  const { search, calls, log } = bench();
  search.submit(wish('a'));
  search.submit(wish('b'));
  calls[0].fail(new Error('broken'));
  await settle();
  assert.deepEqual(log, ['started a', 'failed a: Error: broken', 'started b']);
});

test('a request without an answer ends after half a minute', async () => {
  const { search, calls, clock, log } = bench();
  search.submit(wish('a'));
  await clock.pass(30_000);
  assert.equal(calls[0].signal.aborted, true);
  assert.equal(log[1], 'failed a: TimedOut: no answer within 30 seconds');
  search.submit(wish('b'));
  assert.equal(calls[1].query.name, 'b');
});

test('the deadline of a request that was answered never strikes', async () => {
  const { search, calls, clock, log } = bench();
  search.submit(wish('a'));
  calls[0].answer({ seq: 1, text: 'A' });
  await settle();
  await clock.pass(60_000);
  assert.deepEqual(log, ['started a', 'answered a: A']);
});

test('again() repeats the last wish, and after stop() there is none', async () => {
  const { search, calls, log } = bench();
  search.again();
  assert.equal(calls.length, 0);
  search.submit(wish('a'));
  calls[0].fail(new Error('gone'));
  await settle();
  search.again();
  assert.equal(calls[1].query.name, 'a');
  search.stop();
  assert.equal(calls[1].signal.aborted, true);
  calls[1].answer({ seq: 2 });
  await settle();
  search.again();
  assert.equal(calls.length, 2);
  assert.equal(log.at(-1), 'started a');
});
