/** Frames of the stream. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {decodeFrame, sceneNumber} from '#page/protocol.js';

test('a frame is read byte for byte', () => {
  const scene = {particles: 2, actuators: 1, fields: ['position', 'velocity', 'density', 'force']};
  const buffer = new ArrayBuffer(72 + 4 + 4 * 20);
  const view = new DataView(buffer);
  [3, 250, 7, 3].forEach((value, i) => view.setUint32(4 * i, value, true));
  [1.25, 0.008, -0.5].forEach((value, i) => view.setFloat64(16 + 8 * i, value, true));
  for (let i = 0; i < 7; i++) {
    view.setFloat32(40 + 4 * i, 10 + i, true);
  }
  for (let i = 0; i < 21; i++) {
    view.setFloat32(72 + 4 * i, 100 + i, true);
  }

  assert.equal(sceneNumber(buffer), 3);
  assert.deepEqual(decodeFrame(buffer, scene), {
    scene: 3, frame: 250, dropped: 7, running: true, touching: true, time: 1.25, wallTime: 0.008, distance: -0.5,
    velocity: Float32Array.of(10, 11, 12), momentum: 13, angularMomentum: 14, densityMean: 15, densityMax: 16,
    activation: Float32Array.of(100), position: Float32Array.of(101, 102, 103, 104, 105, 106),
    velocities: Float32Array.of(107, 108, 109, 110, 111, 112), density: Float32Array.of(113, 114),
    force: Float32Array.of(115, 116, 117, 118, 119, 120),
  });
  assert.throws(() => decodeFrame(buffer.slice(4), scene), {message: 'frame has 152 bytes; expected 156'});
});
