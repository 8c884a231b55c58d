// Undo and redo of steps, bounded in number and in bytes: the oldest steps are forgotten.

/** @typedef {{undo: () => void, redo: () => void, bytes: number}} Step */

export class History {
  /** @type {Step[]} */ #done = [];
  /** @type {Step[]} */ #undone = [];
  #bytes = 0;
  #maxSteps;
  #maxBytes;

  /** @param {{maxSteps: number, maxBytes: number}} limits */
  constructor({ maxSteps, maxBytes }) {
    this.#maxSteps = maxSteps;
    this.#maxBytes = maxBytes;
  }

  get canUndo() {
    return this.#done.length > 0;
  }

  get canRedo() {
    return this.#undone.length > 0;
  }

  /**
   * Remembers a step that has been done; what was undone before can no longer be redone.
   * The newest step is always kept, whatever its size.
   * @param {Step} step
   */
  push(step) {
    for (const lost of this.#undone) this.#bytes -= lost.bytes;
    this.#undone = [];
    this.#done.push(step);
    this.#bytes += step.bytes;
    while (
      this.#done.length > 1 &&
      (this.#done.length > this.#maxSteps || this.#bytes > this.#maxBytes)
    ) {
      this.#bytes -= /** @type {Step} */ (this.#done.shift()).bytes;
    }
  }

  /** @returns {boolean} whether there was anything to undo */
  undo() {
    const step = this.#done.pop();
    if (!step) return false;
    step.undo();
    this.#undone.push(step);
    return true;
  }

  /** @returns {boolean} whether there was anything to redo */
  redo() {
    const step = this.#undone.pop();
    if (!step) return false;
    step.redo();
    this.#done.push(step);
    return true;
  }
}
