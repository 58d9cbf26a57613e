/** Outlines of the bodies of a run, one below another. */

import {byId} from './element.js';
import {draw, short} from './gaitplot.js';

const WIDTH = 320;
const GAP = 14;
/** Height of a line of text. */
const LINE = 16;

/** Shows bodies (BodyOutline.java) from the side and from above, all to one scale; nothing of a run that evolves gaits alone. */
export function showBodies(bodies) {
  byId('bodies-figure').hidden = bodies === null;
  if (bodies === null) {
    return;
  }
  const svg = byId('bodies');
  const scale = (WIDTH - GAP) / 2 / Math.max(...bodies.map(body => body.length));
  const labels = bodies.map(({label, length}) => `${label}, length ${short(length)}`);
  const parts = [];
  let top = 0;
  bodies.forEach(({length, sections, joints}, number) => {
    const half = scale * Math.max(...sections.flatMap(([, height, width]) => [height, width])) / 2;
    const middle = top + LINE + 2 + half;
    parts.push(draw('text', {x: 0, y: top + LINE - 4, class: 'axis'}, labels[number]));
    [1, 2].forEach((extent, i) => {
      const right = i === 0 ? (WIDTH - GAP) / 2 : WIDTH;
      const place = ([part, ...extents], side) =>
          `${(right - scale * length * part).toFixed(1)},${(middle + side * scale * extents[extent - 1] / 2).toFixed(1)}`;
      const around = [...sections.map(one => place(one, -1)), ...sections.map(one => place(one, 1)).reverse()];
      parts.push(draw('polygon', {class: 'outline', points: around.join(' ')}));
      for (const joint of joints) {
        const x = right - scale * length * joint;
        parts.push(draw('line', {class: 'joint', x1: x, x2: x, y1: middle - 3, y2: middle + 3}));
      }
    });
    top = middle + half + 6;
  });
  svg.setAttribute('viewBox', `0 0 ${WIDTH} ${Math.ceil(top)}`);
  svg.setAttribute('aria-label', `Bodies from the side and from above: ${labels.join('; ')}`);
  svg.replaceChildren(...parts);
}
