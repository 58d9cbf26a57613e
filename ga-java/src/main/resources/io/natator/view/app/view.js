/** One scene that is watched and steered: a stage, its connection, and what was set. */

import {Connection} from './connection.js';
import {History} from './history.js';
import {Live} from './live.js';
import {Meter} from './meter.js';
import {decodeFrame, sceneNumber} from './protocol.js';
import {Stage} from './stage.js';

const VACUUM = '-vacuum';

/** What a scene solves without water, gravity and walls; for scenes that have no such variant. */
const VACUUM_PATCH = {
  fluid: null, planes: [], solver: {gravity: [0, 0, 0]}, stopping: {planeContact: false, noProgressAfter: 0},
};

/** Calls `handlers`: scene(), status(state, text), notice(text, isBad), range(ends). */
export class View {
  #connection;
  #handlers;
  #live = new Live(command => this.#connection.send(command));
  #meter = new Meter();
  #setting;
  #known;
  #fallback;

  /** SCEN of what runs, or null. */
  scene = null;
  /** The last drawn frame, or null. */
  frame = null;
  /** The last ANALYSIS of this motion, or null. */
  analysis = null;
  history = new History();

  /**
   * @param {HTMLElement} host what the picture fills
   * @param {object} setting scene, overrides, gait, rate, paused: how to begin
   * @param {object} fallback scene, overrides, gait: what to show if that is refused
   * @param {string[]} known names of scenes
   */
  constructor(host, setting, fallback, known, handlers) {
    this.#setting = {overrides: null, gait: null, rate: 1, paused: false, ...setting};
    this.#known = known;
    this.#fallback = fallback;
    this.#handlers = handlers;
    this.stage = new Stage(host);
    this.stage.onRange = range => handlers.range(range);
    const url = new URL('stream', document.baseURI);
    url.protocol = url.protocol.replace('http', 'ws');
    url.hash = '';
    this.#connection = new Connection(url.href, () => this.#start(), {
      status: (state, text) => this.#status(state, text),
      scene: scene => this.#scene(scene),
      stop: stop => this.#stopped(stop),
      analysis: analysis => {
        this.analysis = analysis;
      },
      lost: lost => this.#lost(lost),
      refused: error => this.#refused(error),
    });
  }

  /** How to come back to what is seen now. */
  get setting() {
    return {...this.#setting};
  }

  get isPaused() {
    return this.#setting.paused;
  }

  get fps() {
    return this.#meter.fps;
  }

  get pace() {
    return this.#meter.pace;
  }

  /** Frames that were simulated but not shown, since the start. */
  get dropped() {
    return this.frame?.dropped ?? 0;
  }

  get isConnected() {
    return this.#connection.isOpen;
  }

  /** Takes the next frame, if there is one, and draws. `now` in milliseconds. */
  tick(now) {
    const buffer = this.#connection.takeFrame();
    const isNew = buffer !== null && this.scene !== null && sceneNumber(buffer) === this.scene.number;
    if (isNew) {
      this.frame = decodeFrame(buffer, this.scene);
      this.stage.setFrame(this.frame);
      this.history.add(this.frame, this.scene.bodyLength, this.scene.gait?.frequency ?? 0);
    }
    if (this.stage.draw(now) && isNew) {
      this.#meter.drawn(this.frame.time);
    }
    this.#meter.update(now);
  }

  run() {
    this.#setting.paused = false;
    return this.#connection.send({do: 'run'});
  }

  pause() {
    this.#setting.paused = true;
    return this.#connection.send({do: 'pause'});
  }

  step() {
    this.#setting.paused = true;
    return this.#connection.send({do: 'step', frames: 1});
  }

  reset() {
    return this.#connection.send({do: 'reset'});
  }

  /** Simulated seconds per second at most; 0 for as many as possible. */
  setRate(value) {
    this.#setting.rate = value;
    return this.#live.submit('rate', {do: 'rate', value});
  }

  setGait(gait) {
    return this.#live.submit('gait', {do: 'gait', gait});
  }

  /** Merges a patch into the scene. */
  setOverrides(key, overrides) {
    return this.#live.submit(`overrides ${key}`, {do: 'overrides', overrides});
  }

  /** Another scene from its start; gait null for none. */
  setScene(scene, overrides, gait) {
    return this.#connection.send({
      do: 'scene', scene, ...(overrides === null ? {} : {overrides}), ...(gait === null ? {} : {gait}),
    });
  }

  /** Whether the scene is one without water, gravity and walls. */
  get isVacuum() {
    return this.scene !== null && this.scene.fluid[1] === 0 && this.scene.planes.length === 0;
  }

  /** Takes water, gravity and walls away, or gives them back. */
  setVacuum(isVacuum) {
    const {scene, gait} = this.scene;
    const other = isVacuum ? scene + VACUUM : scene.endsWith(VACUUM) ? scene.slice(0, -VACUUM.length) : scene;
    const kept = withoutVacuum(this.scene.overrides ?? {});
    if (other !== scene && this.#known.includes(other)) {
      return this.setScene(other, kept, gait);
    }
    const patch = {...kept, ...VACUUM_PATCH, solver: {...kept.solver, ...VACUUM_PATCH.solver}};
    return this.setScene(scene, isVacuum ? patch : kept, gait);
  }

  /** Ends the connection and with it the simulator. */
  close() {
    this.#connection.close();
  }

  #start() {
    const {scene, overrides, gait, rate, paused} = this.#setting;
    this.#sendRateSoon(rate);
    return {do: 'start', scene, overrides, gait, options: {paused}};
  }

  #sendRateSoon(rate) {
    queueMicrotask(() => this.#connection.send({do: 'rate', value: rate}));
  }

  #status(state, text) {
    this.#handlers.status(state, text);
  }

  #scene(scene) {
    const isOther = this.scene === null || scene.restarted;
    this.scene = scene;
    this.#setting = {...this.#setting, scene: scene.scene, overrides: scene.overrides, gait: scene.gait};
    if (isOther) {
      this.history.clear();
      this.analysis = null;
    }
    this.stage.setScene(scene);
    this.#handlers.scene();
  }

  #stopped(stop) {
    this.#setting.paused = true;
    const text = stop.reason === 'unstable'
        ? `Became unstable at ${stop.time.toFixed(2)} s (particle ${stop.particle}, ${stop.stage}). Reset to go on.`
        : stop.reason === 'until' ? 'Came to its end.' : stop.reason;
    this.#handlers.notice(text, stop.reason !== 'until');
    this.#handlers.scene();
  }

  /** What an address remembers may be gone: then what the server was started with is shown. */
  #refused(error) {
    if (this.scene === null && this.#fallback !== null) {
      this.#handlers.notice(error, true);
      this.#setting = {...this.#setting, overrides: null, gait: null, ...this.#fallback};
      this.#fallback = null;
      this.#connection.begin();
    }
  }

  #lost(lost) {
    this.#handlers.notice(`The simulator was lost: ${lost.reason}.${lost.restarted ? ' It was started again.' : ''}`, true);
    if (lost.restarted) {
      this.#sendRateSoon(this.#setting.rate);
      if (this.#setting.paused) {
        this.#connection.send({do: 'pause'});
      }
    }
  }
}

/** Overrides less those that make a vacuum. */
function withoutVacuum(overrides) {
  const kept = {...overrides, solver: {...overrides.solver}};
  delete kept.stopping;
  delete kept.solver.gravity;
  if (Object.keys(kept.solver).length === 0) {
    delete kept.solver;
  }
  if (!kept.fluid) {
    delete kept.fluid;
  }
  if (!(kept.planes?.length > 0)) {
    delete kept.planes;
  }
  return kept;
}
