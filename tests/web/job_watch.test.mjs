import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Refused, Unreachable } from '../../web/failures.js';
import { JobWatch, hasEnded } from '../../web/job_watch.js';
import { FakeClock, settle } from './fake_clock.mjs';

/** @typedef {import('../../web/job_watch.js').Job} Job */

/** An EventSource whose events the test sends. */
class Line {
  closed = false;
  /** @type {Map<string, (event: any) => void>} */ #listeners = new Map();

  /**
   * @param {string} kind
   * @param {(event: any) => void} listener
   */
  addEventListener(kind, listener) {
    this.#listeners.set(kind, listener);
  }

  close() {
    this.closed = true;
  }

  /**
   * @param {string} kind
   * @param {unknown} [data]
   */
  send(kind, data) {
    this.#listeners.get(kind)?.({ data });
  }
}

/**
 * @param {(() => Promise<Job>)} ask
 * @param {Line | null} line
 */
function bench(ask, line) {
  const clock = new FakeClock();
  /** @type {string[]} */
  const told = [];
  const watch = new JobWatch({
    ask,
    listen: line && (() => line),
    clock,
    tell: ({ state }) => told.push(state),
    failed: (error) => told.push(`failed: ${error}`),
  });
  return { clock, told, watch };
}

const unasked = () => Promise.reject(new Error('nobody should ask'));
/** @param {Job['state']} state */
const job = (state) => ({ id: 1, state });

test('events are told until the job ends', () => {
  const line = new Line();
  const { told } = bench(unasked, line);
  line.send('progress', JSON.stringify(job('queued')));
  line.send('progress', JSON.stringify(job('running')));
  line.send('progress', 'no document');
  line.send('progress', '{"percent":3}');
  line.send('end', JSON.stringify(job('done')));
  line.send('progress', JSON.stringify(job('running')));
  assert.deepEqual(told, ['queued', 'running', 'done']);
  assert.equal(line.closed, true);
});

test('where the line of events breaks, the job is asked for every second', async () => {
  const line = new Line();
  const states = /** @type {Job['state'][]} */ (['running', 'running', 'failed']);
  const { told, clock } = bench(async () => job(states.shift() ?? 'done'), line);
  line.send('error');
  await settle();
  assert.deepEqual(told, ['running']);
  await clock.pass(1000);
  await clock.pass(1000);
  assert.deepEqual(told, ['running', 'running', 'failed']);
  assert.deepEqual(clock.waiting, []);
  assert.equal(line.closed, true);
});

test('without events the job is asked for at once; a server that is away is asked again', async () => {
  let calls = 0;
  const { told, clock } = bench(async () => {
    if (++calls === 1) throw new Unreachable('gone');
    return job('done');
  }, null);
  await settle();
  assert.deepEqual(told, []);
  await clock.pass(1000);
  assert.deepEqual(told, ['done']);
});

test('a job that the server does not know is followed no more', async () => {
  const { told, clock } = bench(() => Promise.reject(new Refused(404, 'there is no job 1', 'unknown_job')), null);
  await settle();
  assert.deepEqual(told, ['failed: Refused: there is no job 1']);
  assert.deepEqual(clock.waiting, []);
});

test('a watch that was stopped tells nothing', async () => {
  const { told, watch, clock } = bench(async () => job('running'), null);
  watch.stop();
  await settle();
  assert.deepEqual(told, []);
  assert.deepEqual(clock.waiting, []);
});

test('three states are ends', () => {
  const states = /** @type {const} */ (['queued', 'running', 'done', 'failed', 'cancelled']);
  assert.deepEqual(states.filter((state) => hasEnded(job(state))), ['done', 'failed', 'cancelled']);
});
