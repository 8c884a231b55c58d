import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Connection } from '../../web/connection.js';
import { FakeClock, settle } from './fake_clock.mjs';

/** @param {() => number} [random] */
function bench(random = () => 1) {
  const clock = new FakeClock();
  const server = { alive: false, asked: 0 };
  const connection = new Connection(
    async () => {
      ++server.asked;
      return server.alive;
    },
    clock,
    random,
  );
  /** @type {string[]} */
  const told = [];
  for (const type of ['lost', 'back']) {
    connection.addEventListener(type, () => told.push(type));
  }
  return { clock, server, connection, told };
}

test('asks less and less often, at most every quarter of a minute', async () => {
  const { clock, connection } = bench();
  connection.lose();
  const delays = [];
  for (let i = 0; i < 7; ++i) {
    const [delay] = clock.waiting;
    delays.push(delay);
    await clock.pass(delay);
  }
  assert.deepEqual(delays, [1000, 2000, 4000, 8000, 15000, 15000, 15000]);
});

test('spreads the moments, so that not every page asks at once', () => {
  const { clock, connection } = bench(() => 0);
  connection.lose();
  assert.deepEqual(clock.waiting, [750]);
});

test('comes back by itself when the server answers', async () => {
  const { clock, server, connection, told } = bench();
  connection.lose();
  connection.lose();
  assert.deepEqual(told, ['lost']);
  server.alive = true;
  await clock.pass(1000);
  assert.deepEqual(told, ['lost', 'back']);
  assert.equal(connection.lost, false);
  assert.deepEqual(clock.waiting, []);
});

test('a second loss starts with short waits again', async () => {
  const { clock, connection } = bench();
  connection.lose();
  await clock.pass(1000);
  await clock.pass(2000);
  connection.recover();
  connection.lose();
  assert.deepEqual(clock.waiting, [1000]);
});

test('asking by hand does not wait, and does not ask twice at a time', async () => {
  const { server, connection, told } = bench();
  await connection.ask();
  assert.equal(server.asked, 0);
  connection.lose();
  server.alive = true;
  void connection.ask();
  void connection.ask();
  await settle();
  assert.equal(server.asked, 1);
  assert.deepEqual(told, ['lost', 'back']);
});

test('an answer to something else ends the waiting', async () => {
  const { clock, connection, told } = bench();
  connection.recover();
  assert.deepEqual(told, []);
  connection.lose();
  connection.recover();
  assert.deepEqual(told, ['lost', 'back']);
  assert.deepEqual(clock.waiting, []);
});
