// Mouse, pen and touch on the canvas as one kind of stroke, in canvas pixels.
//
// One pointer draws at a time: a second finger or a palm beside the pen is ignored. A pen's
// pressure narrows the brush and its other end erases; a mouse draws at full width.

/** @typedef {import('./stroke.js').PenPoint} PenPoint */
/**
 * @typedef {object} PointerHandlers
 * @property {(point: PenPoint, how: {erase: boolean, pick: boolean}) => void} start
 * @property {(points: PenPoint[]) => void} move
 * @property {() => void} end
 * @property {() => void} cancel
 */

const kPenEraserButton = 5;

/**
 * @param {HTMLCanvasElement} canvas
 * @param {PointerHandlers} handlers
 */
export function listenToPointers(canvas, handlers) {
  /** @type {number | null} */
  let drawing = null;

  canvas.addEventListener('pointerdown', (event) => {
    if (drawing !== null || (event.button !== 0 && event.button !== kPenEraserButton)) return;
    event.preventDefault(); // no text selection, no drag of the canvas
    canvas.focus({ preventScroll: true });
    drawing = event.pointerId;
    canvas.setPointerCapture(drawing);
    const erase = event.button === kPenEraserButton;
    handlers.start(toPoint(canvas, event), { erase, pick: event.altKey });
  });

  canvas.addEventListener('pointermove', (event) => {
    if (event.pointerId !== drawing) return;
    // Only secure origins have coalesced events; elsewhere the event itself is all there is.
    const events = event.getCoalescedEvents?.() ?? [];
    handlers.move((events.length > 0 ? events : [event]).map((e) => toPoint(canvas, e)));
  });

  /** @param {PointerEvent} event */
  const finish = (event) => {
    if (event.pointerId !== drawing) return;
    drawing = null;
    if (event.type === 'pointercancel') handlers.cancel();
    else handlers.end();
  };
  canvas.addEventListener('pointerup', finish);
  canvas.addEventListener('pointercancel', finish);
}

/**
 * @param {HTMLCanvasElement} canvas
 * @param {MouseEvent} event
 */
export function toCanvas(canvas, event) {
  const box = canvas.getBoundingClientRect();
  return {
    x: ((event.clientX - box.left) / box.width) * canvas.width,
    y: ((event.clientY - box.top) / box.height) * canvas.height,
  };
}

/**
 * @param {HTMLCanvasElement} canvas
 * @param {PointerEvent} event
 * @returns {PenPoint}
 */
function toPoint(canvas, event) {
  const pressure = event.pointerType === 'pen' ? event.pressure : 1;
  return { ...toCanvas(canvas, event), pressure };
}
