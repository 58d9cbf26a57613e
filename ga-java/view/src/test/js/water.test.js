/** Shapes of the water's surface. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {NearestFirst} from '#page/sort.js';
import {SHAPE_NUMBERS} from '#page/water-numbers.js';
import {WaterShapes} from '#page/water-shape.js';
import {Waterline} from '#page/waterline.js';

/** A block of water 12 wide and 6 high between walls, and a drop high above it. */
test('water is flat at its surface and round at its walls', () => {
  const count = 12 * 6 * 12 + 1;
  const position = new Float32Array(3 * count);
  for (let i = 0; i + 1 < count; i++) {
    position.set([0.05 + 0.1 * (i % 12), 0.05 + 0.1 * (Math.floor(i / 12) % 6), 0.05 + 0.1 * Math.floor(i / 72)], 3 * i);
  }
  position.set([0.6, 2, 0.6], 3 * (count - 1));
  const shapes = new WaterShapes();
  shapes.setScene({fluidRestDistance: 0.1, definition: {solver: {gravity: [0, -10, 0]}}});

  shapes.update(position, null, 0, Uint32Array.from({length: count}, (_, i) => i), count, new Float32Array(count),
      {min: [0, 0, 0], max: [1.2, 1e9, 1.2]});

  const found = Array.from({length: shapes.count}, (_, i) => shapes.numbers.subarray(SHAPE_NUMBERS * i, SHAPE_NUMBERS * (i + 1)));
  const near = (x, y, z) => found.find(one => Math.hypot(one[0] - x, one[1] - y, one[2] - z) < 0.06);
  const top = near(0.55, 0.53, 0.55);
  const side = near(0.05, 0.25, 0.55);
  assert.ok(top[5] < 0.5 * top[4], 'flat on top');
  assert.ok(Math.abs(top[4] / top[6] - 1) < 0.05, 'alike along both walls');
  assert.equal(near(0.55, 0.25, 0.55), undefined, 'nothing inside');
  assert.equal(side[4], side[5], 'a ball at the wall');
  assert.ok(near(0.6, 2, 0.6)[4] < 0.25 * side[4], 'small alone');
});

/** Balls of a surface whose heights vary by chance, at a wall; the rough line is that of the balls where the wall cuts them. */
test('water ends at a wall in a smooth line', () => {
  const spacing = 0.1;
  const walls = {min: [0, 0, 0], max: [1, 1e9, 4]};
  const shapes = [];
  for (let i = 0, seed = 1; i < 40; i++) {
    seed = seed * 16807 % 2147483647;
    const height = 0.5 + 0.02 * Math.sin(i / 6) + 0.03 * seed / 2147483647;
    shapes.push([0.05, height, 0.05 + 0.1 * i, 0, 0.009, 0.004, 0.009, 0, 0, 0, 0, 1]);
  }
  const splash = [0.02, 0.9, 2, 0, 0.001, 0.001, 0.001, 0, 0, 0, 0, 0];
  const count = shapes.push(splash);
  const numbers = new Float32Array(SHAPE_NUMBERS * (count + Waterline.most(walls, spacing)));
  numbers.set(shapes.flat());
  const topAt = (z, first, end) => {
    let top = 0;
    for (let at = SHAPE_NUMBERS * first; at < SHAPE_NUMBERS * end; at += SHAPE_NUMBERS) {
      const share = 1 - numbers[at] ** 2 / numbers[at + 4] - (z - numbers[at + 2]) ** 2 / numbers[at + 6];
      top = Math.max(top, share > 0 ? numbers[at + 1] + Math.sqrt(numbers[at + 5] * share) : 0);
    }
    return top;
  };
  const along = Array.from({length: 64}, (_, i) => 0.4 + 0.05 * i);
  const roughness = (first, end) => along.reduce((sum, z) => sum
      + Math.abs(topAt(z - 0.05, first, end) - 2 * topAt(z, first, end) + topAt(z + 0.05, first, end)), 0);
  const before = roughness(0, count - 1);

  const all = new Waterline().add(numbers, count, walls, spacing);

  assert.ok(roughness(count, all) < 0.2 * before, 'smooth');
  assert.ok(Math.max(...along.map(z => topAt(z, count, all))) < 0.64, 'not as high as a splash');
  assert.ok(Math.max(...along.map(z => topAt(z, 0, count - 1) - topAt(z, count, all))) < 0.02, 'nowhere far below');
  assert.ok(all <= numbers.length / SHAPE_NUMBERS, 'no more than promised');
  assert.equal(new Waterline().add(numbers, count, {min: [-1e9, 0, -1e9], max: [1e9, 1e9, 1e9]}, spacing), count, 'none without walls');
});

/** Depths are kept in less digits than they are computed in, which once lost the nearest. */
test('each particle comes once', () => {
  const sorted = new NearestFirst();
  for (let i = 1; i <= 200; i++) {
    const position = Float32Array.from({length: 21}, (_, k) => Math.sin(12.9898 * (21 * i + k)) * 43758.5453 % 1);

    const left = sorted.sort(position, 0, 7, {x: 0.1, y: 0.2, z: 2.3}, {x: 0.36, y: 0.48, z: -0.8}, 0.05);

    assert.deepEqual(Array.from(sorted.order.subarray(0, left)).sort(), [0, 1, 2, 3, 4, 5, 6]);
    sorted.order.fill(9);
  }
});

/** Counted from the second particle; the last lies behind. */
test('the nearest comes first', () => {
  const position = new Float32Array([9, 9, 9, 0, 0, 5, 0, 0, 1, 0, 0, 3, 0, 0, -2]);
  const sorted = new NearestFirst();

  const left = sorted.sort(position, 1, 4, {x: 0, y: 0, z: 0}, {x: 0, y: 0, z: 1}, 0);

  assert.deepEqual(Array.from(sorted.order.subarray(0, left)), [1, 2, 0]);
});
