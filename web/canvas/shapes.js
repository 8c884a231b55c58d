// The shapes a canvas can have, about equal in area so that brushes keep their worth.

/** @type {Record<string, {width: number, height: number}>} */
const kShapes = {
  landscape: { width: 640, height: 480 },
  wide: { width: 736, height: 414 },
  square: { width: 552, height: 552 },
  portrait: { width: 480, height: 640 },
};

/** @param {string} name */
export function sizeOfShape(name) {
  const size = kShapes[name];
  if (!size) throw new RangeError(`no canvas of the shape ${name}`);
  return size;
}

/**
 * The shape whose ratio of sides is nearest, in octaves.
 * @param {number} width
 * @param {number} height
 */
export function nearestShape(width, height) {
  const wanted = Math.log(width / height);
  /** @param {string} name */
  const distance = (name) => {
    const size = kShapes[name];
    return Math.abs(Math.log(size.width / size.height) - wanted);
  };
  return Object.keys(kShapes).reduce((best, name) =>
    distance(name) < distance(best) ? name : best,
  );
}
