/**
 * Whether the page's simulator (WebAssembly) streams the bits of the native program with portable kernels: the same commands to both, and
 * each message compared. Exit code 1 if they differ.
 *   node tests/wasm/same_frames.mjs build/release/bin/natator-sim build/wasm/bin
 */
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {createHash} from 'node:crypto';
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {resolve} from 'node:path';

const SCENE = 'endless/small';
const GAIT = {
  frequency: 1.5, amplitude: [0.25, 0.3286, 0.4071, 0.4857, 0.5643, 0.6429, 0.7214, 0.8],
  phase: [0, 0.875, 0.75, 0.625, 0.5, 0.375, 0.25, 0.125],
};
/** What the page's sliders send, between frames. */
const COMMANDS = [
  {do: 'credit', frames: 1000},
  {do: 'step', frames: 60},
  {do: 'gait', gait: {...GAIT, frequency: 2}},
  {do: 'step', frames: 20},
  {do: 'overrides', overrides: {solver: {kinematicViscosity: 0.02}}},
  {do: 'step', frames: 20},
  {do: 'overrides', overrides: {creature: {clusterStiffness: 0.3}}},
  {do: 'step', frames: 20},
  {do: 'reset'},
  {do: 'step', frames: 5},
];
const WALL_TIME = [24, 32];

/** Messages in what a program wrote: letters and body. */
function messages(bytes) {
  const found = [];
  for (let at = 0; at < bytes.length;) {
    const length = bytes.readUInt32LE(at + 4);
    found.push(message(bytes.subarray(at, at + 8 + length)));
    at += 8 + length;
  }
  return found;
}

function message(bytes) {
  const letters = bytes.toString('latin1', 0, 4);
  const body = Buffer.from(bytes.subarray(8));
  if (letters === 'FRAM') {
    body.fill(0, ...WALL_TIME);
    return [letters, createHash('sha256').update(body).digest('hex')];
  }
  return [letters, JSON.parse(body.toString())];
}

function native(program) {
  const {status, stdout, stderr} = spawnSync(program, ['stream', SCENE, '--gait', JSON.stringify(GAIT), '--fields',
    'position,velocity,force', '--paused', '--no-cache'], {
    input: COMMANDS.map(command => `${JSON.stringify(command)}\n`).join(''), maxBuffer: 1 << 30,
    env: {...process.env, NATATOR_ISA: 'portable'},
  });
  assert.equal(status, 0, String(stderr));
  return messages(stdout);
}

async function inPage(folder) {
  const found = [];
  const start = createRequire(import.meta.url)(resolve(folder, 'natator-live.js'));
  const module = await start({
    wasmBinary: readFileSync(resolve(folder, 'natator-live.wasm')), thisProgram: '/bin/natator-live',
    message: bytes => found.push(message(Buffer.from(bytes))),
  });
  for (const command of [{do: 'scene', scene: SCENE, gait: GAIT}, ...COMMANDS]) {
    module.ccall('natator_command', null, ['string'], [JSON.stringify(command)]);
  }
  return found;
}

const [program, folder] = process.argv.slice(2);
const there = native(program);
const here = (await inPage(folder)).filter(([letters], i) => letters !== 'ANSW' || i > 1);
assert.equal(there.filter(([letters]) => letters === 'FRAM').length, COMMANDS.filter(one => one.do === 'step').length + 2);
assert.deepEqual(here.map(([letters]) => letters), there.map(([letters]) => letters));
here.forEach((one, i) => assert.deepEqual(one, there[i], `message ${i}, ${one[0]}`));
console.log(`${here.length} messages of ${SCENE} are the same`);
