/** One scene that is watched and steered: a stage, its connection, and what was set. */

import {Connection} from './connection.js';
import {History} from './history.js';
import {Live, errorOf} from './live.js';
import {Meter} from './meter.js';
import {isSameGait, waveGait} from './gait.js';
import {MovingTank} from './moving-tank.js';
import {decodeFrame, sceneNumber, stopText} from './protocol.js';
import {contents} from './scene.js';
import {Stage} from './stage.js';

const VACUUM = '-vacuum';

/** Water on a grid is asked for so long after it came, ms, and so many times as long as taking it over has cost. */
const WATER_MS = 80;
const WATER_REST = 4;
/** … and so long where it was refused. */
const REFUSED_MS = 5000;
/** Where all stands still, water waits so long for its frame, which may have been dropped. */
const PATIENCE_MS = 300;

/** What a scene solves without water, gravity and walls; for scenes that have no such variant. */
const VACUUM_PATCH = {
  fluid: null, planes: [], solver: {gravity: [0, 0, 0]}, stopping: {planeContact: false, noProgressAfter: 0},
};

/** A socket to the server of this page. */
function serverSocket() {
  const url = new URL('stream', document.baseURI);
  url.protocol = url.protocol.replace('http', 'ws');
  url.hash = '';
  return new WebSocket(url.href);
}

/**
 * Calls `handlers`: scene(), status(state, text), notice(text, isBad, again), range(ends), turning(ends), force(ends), pressure(ends); `again` is what a button does
 * that starts anew, where that is left to the user.
 */
export class View {
  #connection;
  #handlers;
  #live = new Live(command => this.#connection.send(command));
  #meter = new Meter();
  #setting;
  #known;
  #fallback;
  #isLed = false;
  #firstScene = Infinity;
  #isFresh = false;
  #isNew = false;
  #tank = new MovingTank();
  /** Water that waits for the frame that it is of. */
  #water = null;
  #waterFrame = -1;
  #waterCame = 0;
  #isAsking = false;
  #nextWater = 0;

  /**
   * SCEN of what runs, or null.
   *
   * @type {Scene|null}
   */
  scene = null;
  /**
   * The last drawn frame, or null.
   *
   * @type {Frame|null}
   */
  frame = null;
  history = new History();

  /**
   * @param {HTMLElement} host what the picture fills
   * @param {object} setting scene, overrides, gait, rate, paused: how to begin; origin: where the gait is from, or absent
   * @param {object} fallback scene, overrides, gait: what to show if that is refused
   * @param {string[]} known names of scenes
   * @param {() => WebSocket} openSocket opens a socket to a simulator
   */
  constructor(host, setting, fallback, known, handlers, openSocket = serverSocket) {
    this.#setting = {overrides: null, gait: null, rate: 1, paused: false, ...setting};
    this.#known = known;
    this.#fallback = fallback;
    this.#handlers = handlers;
    this.stage = new Stage(host);
    this.stage.onRange = range => handlers.range(range);
    this.stage.onTurning = range => handlers.turning(range);
    this.stage.onForce = range => handlers.force(range);
    this.stage.onPressure = range => handlers.pressure(range);
    this.#connection = new Connection(openSocket, () => this.#start(), {
      status: (state, text) => this.#status(state, text),
      scene: scene => this.#scene(scene),
      water: water => this.#watered(water),
      stop: stop => this.#stopped(stop),
      lost: lost => this.#lost(lost),
      saved: saved => this.#saved(saved),
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

  /** Whether it shows a frame of what runs now. */
  get isReady() {
    return this.isConnected && this.#isFresh;
  }

  /** Whether it is led step by step, beside others, and does not run by itself; see `Lockstep`. */
  get isLed() {
    return this.#isLed;
  }

  set isLed(value) {
    this.#isLed = value;
    if (this.scene !== null && !this.isPaused) {
      this.#connection.send({do: value ? 'pause' : 'run'});
    }
  }

  /** Takes the next frame if there is one; all of them if it is led: the last one is shown. */
  receive() {
    while (this.#take() && this.#isLed) {
      // On to the last one.
    }
  }

  /** Draws what is new; `now` in milliseconds. */
  draw(now) {
    if (this.#water !== null && this.isPaused && now > this.#waterCame + PATIENCE_MS) {
      this.#showWater(this.frame.origin);
    }
    this.#askWater(now);
    if (this.stage.draw(now, this.isPaused) && this.#isNew) {
      this.#meter.drawn(this.frame.time);
    }
    this.#isNew = false;
    this.#meter.update(now);
  }

  /** Takes over the next frame, if there is one; those before the last start are left out. */
  #take() {
    for (let buffer = this.#connection.takeFrame(); buffer !== null; buffer = this.#connection.takeFrame()) {
      if (this.scene !== null && sceneNumber(buffer) >= this.#firstScene) {
        this.frame = decodeFrame(buffer, this.scene);
        this.#tank.follow(this.frame);
        this.#isFresh = true;
        this.#isNew = true;
        this.stage.setFrame(this.frame);
        this.#placeWater();
        this.history.add(this.frame, this.scene.bodyLength, this.scene.gait?.frequency ?? 0);
        return true;
      }
    }
    return false;
  }

  /** Asks for the water of now where the picture shows it, unless it has that, or what was asked for is still to be shown. */
  async #askWater(now) {
    const isWaiting = this.#isAsking || this.#water !== null;
    if (!this.stage.wantsWater || !this.isReady || isWaiting || now < this.#nextWater || this.#waterFrame === this.frame.frame) {
      return;
    }
    this.#isAsking = true;
    const error = await this.#connection.send({do: 'water', ...(contents([this.scene]).forces ? {pressure: true} : {})});
    this.#isAsking = false;
    this.#nextWater = Math.max(this.#nextWater, error === null ? 0 : now + REFUSED_MS);
  }

  #watered(water) {
    if (this.scene !== null && water.scene >= this.#firstScene) {
      this.#water = water;
      this.#waterFrame = water.frame;
      this.#waterCame = performance.now();
      this.#placeWater();
    }
  }

  /** Shows water once the frame that it is of, or a later one, is shown: those tell where the tank was. */
  #placeWater() {
    if (this.#water !== null && this.#isFresh && this.frame.frame >= this.#water.frame) {
      this.#showWater(this.#tank.originAt(this.#water.time));
    }
  }

  #showWater(origin) {
    const began = performance.now();
    this.stage.setWater({...this.#water, origin});
    this.#nextWater = began + Math.max(WATER_MS, WATER_REST * (performance.now() - began));
    this.#water = null;
  }

  run() {
    this.#setting.paused = false;
    return this.#isLed ? Promise.resolve(null) : this.#connection.send({do: 'run'});
  }

  pause() {
    this.#setting.paused = true;
    return this.#isLed ? Promise.resolve(null) : this.#connection.send({do: 'pause'});
  }

  /** Goes so many frames on; what is not led pauses then. */
  step(frames = 1) {
    this.#setting.paused = this.#setting.paused || !this.#isLed;
    return this.#connection.send({do: 'step', frames});
  }

  reset() {
    return this.#connection.send({do: 'reset'});
  }

  /** Simulated seconds per second at most; 0 for as many as possible. */
  setRate(value) {
    this.#setting.rate = value;
    return this.#live.submit('rate', {do: 'rate', value});
  }

  /**
   * Another gait; `origin` is {run, label} of where it is from, if that is known.
   *
   * @param {Gait} gait
   */
  setGait(gait, origin = null) {
    this.#setting.origin = origin === null ? null : {...origin, gait};
    return this.#live.submit('gait', {do: 'gait', gait});
  }

  /** Merges a patch into the scene. */
  setOverrides(key, overrides) {
    return this.#live.submit(`overrides ${key}`, {do: 'overrides', overrides});
  }

  /**
   * Another scene from its start; gait null for none, with its `origin` if that is known.
   *
   * @param {string} scene its name or file
   * @param {Gait|null} gait
   */
  setScene(scene, overrides, gait, origin = null) {
    this.#setting.origin = origin === null ? this.#setting.origin : {...origin, gait};
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

  /** Run and what it is there that the gait is from, if it is still that gait; else null. */
  get origin() {
    const {origin} = this.#setting;
    return origin && isSameGait(origin.gait, this.scene === null ? this.#setting.gait : this.scene.gait) ? origin : null;
  }

  /** Notes where the present gait is from. */
  setOrigin({run, label}) {
    this.#setting.origin = {run, label, gait: this.scene.gait};
  }

  /** Begins anew after the simulator was lost for good. */
  startAgain() {
    if (this.isConnected) {
      this.#connection.begin();
    }
  }

  /** Ends the connection and with it the simulator. */
  close() {
    this.stage.close();
    this.#connection.close();
  }

  #start() {
    const {scene, overrides, gait, rate, paused} = this.#setting;
    this.#sendRateSoon(rate);
    return {do: 'start', scene, overrides, gait, options: {paused: paused || this.#isLed}};
  }

  #sendRateSoon(rate) {
    queueMicrotask(() => this.#connection.send({do: 'rate', value: rate}));
  }

  #status(state, text) {
    this.#isFresh = this.#isFresh && state === 'open';
    this.#handlers.status(state, text);
  }

  #scene(scene) {
    const isOther = this.scene === null || scene.restarted;
    this.scene = scene;
    this.#setting = {...this.#setting, scene: scene.scene, overrides: scene.overrides, gait: scene.gait};
    if (isOther) {
      this.#firstScene = scene.number;
      this.#isFresh = false;
      this.#water = null;
      this.#waterFrame = -1;
      this.history.clear();
    }
    this.#tank.setScene(scene);
    this.stage.setScene(scene);
    this.#handlers.scene();
  }

  #stopped(stop) {
    this.#setting.paused = true;
    this.#handlers.notice(stopText(stop), stop.reason !== 'until');
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

  /** Reads the scene again whose file was saved. What runs goes on if that is faulty. */
  async #saved({scene: file}) {
    if (this.scene === null) {
      this.#connection.begin();
      return;
    }
    const {scene, overrides, gait} = this.scene;
    if (scene !== file) {
      return;
    }
    const name = file.split('/').at(-1);
    let error = await this.setScene(scene, overrides, gait);
    if (gait !== null && error?.startsWith('gait.')) {
      error = await this.setScene(scene, overrides, null);  // it has other muscles now
      if (error === null && this.scene.actuators > 0) {
        error = errorOf(await this.setGait(waveGait(this.scene.actuators)));
      }
    }
    this.#handlers.notice(error === null ? `${name} was read again.` : error, error !== null);
  }

  #lost(lost) {
    this.#isFresh = false;
    this.#handlers.notice(`The simulator was lost: ${lost.reason}.${lost.restarted ? ' It was started again.' : ''}`, true,
        lost.restarted ? null : () => this.startAgain());
    if (lost.restarted) {
      this.#sendRateSoon(this.#setting.rate);
      if (this.#setting.paused || this.#isLed) {
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
