/** Lines and areas in space on a 2-d canvas; what is behind the camera is cut off. */

import {NEAREST} from './projector.js';

/** Adds a line to the path of a canvas' context. */
export function addLine(context, projector, a, b) {
  const depthA = projector.depth(...a);
  const depthB = projector.depth(...b);
  if (depthA < NEAREST && depthB < NEAREST) {
    return;
  }
  const from = depthA < NEAREST ? between(a, b, (NEAREST - depthA) / (depthB - depthA)) : a;
  const to = depthB < NEAREST ? between(b, a, (NEAREST - depthB) / (depthA - depthB)) : b;
  projector.project(...from, PLACE, 0);
  context.moveTo(PLACE[0], PLACE[1]);
  projector.project(...to, PLACE, 0);
  context.lineTo(PLACE[0], PLACE[1]);
}

/** Adds lines that are given as six numbers each. */
export function addLines(context, projector, numbers) {
  for (let i = 0; i < numbers.length; i += 6) {
    addLine(context, projector, numbers.slice(i, i + 3), numbers.slice(i + 3, i + 6));
  }
}

/** Adds an area between corners to the path. */
export function addArea(context, projector, corners) {
  let isFirst = true;
  corners.forEach((corner, i) => {
    const before = corners.at(i - 1);
    const depth = projector.depth(...corner);
    const depthBefore = projector.depth(...before);
    const shown = [];
    if (depth < NEAREST !== depthBefore < NEAREST) {
      shown.push(between(before, corner, (NEAREST - depthBefore) / (depth - depthBefore)));
    }
    if (depth >= NEAREST) {
      shown.push(corner);
    }
    for (const place of shown) {
      projector.project(...place, PLACE, 0);
      context[isFirst ? 'moveTo' : 'lineTo'](PLACE[0], PLACE[1]);
      isFirst = false;
    }
  });
  context.closePath();
}

const PLACE = [0, 0, 0];

function between(a, b, share) {
  return a.map((from, axis) => from + share * (b[axis] - from));
}
