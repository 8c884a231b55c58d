import assert from 'node:assert/strict';
import { test } from 'node:test';
import { History } from '../../web/canvas/history.js';

/** A number whose changes are remembered. */
function counter({ maxSteps = 100, maxBytes = 1000 } = {}) {
  const history = new History({ maxSteps, maxBytes });
  const state = { value: 0 };
  /** @param {number} to @param {number} [bytes] */
  const set = (to, bytes = 1) => {
    const from = state.value;
    state.value = to;
    history.push({
      undo: () => (state.value = from),
      redo: () => (state.value = to),
      bytes,
    });
  };
  return { history, state, set };
}

test('undo goes back step by step, redo forward again', () => {
  const { history, state, set } = counter();
  for (const value of [1, 2, 3]) set(value);
  const seen = [];
  while (history.undo()) seen.push(state.value);
  assert.deepEqual(seen, [2, 1, 0]);
  while (history.redo()) seen.push(state.value);
  assert.deepEqual(seen, [2, 1, 0, 1, 2, 3]);
});

test('a new step after undo takes redo away', () => {
  const { history, state, set } = counter();
  set(1);
  set(2);
  history.undo();
  set(5);
  assert.equal(history.canRedo, false);
  assert.equal(history.redo(), false);
  history.undo();
  assert.equal(state.value, 1);
});

test('an empty history has nothing to give', () => {
  const { history } = counter();
  assert.deepEqual([history.undo(), history.redo()], [false, false]);
  assert.deepEqual([history.canUndo, history.canRedo], [false, false]);
});

test('the oldest steps are forgotten beyond the number', () => {
  const { history, state, set } = counter({ maxSteps: 3 });
  for (const value of [1, 2, 3, 4, 5]) set(value);
  while (history.undo());
  assert.equal(state.value, 2);
});

test('the oldest steps are forgotten beyond the bytes, the newest never', () => {
  const { history, state, set } = counter({ maxBytes: 10 });
  set(1, 4);
  set(2, 4);
  set(3, 4);
  while (history.undo());
  assert.equal(state.value, 1);
  set(9, 500);
  assert.equal(history.undo(), true);
  assert.equal(state.value, 1);
});

test('bytes of steps that can no longer be redone are free again', () => {
  const { history, state, set } = counter({ maxBytes: 10 });
  set(1, 4);
  set(2, 6);
  history.undo();
  set(3, 6);
  while (history.undo());
  assert.equal(state.value, 0);
});
