/** Skins: surfaces that go along with particles. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {BodySkin} from '#page/body-skin.js';
import {surfaceAround} from '#page/body-surface.js';
import {SkinMotion} from '#page/skin.js';

/** The front cluster is moved up by 3; the rear one turned by a right angle about z, and moved by 5 along x. */
test('a skin follows the rigid motion of its clusters', () => {
  const rest = [[1, 0, 0], [2, 0, 0], [1, 1, 0], [1, 0, 1], [-1, 0, 0], [-2, 0, 0], [-1, 1, 0], [-1, 0, 1]];
  const motion = new SkinMotion({body: [8, 1, 2, 3, 4, 5, 6, 7], clusters: [[8, 1, 2, 3], [4, 5, 6, 7]], skin: {
    triangles: [[0, 1, 2]], vertices: [[2, 0, 0], [0, 0.5, 0], [-2, 0, 1]], cluster: [0, 0, 1], share: [1, 0.25, 1], rest}});
  const position = new Float32Array(27);
  rest.forEach(([x, y, z], i) => position.set(i < 4 ? [x, y + 3, z] : [5 - y, x, z], 3 * (i || 8)));

  motion.update({position});

  assert.deepEqual(Array.from(motion.places, place => Math.round(1e4 * place) / 1e4 + 0),
      [2, 3, 0, 3.375, 0.875, 0, 5, -2, 1]);
});

/** With three clusters, of which the last has not moved, the vertex in the middle follows the first and the last. */
test('a skin between regions follows two that need not be neighbours', () => {
  const rest = [[1, 0, 0], [2, 0, 0], [1, 1, 0], [1, 0, 1], [-1, 0, 0], [-2, 0, 0], [-1, 1, 0], [-1, 0, 1]];
  const motion = new SkinMotion({body: [0, 1, 2, 3, 4, 5, 6, 7], clusters: [[0, 1, 2, 3], [1, 2, 3, 4], [4, 5, 6, 7]], skin: {
    triangles: [[0, 0, 0]], vertices: [[0, 0.5, 0]], cluster: [0], other: [2], share: [0.75], rest}});
  const position = new Float32Array(24);
  rest.forEach(([x, y, z], i) => position.set(i < 4 ? [x, y + 3, z] : [x, y, z], 3 * i));

  motion.update({position});

  assert.deepEqual(Array.from(motion.places, place => Math.round(1e4 * place) / 1e4 + 0), [0, 2.75, 0]);
});

/** A block of 6 × 6 × 6 particles, 1 apart: closed, as seen from outside, and about a block of 6³. */
test('a surface is closed around its particles', () => {
  const places = Array.from({length: 216}, (_, i) => [i % 6, Math.floor(i / 6) % 6, Math.floor(i / 36)]);
  const {vertices, triangles} = surfaceAround(places, 1);
  const edges = new Map();
  let volume = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map(k => vertices.subarray(3 * triangles[i + k], 3 * triangles[i + k] + 3));
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
    for (let k = 0; k < 3; k++) {
      const [from, to] = [triangles[i + k], triangles[i + (k + 1) % 3]];
      edges.set(`${from} ${to}`, (edges.get(`${from} ${to}`) ?? 0) + 1);
      edges.set(`${to} ${from}`, (edges.get(`${to} ${from}`) ?? 0) - 1);
    }
  }

  assert.ok(volume > 180 && volume < 240, `volume ${volume}`);
  assert.equal([...edges.values()].filter(count => count !== 0).length, 0, 'edges without a second triangle');
  assert.ok(triangles.length > 1000);
});

/** The body turns by a right angle about z and moves: so does each vertex of its skin. */
test('a skin without a mesh follows its particles', () => {
  const at = (i, turned) => {
    const [x, y, z] = [0.1 * (i % 9), 0.1 * (Math.floor(i / 9) % 3), 0.1 * Math.floor(i / 27)];
    return turned ? [5 - y, x, z] : [x, y, z];
  };
  const frame = turned => ({position: Float32Array.from(Array.from({length: 81}, (_, i) => at(i, turned)).flat())});
  const all = Array.from({length: 81}, (_, i) => i);
  const scene = {particles: 81, fluid: [81, 0], body: all, bodyLength: 0.8, solidRestDistance: 0.2,
    slices: Array.from({length: 9}, (_, slice) => all.filter(i => i % 9 === slice)),
    clusters: [all.filter(i => i % 9 < 5), all.filter(i => i % 9 >= 4)]};
  const skin = new BodySkin(scene, frame(false).position);
  const before = Float32Array.from(skin.places);

  skin.update(frame(true));

  let off = 0;
  for (let i = 0; i < before.length; i += 3) {
    off = Math.max(off, Math.hypot(skin.places[i] - (5 - before[i + 1]), skin.places[i + 1] - before[i],
        skin.places[i + 2] - before[i + 2]));
  }
  assert.ok(before.length > 300);
  assert.ok(off < 1e-4, `farthest off by ${off}, length`);
});
