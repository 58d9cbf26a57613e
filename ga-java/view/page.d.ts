/** Elements of the page that are more than any element, by their id: index.html, replay.html and live-page.html. */
interface PageElements {
  'dye': HTMLInputElement;
  'forces': HTMLInputElement;
  'pressure': HTMLInputElement;
  'front-other': HTMLSelectElement;
  'gait-file': HTMLInputElement;
  'gait-load': HTMLButtonElement;
  'gait-random': HTMLButtonElement;
  'gait-save': HTMLButtonElement;
  'help': HTMLDialogElement;
  'rate': HTMLSelectElement;
  'run-choice': HTMLSelectElement;
  'run-compare': HTMLButtonElement;
  'run-watch': HTMLButtonElement;
  'scene': HTMLSelectElement;
  'scheme': HTMLSelectElement;
  'scrub': HTMLInputElement;
  'speed': HTMLSelectElement;
  'swim': HTMLSelectElement;
  'theme': HTMLSelectElement;
  'vacuum': HTMLInputElement;
}

interface Window {
  /** Figures of what is shown, to be read by tests. */
  natator: object;
}

/** What the script that emscripten makes defines: the simulator, see solver-worker.js. */
declare function natatorLive(options: object): Promise<any>;
declare const WorkerGlobalScope: unknown;

/** What drives muscles: `gait` of a scene's request. */
interface Gait {
  /** Beats per second. */
  frequency: number;
  amplitude: number[];
  phase: number[];
  power?: number;
  offset?: number[];
}

/** Body of a SCEN (sim-native/protocol/stream.md), as far as the page reads it. Lengths in the scene's unit, times in s. */
interface Scene {
  program?: {version: string};
  number: number;
  restarted: boolean;
  scene: string;
  overrides: Record<string, any> | null;
  gait: Gait | null;
  scheme: string;
  definition: Record<string, any>;
  timeStep: number;
  solidRestDistance: number;
  fluidRestDistance: number;
  planes: number[][];
  periodic?: Partial<Record<'x' | 'y' | 'z', number[]>>;
  fields: string[];
  particles: number;
  mass: (number | null)[];
  /** First and count. */
  fluid: number[];
  body: number[];
  slices: number[][];
  bodyLength: number;
  /** Missing in recordings. */
  companions?: {name: string, body: number[], slices: number[][]}[];
  clusters: number[][];
  joints: number[];
  actuators: number;
  muscles: {a: number, b: number, actuator: number, lateral: number, restLength: number, bend?: string}[];
  skin: {vertices: number[][], triangles: number[][], cluster: number[], other?: number[], share: number[], rest: number[][]} | null;
}

/** One frame of the stream, or of a recording. Arrays are views into what was received. */
interface Frame {
  /** Number of the SCEN that it belongs to. */
  scene: number;
  /** Since the start. */
  frame: number;
  dropped: number;
  running: boolean;
  touching: boolean;
  /** Simulated and measured, s. */
  time: number;
  wallTime: number;
  distance: number;
  /** Of the centre of mass: x, y, z, length/s. */
  velocity: Float32Array;
  momentum: number;
  angularMomentum: number;
  /** Errors as shares of the rest density. */
  densityMean: number;
  densityMax: number;
  /** A numbers: a u of each actuator. */
  activation: Float32Array;
  /** 3 numbers for each particle; like the next two, null where the stream leaves them out. */
  position: Float32Array | null;
  velocities: Float32Array | null;
  density: Float32Array | null;
  /** Of the water on each particle, mass length/s²: 3 numbers; null where the stream or a recording leaves it out. */
  force?: Float32Array | null;
  /** How far the tank has moved along with its swimmer: by that much places are greater than in the stream. */
  origin?: number[];
}

/** Water on a grid, a WATR of the stream. Arrays have x vary fastest, and are views into what was received. */
interface Water {
  /** Number of the SCEN that it belongs to. */
  scene: number;
  frame: number;
  /** s. */
  time: number;
  /** Their number along x, y and z; the edge of one, length; and the lowest corner of all in the tank. */
  cells: number[];
  cell: number;
  corner: number[];
  /** 3 numbers for each cell, length/s. */
  velocity: Float32Array;
  /** In rest densities. */
  density: Float32Array;
  /** mass/(length s²), NaN where it is not known; null where it was not asked for. */
  pressure?: Float32Array | null;
  /** How far the tank had moved, see Frame. */
  origin?: number[];
}
