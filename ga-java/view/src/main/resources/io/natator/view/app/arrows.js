/** Arrows in space, for all ways of drawing. */

/** Half the width of a head, and its length, in half widths of the shaft; the head is at most this share of the arrow. */
export const HEAD = {half: 2.8, length: 6.5, most: 0.6};

/** No arrows. */
export const NO_ARROWS = {from: new Float32Array(0), to: new Float32Array(0)};

/**
 * Adds arrows to the path of a canvas' context, as areas, `half` pixels wide to either side.
 *
 * @param {{from: Float32Array, to: Float32Array}} arrows three numbers each
 */
export function addArrows(context, projector, arrows, half) {
  const {from, to} = arrows;
  const [a, b] = [[0, 0, 0], [0, 0, 0]];
  for (let i = 0; i < from.length; i += 3) {
    projector.project(from[i], from[i + 1], from[i + 2], a, 0);
    projector.project(to[i], to[i + 1], to[i + 2], b, 0);
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (a[2] > 0.05 && b[2] > 0.05 && length > 0) {
      const [x, y] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
      const neck = length - Math.min(HEAD.length * half, HEAD.most * length);
      const corners = [[0, 1], [neck, 1], [neck, HEAD.half], [length, 0], [neck, -HEAD.half], [neck, -1], [0, -1]];
      corners.forEach(([along, side], k) =>
        context[k === 0 ? 'moveTo' : 'lineTo'](a[0] + along * x - side * half * y, a[1] + along * y + side * half * x));
      context.closePath();
    }
  }
}
