/** The page of `natator page --live`: a swimmer that is simulated in the browser. */

import {TimeChart, chartColours} from './charts.js';
import {byId, choose, fillSegments} from './element.js';
import {Figures} from './figures.js';
import {CAMERAS} from './cameras.js';
import {listen} from './keys.js';
import {errorOf} from './live.js';
import {listenToBanner, showBanner, showStatus} from './notices.js';
import {figures} from './probe.js';
import {expanded} from './recording.js';
import {sliderRow} from './sliders.js';
import {SolverSocket} from './solver-socket.js';
import {firstLook} from './stage.js';
import {SWIMMERS, WAVE, stiffened, waveGait} from './swimmers.js';
import {Theme} from './theme.js';
import {View} from './view.js';

const SCENE = 'endless/small';
const SLOW_MS = 200;
const USUAL = {stiffness: 1, viscosity: 1};

const SLIDERS = [
  {group: 'gait', id: 'frequency', label: 'Beats per second', min: 0.2, max: 3, step: 0.05},
  {group: 'gait', id: 'tail', label: 'Tail bends', title: 'how far its muscles shorten at the tail; 0: not at all', min: 0, max: 1.2, step: 0.02},
  {group: 'gait', id: 'head', label: 'Head bends', title: 'the same at the head', min: 0, max: 1.2, step: 0.02},
  {group: 'gait', id: 'waves', label: 'Waves on body', title: 'that go from head to tail at a time; below 0 they go to the head', min: -1.5, max: 1.5, step: 0.05},
  {group: 'body', id: 'stiffness', label: 'Stiffness ×', title: 'of the body, times its own', min: 0.2, max: 1.6, step: 0.05},
  {group: 'water', id: 'viscosity', label: 'Viscosity ×', title: 'of the water, times that of the scene: 1 flows easily, 50 like syrup', min: 1, max: 50, step: 1},
];

/** One view of a simulation that runs in this page. */
class LivePage {
  #view;
  #swimmer = SWIMMERS[0];
  #settings = {...SWIMMERS[0].wave, ...USUAL};
  #sliders = new Map();
  #figures = new Figures(byId('stage-a'));
  #chart = new TimeChart(byId('chart-speed'), ['beatSpeed'], 0.2);
  #theme;
  #lastSlow = 0;

  constructor(openSocket) {
    this.#theme = new Theme('auto', () => this.#themeChanged());
    const first = {scene: SCENE, overrides: null, gait: waveGait(this.#settings, 8)};
    this.#view = new View(document.querySelector('.picture'), first, null, [SCENE], {
      scene: () => this.#sceneChanged(),
      status: (state, text) => showStatus(state, state === 'open' ? 'computed here' : text),
      notice: showBanner,
      range: () => {},
    }, openSocket);
    this.#view.stage.setTheme(this.#theme.colours);
    this.#view.stage.setLook({...firstLook(), muscles: true, trace: true});
    this.#view.stage.rig.onMode = mode => choose(byId('cameras'), mode);
    SLIDERS.forEach(setting => this.#addSlider(setting));
    fillSegments(byId('swimmers'), 'swimmer', SWIMMERS.map(({creature, title}) => [creature, title]), creature => this.#choose(creature));
    fillSegments(byId('cameras'), 'camera', CAMERAS.map((name, i) => [name, name, `key ${i + 1}`]), mode => this.#setCamera(mode));
    this.#show();
    this.#setCamera('follow');
    this.#listen();
    requestAnimationFrame(now => this.#tick(now));
  }

  /** For tests: see probe.js. */
  get views() {
    return [this.#view];
  }

  #addSlider(setting) {
    const {slider, row} = sliderRow(setting, value => {
      this.#settings = {...this.#settings, [setting.id]: value};
      return this.#send(setting.id);
    });
    this.#sliders.set(setting.id, slider);
    byId(setting.group).append(row);
  }

  #send(id) {
    if (WAVE.includes(id)) {
      return this.#view.setGait(this.#gait);
    }
    return this.#view.setOverrides(id, this.#patch(id));
  }

  get #gait() {
    return waveGait(this.#settings, this.#view.scene?.actuators ?? 8);
  }

  /** What a slider changes in the scene. */
  #patch(id) {
    if (id === 'viscosity') {
      return {solver: {kinematicViscosity: this.#water * this.#settings.viscosity}};
    }
    return {creature: Object.fromEntries(['clusterStiffness', 'springStiffness']
        .map(key => [key, stiffened(this.#own[key], this.#settings.stiffness)]))};
  }

  /** Another swimmer from its start, with its own gait and stiffness, in water as it is set. */
  async #choose(creature) {
    this.#swimmer = SWIMMERS.find(one => one.creature === creature);
    this.#settings = {...this.#settings, ...this.#swimmer.wave, stiffness: 1};
    this.#own = null;
    const overrides = {creature: {name: creature}, ...this.#patch('viscosity')};
    const error = await this.#view.setScene(SCENE, overrides, null) ?? errorOf(await this.#view.setGait(this.#gait));
    this.#report(error);
    this.#show();
  }

  /** All as it was at first, but for the swimmer. */
  async #restore() {
    this.#settings = {...this.#settings, ...USUAL};
    await this.#choose(this.#swimmer.creature);
    byId('restore').focus();
  }

  #report(error) {
    if (error !== null) {
      showBanner(error, true);
    }
  }

  #show() {
    choose(byId('swimmers'), this.#swimmer.creature);
    for (const [id, slider] of this.#sliders) {
      slider.show(this.#settings[id]);
    }
  }

  /** The stiffness of a creature and the viscosity of the water before a slider was moved. */
  #own = null;
  #water = 0.002;

  #sceneChanged() {
    const {scene} = this.#view;
    if (scene !== null && this.#own === null) {
      const {clusterStiffness, springStiffness} = scene.definition.creature;
      this.#own = {clusterStiffness, springStiffness};
    }
    this.#showRun();
  }

  #tick(now) {
    this.#view.receive();
    this.#view.draw(now);
    if (now - this.#lastSlow > SLOW_MS) {
      this.#lastSlow = now;
      this.#showFigures();
    }
    requestAnimationFrame(next => this.#tick(next));
  }

  #showFigures() {
    const {history, scene, frame} = this.#view;
    this.#figures.show(this.#view);
    if (frame === null) {
      return;
    }
    const speed = history.last('beatSpeed');
    byId('speed').textContent = Number.isNaN(speed) ? '–' : speed.toFixed(2).replace('-', '−');
    byId('swum').textContent = (frame.distance / scene.bodyLength).toFixed(1).replace('-', '−');
    this.#chart.draw([history]);
  }

  #toggleRun() {
    const {isPaused} = this.#view;
    (isPaused ? this.#view.run() : this.#view.pause()).then(error => this.#report(error));
    this.#showRun();
  }

  #showRun() {
    byId('run').textContent = this.#view?.isPaused ? 'Swim' : 'Pause';
  }

  #setCamera(mode) {
    choose(byId('cameras'), mode);
    this.#view.stage.rig.setMode(mode);
  }

  #themeChanged() {
    byId('theme').value = this.#theme?.choice ?? 'auto';
    this.#chart.colours = chartColours(byId('chart-speed'));
    this.#view?.stage.setTheme(this.#theme.colours);
  }

  #listen() {
    listenToBanner();
    const reset = () => this.#view.reset().then(error => this.#report(error));
    byId('run').addEventListener('click', () => this.#toggleRun());
    byId('reset').addEventListener('click', reset);
    byId('restore').addEventListener('click', () => this.#restore());
    byId('theme').addEventListener('change', () => this.#theme.choose(byId('theme').value));
    listen([
      [' ', 'swim or pause', () => this.#toggleRun()],
      ['r', 'back to the start', reset],
      [['1', '2', '3', '4'], 'camera: follow, side, top, free', key => this.#setCamera(CAMERAS[Number(key) - 1])],
      ['d', 'light, dark', () => this.#theme.toggle()],
      ['?', 'this list', () => byId('help').showModal()],
    ]);
  }
}

const module = await expanded(byId('solver').textContent);
const script = new TextDecoder().decode(await expanded(byId('solver-script').textContent));
const address = URL.createObjectURL(new Blob([script], {type: 'text/javascript'}));
const isInPage = new URLSearchParams(location.search).get('worker') === 'no';
const page = new LivePage(() => new SolverSocket(address, module, isInPage));
window.natator = figures(page);
