/** The wake: what is read off water on a grid, and where that is. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Dye, dyeStrength} from '#page/dye.js';
import {Forces} from '#page/forces.js';
import {MovingTank} from '#page/moving-tank.js';
import {decodeWater, isWater} from '#page/protocol.js';
import {contents, waterShown} from '#page/scene.js';
import {planeOf, smoothed, velocityAt, vorticesOf} from '#page/vorticity.js';
import {SkinPressure} from '#page/skin-pressure.js';
import {largeParts} from '#page/surface-net.js';
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

  planeOf(wheel, 'vorticity', 1, 2.17).forEach(value => near(value, 1));
  const {q, turns} = vorticesOf(wheel);
  q.forEach(value => near(value, 0.25));
  turns.forEach(value => near(value, 1));
});

test('on a plane across any axis vorticity is that about it, and velocity the speed', () => {
  const wheels = [(x, y, z) => [0, -0.5 * z, 0.5 * y], (x, y, z) => [0.5 * z, 0, -0.5 * x], (x, y) => [-0.5 * y, 0.5 * x, 0]];
  wheels.forEach((wheel, about) => {
    const turning = water([5, 4, 6], [1, 2, 3], wheel);
    for (let axis = 0; axis < 3; axis++) {
      const found = planeOf(turning, 'vorticity', axis, [1.2, 2.2, 3.2][axis]);
      assert.equal(found.length, [24, 30, 20][axis]);
      found.forEach(value => near(value, axis === about ? 1 : 0));
    }
  });
  const speeds = planeOf(water([5, 4, 6], [0, 0, 0], (x, y, z) => [3 * z, 4 * z, 0]), 'velocity', 0, 0.25);
  near(speeds[4 * 5 + 2], 5 * 0.55);
});

test('of the pressure what stands in resting water is taken off', () => {
  const still = water([4, 5, 6], [0, 0, 0], () => [0, 0, 0]);
  const height = i => 0.1 * (Math.floor(i / 4) % 5 + 0.5);
  const along = i => 0.1 * (i % 4 + 0.5);
  still.pressure = Float32Array.from(still.density, (_, i) => 9.81 * (0.5 - height(i)) + 3 * along(i));
  [0, 7].forEach(i => {
    still.density[i] = 0;
    still.pressure[i] = NaN;
  });

  const level = planeOf(still, 'pressure', 1, 0.4);
  level.forEach((value, i) => near(value, 3 * (0.1 * (i % 4 + 0.5) - 0.2)));
  const across = planeOf(still, 'pressure', 0, 0.05);
  assert.equal(across[0], 0, 'not known');
  near(across.at(-1), -0.45);
});

/** Two parts, the second of which shares a particle with the first; two more particles in water that is not theirs. */
test('the force on each part is the sum over its particles, and all parts together the force on the body', () => {
  const forces = new Forces();
  const seen = [];
  forces.onRange = range => seen.push(range[1]);
  forces.isShown = true;
  forces.setScene({restarted: true, particles: 6, fluid: [4, 2], body: [0, 1, 2, 3], clusters: [[0, 1], [1, 2, 3]], slices: [[0], [1], [2, 3]],
    joints: [1], bodyLength: 2, mass: []});
  const force = Float32Array.from([1, 0, 0, 0, 2, 0, 0, 0, 3, -4, 0, 0, 9, 9, 9, 9, 9, 9]);
  forces.update({position: Float32Array.from([0, 0, 0, 1, 0, 0, 2, 0, -1, 2, 0, 1, 5, 5, 5, 5, 5, 5]), force});

  assert.deepEqual(forces.forces, [[1, 2, 0], [-4, 0, 3]]);
  const {from, to} = forces.arrows;
  assert.deepEqual([...from], [0.5, 0, 0, 2, 0, 0]);
  assert.deepEqual(seen, [6], 'a round number');
  [...to].forEach((one, i) => near(one, from[i] + 0.4 * 2 / 6 * forces.forces.flat()[i]));
  forces.update({position: new Float32Array(18), force: null});
  assert.equal(forces.arrows.from.length, 0, 'where they are not known');
});

/** Pressure that grows to the right, in plane flow: on the right of the body, and behind it, it is above 0. */
test('pressure on the body is that of the water outside of it', () => {
  const pressure = new SkinPressure();
  pressure.isShown = true;
  pressure.setScene({restarted: true, slices: [[0, 1], [2, 3]], solidRestDistance: 0.2, bodyLength: 0.1, clusters: [], body: [0, 1, 2, 3]});
  const still = water([10, 1, 20], [0, 0, 0], () => [0, 0, 0]);
  still.pressure = Float32Array.from(still.density, (_, i) => 2 * (0.1 * (Math.floor(i / 10) + 0.5)));
  pressure.setWater(still, Float32Array.from([0.4, 0.05, 0.9, 0.4, 0.05, 1.1, 0.5, 0.05, 0.9, 0.5, 0.05, 1.1]));

  const outside = 0.1 + 0.5 * 0.1 + 0.15;
  [-1, 1, -1, 1].forEach((side, i) => near(pressure.shares[i], side * 2 * outside / 0.6));
  near(pressure.share([0.4, 0.05, 1.2], [0, 0, 1]), 1);
  near(pressure.share([0.4, 0.05, 1.05], [0, 0, 1]), 2 * 0.2 / 0.6);
  near(pressure.share([0.4, 0.05, 1], [1, 0, 0]), 0);
});

test('arrows of the flow lie on the plane, as long as the speed, and wander with it', () => {
  const wake = new Wake();
  wake.setScene({restarted: true, bodyLength: 1});
  wake.show('velocity', 'along', 0.25);
  wake.setWater(water([10, 8, 12], [0, 0, 0], (x, y, z) => [z, 0, 5]), [0.5, 0.4, 0.4]);

  const {axis, height, arrows: {from, to}} = wake.slice;
  assert.deepEqual([axis, wake.range[0]], [2, 0]);
  near(height, 0.65);
  for (let i = 0; i < from.length; i += 3) {
    near(from[i + 2], 0.65);
    near(to[i + 2], 0.65);
    near(to[i] - from[i], 1.5 * 0.1 * 0.65 / wake.range[1]);
  }
  assert.equal(from.length, 3 * 80);
  wake.show('velocity', 'along', -5);
  near(wake.slice.height, 0.05);
});

test('what strains has no vorticity, and Q below 0', () => {
  const strain = water([6, 1, 6], [0, 0, 0], (x, y, z) => [0.5 * z, 0, 0.5 * x]);

  planeOf(strain, 'vorticity', 1, 0.5).forEach(value => near(value, 0));
  vorticesOf(strain).q.forEach(value => near(value, -0.25));
});

test('a slice between two layers lies between them', () => {
  const twisted = water([4, 2, 4], [0, 0, 0], (x, y, z) => [10 * y * z, 0, 0]);

  near(planeOf(twisted, 'vorticity', 1, 0.125)[5], 1.25);
});

test('nothing is derived across a surface', () => {
  for (const isWet of [x => x < 3, x => x >= 3]) {
    const half = water([6, 6, 6], [0, 0, 0], x => [0, 0, -2 * x]);
    half.density.forEach((_, i) => {
      half.density[i] = isWet(i % 6) ? 1 : 0;
      half.velocity[3 * i + 2] *= half.density[i];
    });

    const along = Array.from(planeOf(half, 'vorticity', 1, 0.35).subarray(12, 18));
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
  wake.setScene({restarted: true, particles: 1, fluid: [0, 0], slices: [], solidRestDistance: 0.2});
  wake.show('vortices');
  const swirl = (x, z) => Math.exp(-30 * (x * x + z * z));
  wake.setWater(water([20, 8, 16], [0, 0, 0], (x, y, z) => {
    const [one, other] = [swirl(x - 0.53, z - 0.83), swirl(x - 1.47, z - 0.83)];
    return [one * (z - 0.83) - other * (z - 0.83), 0, -one * (x - 0.53) + other * (x - 1.47)];
  }), [1, 0.4, 0.8], Float32Array.from([1.47, 0.4, 1.2]));

  const {vertices, triangles, normals, turns} = wake.vortices;
  assert.ok(triangles.length > 60, String(triangles.length));
  turns.forEach((turn, i) => {
    const x = vertices[3 * i];
    const out = [x - (x < 1 ? 0.53 : 1.47), vertices[3 * i + 2] - 0.83];
    assert.ok(Math.abs(normals[3 * i + 1]) > 0.5 || out[0] * normals[3 * i] + out[1] * normals[3 * i + 2] > 0, 'outwards');
    assert.ok(turn > 0 === x < 1 && Math.abs(x - (x < 1 ? 0.5 : 1.5)) < 0.2, `${turn} at ${x}`);
  });
  const [nearest] = [...turns.keys()].map(i => Math.hypot(vertices[3 * i] - 1.47, vertices[3 * i + 1] - 0.4, vertices[3 * i + 2] - 1.2)).sort((a, b) => a - b);
  assert.ok(nearest > 0.1, `a vortex is ${nearest} from a body`);
  assert.ok(wake.range[1] > 0.5 && wake.range[1] <= 2 && wake.range[0] === -wake.range[1], String(wake.range));
});

test('what changes from cell to cell is smoothed away, and what grows evenly stays', () => {
  const flow = water([8, 6, 6], [0, 0, 0], (x, y, z) => [x + 2 * y - z, Math.round(10 * x + 0.5) % 2, 1]);
  const {velocity} = smoothed(flow);

  for (let i = 0; i < flow.density.length; i++) {
    const at = [i % 8, Math.floor(i / 8) % 6, Math.floor(i / 48)];
    if (at.every((one, axis) => one > 0 && one + 1 < flow.cells[axis])) {
      near(velocity[3 * i], flow.velocity[3 * i]);
      near(velocity[3 * i + 1], 0.5);
    }
    near(velocity[3 * i + 2], 1);
  }
});

test('parts of a surface that are small against the largest are left out', () => {
  const vertices = new Float32Array(3 * 9);
  const triangles = Uint32Array.from([0, 1, 2, 6, 7, 8, 1, 2, 3, 3, 4, 5]);

  vertices.set([1, 2, 3], 3 * 8);
  const all = largeParts({vertices, triangles}, 0.5);
  assert.deepEqual([[...all.triangles], [...all.vertices]], [[...triangles], [...vertices]]);
  const large = largeParts({vertices, triangles}, 0.6);
  assert.deepEqual([...large.triangles], [0, 1, 2, 1, 2, 3, 3, 4, 5]);
  assert.equal(large.vertices.length, 3 * 6);
  const other = largeParts({vertices, triangles: triangles.map(one => (one + 3) % 9)}, 0.6);
  assert.deepEqual([...other.triangles], [0, 1, 2, 1, 2, 3, 3, 4, 5]);
  assert.deepEqual([...other.vertices.slice(-3)], [1, 2, 3]);
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
  assert.deepEqual(head, {scene: 3, frame: 250, time: 1.25, cells: [3, 1, 2], cell: 0.1, corner: [-1, 0.5, 2], pressure: null});
  assert.deepEqual([...velocity, ...density], Array.from({length: 24}, (_, i) => i));

  const pressed = new ArrayBuffer(72 + 20 * 6);
  new Uint8Array(pressed).set(bytes);
  new DataView(pressed).setUint32(28, 1, true);
  new DataView(pressed).setFloat32(72 + 16 * 6, 7, true);
  assert.deepEqual([...decodeWater(pressed).pressure], [7, 0, 0, 0, 0, 0]);
});

test('what is shown of the water is what the scene has', () => {
  const scene = (particles, scheme, fluid) => ({fluid: [0, particles], scheme, definition: {fluid}, muscles: [], body: [], particles});
  const pool = scene(100, 'conserving', {count: [10, 2, 5]});
  const lake = scene(0, 'lattice', {count: [10, 10, 10]});
  const plane = scene(0, 'lattice', {count: [10, 1, 10]});
  const vacuum = scene(0, 'conserving', null);
  const shown = ['spheres', 'surface', 'vorticity', 'velocity', 'pressure', 'vortices', 'none'].map(asked =>
    [pool, lake, plane, vacuum, {...lake, fields: ['position', 'force']}].map(one => waterShown(asked, contents([one]))));

  assert.deepEqual(shown, [
    ['spheres', 'vortices', 'vorticity', 'none', 'vortices'], ['surface', 'vortices', 'vorticity', 'none', 'vortices'],
    ['vorticity', 'vorticity', 'vorticity', 'none', 'vorticity'], ['velocity', 'velocity', 'velocity', 'none', 'velocity'],
    ['vortices', 'vortices', 'vorticity', 'none', 'pressure'], ['vortices', 'vortices', 'vorticity', 'none', 'vortices'],
    ['none', 'none', 'none', 'none', 'none'],
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
