/** The wake: what is read off water on a grid, and where that is. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Dye, dyeStrength} from '#page/dye.js';
import {MovingTank} from '#page/moving-tank.js';
import {decodeWater, isWater} from '#page/protocol.js';
import {contents, waterShown} from '#page/scene.js';
import {velocityAt, vorticesOf, vorticityAt} from '#page/vorticity.js';
import {Wake} from '#page/wake.js';

const OPEN = [false, false, false];

/** Water of so many cells of width 0.1 from a corner, with a velocity at each place. */
function water(cells, corner, flow) {
  const count = cells[0] * cells[1] * cells[2];
  const velocity = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) {
    const at = [i % cells[0], Math.floor(i / cells[0]) % cells[1], Math.floor(i / cells[0] / cells[1])];
    velocity.set(flow(...at.map((one, axis) => corner[axis] + 0.1 * (one + 0.5))), 3 * i);
  }
  return {scene: 1, frame: 0, time: 0, cells, cell: 0.1, corner, velocity, density: new Float32Array(count).fill(1), origin: [0, 0, 0]};
}

function near(one, other) {
  assert.ok(Math.abs(one - other) < 1e-4, `${one} is not ${other}`);
}

/** About +y from z to x: to the left as seen from above, where z goes down. */
test('what turns like a wheel has twice its rate as vorticity, and Q of its square', () => {
  const wheel = water([8, 4, 6], [1, 2, 3], (x, y, z) => [0.5 * z, 0, -0.5 * x]);

  vorticityAt(wheel, 2.17).forEach(value => near(value, 1));
  const {q, turns} = vorticesOf(wheel);
  q.forEach(value => near(value, 0.25));
  turns.forEach(value => near(value, 1));
});

test('what strains has no vorticity, and Q below 0', () => {
  const strain = water([6, 1, 6], [0, 0, 0], (x, y, z) => [0.5 * z, 0, 0.5 * x]);

  vorticityAt(strain, 0.5).forEach(value => near(value, 0));
  vorticesOf(strain).q.forEach(value => near(value, -0.25));
});

test('a slice between two layers lies between them', () => {
  const twisted = water([4, 2, 4], [0, 0, 0], (x, y, z) => [10 * y * z, 0, 0]);

  near(vorticityAt(twisted, 0.125)[5], 1.25);
});

test('nothing is derived across a surface', () => {
  for (const isWet of [x => x < 3, x => x >= 3]) {
    const half = water([6, 6, 6], [0, 0, 0], x => [0, 0, -2 * x]);
    half.density.forEach((_, i) => {
      half.density[i] = isWet(i % 6) ? 1 : 0;
      half.velocity[3 * i + 2] *= half.density[i];
    });

    const along = Array.from(vorticityAt(half, 0.35).subarray(12, 18));
    along.forEach((value, x) => near(value, isWet(x) && [1, 4].includes(x) || x === (isWet(0) ? 0 : 5) ? 2 : 0));
  }
});

test('Q is the second invariant of the gradient', () => {
  const gradient = [[0.3, -0.7, 1.1], [0.9, 0.2, -0.4], [-0.6, 1.3, -0.5]];
  const linear = water([4, 4, 4], [0, 0, 0], (...place) => gradient.map(row => row.reduce((sum, one, k) => sum + one * place[k], 0)));
  const trace = gradient.reduce((sum, row, i) => sum + row.reduce((part, one, k) => part + one * gradient[k][i], 0), 0);

  vorticesOf(linear).q.forEach(value => near(value, -trace / 2));
});

test('velocity is interpolated, and goes on where a tank closes up with itself', () => {
  const shear = water([4, 1, 4], [0, 0, 0], (x, y, z) => [z, 0, x]);
  const at = (place, wraps) => velocityAt(shear, place, wraps, new Float32Array(3));

  near(at([0.1, 0.05, 0.17], OPEN)[0], 0.17);
  near(at([0.1, 0.05, 0.17], OPEN)[2], 0.1);
  assert.deepEqual(Array.from(at([0.5, 0.05, 0.2], OPEN)), [0, 0, 0]);
  near(at([0.5, 0.05, 0.2], [true, false, false])[2], at([0.1, 0.05, 0.2], OPEN)[2]);
});

/** Two columns that turn, one either way, around (0.53, 0.83) and (1.47, 0.83). */
test('vortices are surrounded, each with the sign of how it turns', () => {
  const wake = new Wake();
  wake.setScene({restarted: true});
  wake.show('vortices');
  const swirl = (x, z) => Math.exp(-30 * (x * x + z * z));
  wake.setWater(water([20, 8, 16], [0, 0, 0], (x, y, z) => {
    const [one, other] = [swirl(x - 0.53, z - 0.83), swirl(x - 1.47, z - 0.83)];
    return [one * (z - 0.83) - other * (z - 0.83), 0, -one * (x - 0.53) + other * (x - 1.47)];
  }), [1, 0.4, 0.8]);

  const {vertices, triangles, turns} = wake.vortices;
  assert.ok(triangles.length > 60, String(triangles.length));
  turns.forEach((turn, i) => {
    const x = vertices[3 * i];
    assert.ok(turn > 0 === x < 1 && Math.abs(x - (x < 1 ? 0.5 : 1.5)) < 0.2, `${turn} at ${x}`);
  });
  assert.ok(wake.range[1] > 0.5 && wake.range[1] <= 2 && wake.range[0] === -wake.range[1], String(wake.range));
});

test('a slice is where its tank has moved to, around the body along a periodic axis', () => {
  const wake = new Wake();
  wake.setScene({restarted: true, periodic: {x: [0, 2]}});
  wake.show('vorticity');

  wake.setWater({...water([20, 1, 8], [0, 0, 0], (x, y, z) => [z, 0, 0]), origin: [0, 0, 0.5]}, [3.5, 0.05, 0.9]);

  const {from, to, low, height} = wake.slice;
  [[from, [2.5, 0.5]], [to, [4.5, 1.3]], [low, [0, 0.5]]].forEach(([found, wanted]) => found.forEach((one, i) => near(one, wanted[i])));
  near(height, 0.05);
});

test('a tank that moves along leaves the swimmer where it is over ground', () => {
  const tank = new MovingTank();
  tank.setScene({restarted: true, body: [0], definition: {movingTank: {along: 'xz', step: 0.2}}});
  const frame = (time, distance, x, z) => {
    const one = {time, distance, velocity: [1, 0, 0.5], position: Float32Array.of(x, 0, z, 9, 9, 9)};
    tank.follow(one);
    return [...one.origin, one.position[0], one.position[2]];
  };

  const places = [frame(0, 0, 1, 1), frame(0.1, 0.1, 1.1, 1.05), frame(0.2, 0.2, 1, 0.9), frame(0.5, 0.5, 1.1, 1.05)];

  const wanted = [[0, 0, 0, 1, 1], [0, 0, 0, 1.1, 1.05], [0.2, 0, 0.2, 1.2, 1.1], [0.4, 0, 0.2, 1.5, 1.25]];
  places.forEach((place, i) => place.forEach((one, k) => near(one, wanted[i][k])));
  [[0.2, [0.2, 0, 0.2]], [0.32, [0.2, 0, 0.2]], [0.42, [0.4, 0, 0.2]], [0.5, [0.4, 0, 0.2]]].forEach(([time, origin]) =>
    tank.originAt(time).forEach((one, axis) => near(one, origin[axis])));
});

test('water is read byte for byte, and told from a frame', () => {
  const buffer = new ArrayBuffer(72 + 16 * 6);
  const bytes = new Uint8Array(buffer);
  const view = new DataView(buffer);
  [...'WATR'].forEach((letter, i) => bytes[i] = letter.charCodeAt(0));
  [3, 250, 3, 1, 2, 0].forEach((value, i) => view.setUint32(8 + 4 * i, value, true));
  [1.25, 0.1, -1, 0.5, 2].forEach((value, i) => view.setFloat64(32 + 8 * i, value, true));
  for (let i = 0; i < 24; i++) {
    view.setFloat32(72 + 4 * i, i, true);
  }

  assert.ok(isWater(buffer));
  assert.ok(!isWater(buffer.slice(8)));
  const {velocity, density, ...head} = decodeWater(buffer);
  assert.deepEqual(head, {scene: 3, frame: 250, time: 1.25, cells: [3, 1, 2], cell: 0.1, corner: [-1, 0.5, 2]});
  assert.deepEqual([...velocity, ...density], Array.from({length: 24}, (_, i) => i));
});

test('what is shown of the water is what the scene has', () => {
  const scene = (particles, scheme, fluid) => ({fluid: [0, particles], scheme, definition: {fluid}, muscles: [], body: [], particles});
  const pool = scene(100, 'conserving', {count: [10, 2, 5]});
  const lake = scene(0, 'lattice', {count: [10, 10, 10]});
  const plane = scene(0, 'lattice', {count: [10, 1, 10]});
  const vacuum = scene(0, 'conserving', null);
  const shown = ['spheres', 'surface', 'vorticity', 'vortices', 'none'].map(asked =>
    [pool, lake, plane, vacuum].map(one => waterShown(asked, contents([one]))));

  assert.deepEqual(shown, [
    ['spheres', 'vorticity', 'vorticity', 'none'], ['surface', 'vorticity', 'vorticity', 'none'],
    ['vorticity', 'vorticity', 'vorticity', 'none'], ['vortices', 'vortices', 'vorticity', 'none'], ['none', 'none', 'none', 'none'],
  ]);
  assert.equal(contents([{...pool, definition: undefined}]).wake, false, 'recordings have none');
});

/** A tail that goes forwards at 1 through water that flows back at 0.5. */
test('dye comes out behind the tail and goes along with the water', () => {
  const dye = new Dye();
  dye.setScene({restarted: true, slices: [[0], [1]]});
  const stream = water([40, 1, 4], [-2, 0, 0], () => [-0.5, 0, 0]);
  const at = time => dye.update({time, position: Float32Array.of(1 + time, 0.05, 0.2, 0.5 + time, 0.05, 0.2)}, stream);

  for (let frame = 0; frame <= 60; frame++) {
    at(frame / 60);
  }

  assert.ok(dye.count > 290 && dye.count <= 301, String(dye.count));
  for (let i = 0; i < dye.count; i++) {
    const place = 0.35 + dye.born[i] - 0.5 * (1 - dye.born[i]);
    assert.ok(Math.abs(dye.places[3 * i] - place) < 0.02, `${dye.places[3 * i]} is not ${place}`);
  }
  assert.ok(dyeStrength(0) === 1 && dyeStrength(100) === 0);
  at(0.5);
  assert.equal(dye.count, 0, 'begins anew');
});
