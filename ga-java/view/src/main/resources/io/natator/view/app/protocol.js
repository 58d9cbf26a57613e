/** Binary messages of `natator-sim stream` (sim-native/protocol/stream.md): bodies of FRAM, and WATR with its head. */

/** Bytes before the activations. */
const HEAD_BYTES = 72;

/** Numbers that each field has per particle. */
const WIDTHS = {position: 3, velocity: 3, density: 1, force: 3};

const RUNNING = 1;
const TOUCHING = 2;

/** The number of the scene (SCEN) that a frame belongs to. */
export function sceneNumber(buffer) {
  return new DataView(buffer).getUint32(0, true);
}

/**
 * Decodes one frame. Arrays are views into the buffer.
 *
 * @param {ArrayBuffer} buffer body of a FRAM
 * @param {Scene} scene body of its SCEN
 * @returns {Frame}
 * @throws {Error} if the length does not fit the scene
 */
export function decodeFrame(buffer, scene) {
  const particles = scene.particles;
  let expected = HEAD_BYTES + 4 * scene.actuators;
  for (const field of scene.fields) {
    expected += 4 * WIDTHS[field] * particles;
  }
  if (buffer.byteLength !== expected) {
    throw new Error(`frame has ${buffer.byteLength} bytes; expected ${expected}`);
  }
  const view = new DataView(buffer);
  const flags = view.getUint32(12, true);
  const fields = {position: null, velocity: null, density: null, force: null};
  let offset = HEAD_BYTES + 4 * scene.actuators;
  for (const field of scene.fields) {
    fields[field] = new Float32Array(buffer, offset, WIDTHS[field] * particles);
    offset += 4 * WIDTHS[field] * particles;
  }
  return {
    scene: view.getUint32(0, true),
    frame: view.getUint32(4, true),
    dropped: view.getUint32(8, true),
    running: (flags & RUNNING) !== 0,
    touching: (flags & TOUCHING) !== 0,
    time: view.getFloat64(16, true),
    wallTime: view.getFloat64(24, true),
    distance: view.getFloat64(32, true),
    velocity: new Float32Array(buffer, 40, 3),
    momentum: view.getFloat32(52, true),
    angularMomentum: view.getFloat32(56, true),
    densityMean: view.getFloat32(60, true),
    densityMax: view.getFloat32(64, true),
    activation: new Float32Array(buffer, HEAD_BYTES, scene.actuators),
    position: fields.position,
    velocities: fields.velocity,
    density: fields.density,
    force: fields.force,
  };
}

/** "WATR" as a number; no scene has so high a one, which a frame begins with. */
const WATER_LETTERS = 0x52544157;
/** Bytes before the velocities: those of the message's head and its own. */
const WATER_HEAD_BYTES = 8 + 64;

/** Whether a message is of water, and else of a frame. */
export function isWater(buffer) {
  return sceneNumber(buffer) === WATER_LETTERS;
}

/**
 * Decodes water on a grid. Arrays are views into the buffer.
 *
 * @param {ArrayBuffer} buffer a WATR with its head
 * @returns {Water}
 */
export function decodeWater(buffer) {
  const view = new DataView(buffer, 8);
  const cells = [8, 12, 16].map(at => view.getUint32(at, true));
  const count = cells[0] * cells[1] * cells[2];
  return {
    scene: view.getUint32(0, true),
    frame: view.getUint32(4, true),
    time: view.getFloat64(24, true),
    cells,
    cell: view.getFloat64(32, true),
    corner: [40, 48, 56].map(at => view.getFloat64(at, true)),
    velocity: new Float32Array(buffer, WATER_HEAD_BYTES, 3 * count),
    density: new Float32Array(buffer, WATER_HEAD_BYTES + 12 * count, count),
    pressure: view.getUint32(20, true) === 1 ? new Float32Array(buffer, WATER_HEAD_BYTES + 16 * count, count) : null,
  };
}

/** Why a simulation stopped by itself, in words. Older programs do not tell the law of mechanics that was broken. */
export function stopText(stop) {
  const law = stop.law ? `broke law ${stop.law}, ` : '';
  return stop.reason === 'unstable'
      ? `Became unstable at ${stop.time.toFixed(2)} s (${law}particle ${stop.particle}, ${stop.stage}). Reset to go on.`
      : stop.reason === 'until' ? 'Came to its end.' : stop.reason;
}
