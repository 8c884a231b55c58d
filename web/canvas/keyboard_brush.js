// Painting without a pointer: arrow keys move a cursor over the canvas, Space or Enter puts
// the brush down and lifts it again. A toggle, so that no two keys must be held at once.

/** @typedef {{x: number, y: number}} Point */

/** Canvas pixels that one arrow key moves: fine with Alt, coarse with Shift. */
const kStep = 12;
const kFineStep = 2;
const kCoarseStep = 48;

/** @type {Record<string, [number, number]>} */
const kDirections = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/**
 * Where a key takes the cursor.
 * @param {Point} from
 * @param {{key: string, shiftKey: boolean, altKey: boolean}} event
 * @param {{width: number, height: number}} canvas
 * @returns {Point | null} null if the key is no arrow
 */
export function moveCursor(from, event, canvas) {
  const direction = kDirections[event.key];
  if (!direction) return null;
  const step = event.altKey ? kFineStep : event.shiftKey ? kCoarseStep : kStep;
  return {
    x: Math.min(canvas.width, Math.max(0, from.x + direction[0] * step)),
    y: Math.min(canvas.height, Math.max(0, from.y + direction[1] * step)),
  };
}

/**
 * @typedef {object} KeyboardHandlers
 * @property {(point: Point) => void} move the cursor stands elsewhere
 * @property {(point: Point) => boolean} press Space or Enter; whether the brush is now down
 * @property {(point: Point) => void} draw moved with the brush down
 * @property {() => void} lift
 */

/**
 * @param {HTMLCanvasElement} canvas focusable
 * @param {KeyboardHandlers} handlers
 */
export function listenToKeys(canvas, handlers) {
  let cursor = { x: canvas.width / 2, y: canvas.height / 2 };
  let down = false;

  const lift = () => {
    if (!down) return;
    down = false;
    handlers.lift();
  };

  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey) return;
    const moved = moveCursor(cursor, event, canvas);
    if (moved) {
      cursor = moved;
      handlers.move(cursor);
      if (down) handlers.draw(cursor);
    } else if (event.key === ' ' || event.key === 'Enter') {
      if (event.repeat) return event.preventDefault();
      if (down) lift();
      else {
        handlers.move(cursor);
        down = handlers.press(cursor);
      }
    } else if (event.key === 'Escape') {
      lift();
      return;
    } else {
      return;
    }
    event.preventDefault(); // no scrolling
  });
  canvas.addEventListener('blur', lift);
  canvas.addEventListener('pointerdown', lift, { capture: true });
}
