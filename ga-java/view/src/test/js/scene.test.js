/** What is shown of a tank. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {boundsAround, tankBounds, tankLines} from '#page/scene.js';

const scene = {planes: [[0, 1, 0, 0], [0, 0, 1, 0], [0, 0, -1, 1]], periodic: {x: [0, 2]}, body: [0], solidRestDistance: 0.5};

/** A list without a sign of zero. */
function plain(numbers) {
  return Array.from(numbers, number => number + 0);
}

test('a tank without ends along x is shown around the body, and not where it is cut off', () => {
  const start = tankBounds(scene, [0.5, 0.5, 0.5, 1.5, 0.25, 0.25]);
  const later = boundsAround(start, scene, [4.5, 0.5, 0.5, 5.5, 0.25, 0.25]);

  assert.deepEqual([start.min, start.max].map(plain), [[-0.5, 0, 0], [1.5, 1, 1]]);
  assert.deepEqual([later.min, later.max].map(plain), [[3.5, 0, 0], [5.5, 1, 1]]);
  assert.deepEqual(plain(tankLines(later).edges), [
    3.5, 0, 1, 5.5, 0, 1, 3.5, 1, 1, 5.5, 1, 1, 5.5, 0, 0, 3.5, 0, 0, 5.5, 1, 0, 3.5, 1, 0,
  ]);
});

test('a tank with walls has twelve edges', () => {
  const walled = tankBounds({...scene, planes: [...scene.planes, [1, 0, 0, 0], [-1, 0, 0, 2]], periodic: {}}, [0.5, 0.5, 0.5]);

  assert.equal(tankLines(walled).edges.length / 6, 12);
});

test('a tank of cells is as deep as they are', () => {
  const plane = {...scene, scheme: 'lattice', definition: {fluid: {count: [20, 1, 10], spacing: 0.1, origin: [0.05, 0.05, 0.05]}}};

  const {min, max} = tankBounds(plane, [0.5, 0.05, 0.5]);
  assert.deepEqual([min[1], max[1]], [0, 0.1]);
});

test('a periodic tank without a body is shown from its start', () => {
  assert.deepEqual(plain(tankBounds({...scene, body: []}, [0.5, 0.5, 0.5]).min), [0, 0, 0]);
});
