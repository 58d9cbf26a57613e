/** The page of `natator page --live`: a swimmer that is simulated in the browser. */

import {TimeChart, chartColours} from './charts.js';
import {byId, choose, fillSegments} from './element.js';
import {Figures} from './figures.js';
import {CAMERAS} from './cameras.js';
import {listen} from './keys.js';
import {Legend} from './legend.js';
import {listenToBanner, showBanner, showStatus} from './notices.js';
import {figures} from './probe.js';
import {expanded} from './recording.js';
import {sliderRow} from './sliders.js';
import {contents, isParticles, waterShown, watersOf} from './scene.js';
import {SolverSocket} from './solver-socket.js';
import {firstLook} from './stage.js';
import {SWIMMERS, WAVE, stiffened, waveGait} from './swimmers.js';
import {Theme} from './theme.js';
import {View} from './view.js';

const SLOW_MS = 200;
/** So many beats after a change who listens to the page is told the speed. */
const TOLD_BEATS = 2;
const USUAL = {stiffness: 1, viscosity: 1};
const WATERS = ['surface', 'vorticity', 'velocity', 'pressure', 'vortices', 'none'];

const SLIDERS = [
  {group: 'gait', id: 'frequency', label: 'Beats per second', min: 0.2, max: 3, step: 0.05},
  {group: 'gait', id: 'tail', label: 'Bend of the tail', title: 'how far its muscles shorten there; 0: not at all', min: 0, max: 1.2, step: 0.02},
  {group: 'gait', id: 'head', label: 'Bend of the head', title: 'how far its muscles shorten there; 0: not at all', min: 0, max: 1.2, step: 0.02},
  {group: 'gait', id: 'waves', label: 'Waves along it', title: 'from head to tail, at a time; below 0 they run from tail to head', min: -1.5, max: 1.5, step: 0.05},
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
  #legend = new Legend();
  #look = {...firstLook(), opacity: 0.25, trace: false};
  #theme;
  #lastSlow = 0;
  /** Simulated time of the last change that nobody was told of; null for none. */
  #changed = null;

  constructor(openSocket) {
    this.#theme = new Theme('auto', () => this.#themeChanged());
    const {scene} = this.#swimmer;
    const first = {scene, overrides: this.#overrides, gait: this.#gait};
    this.#view = new View(document.querySelector('.picture'), first, null, SWIMMERS.map(one => one.scene), {
      scene: () => this.#sceneChanged(),
      status: (state, text) => showStatus(state, state === 'open' ? 'computed here' : text),
      notice: showBanner,
      range: range => {
        this.#legend.range = range;
        this.#showLegend();
      },
      turning: range => {
        this.#legend.turning = range;
        this.#showLegend();
      },
      force: ([, force]) => {
        this.#legend.force = force;
        this.#showLegend();
      },
      pressure: range => {
        this.#legend.pressed = range;
        this.#showLegend();
      },
    }, openSocket);
    this.#view.stage.setTheme(this.#theme.colours);
    this.#setLook(this.#look);
    this.#view.stage.rig.onMode = mode => choose(byId('cameras'), mode);
    SLIDERS.forEach(setting => this.#addSlider(setting));
    fillSegments(byId('swimmers'), 'swimmer', SWIMMERS.map(({title}) => [title, title]), title => this.#choose(title));
    fillSegments(byId('shown'), 'water', WATERS.map(name => [name, name, 'key w']), name => this.#setWater(name));
    this.#setWater(WATERS[0]);
    fillSegments(byId('cameras'), 'camera', CAMERAS.map((name, i) => [name, name, `key ${i + 1}`]), mode => this.#setCamera(mode));
    this.#show();
    this.#setCamera('top');
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
    this.#changed = this.#view.frame?.time ?? 0;
    if (WAVE.includes(id)) {
      return this.#view.setGait(this.#gait);
    }
    return this.#view.setOverrides(id, this.#patch(id));
  }

  get #gait() {
    return waveGait(this.#settings, this.#swimmer.actuators);
  }

  /** What the scene is changed to for a swimmer from its start. */
  get #overrides() {
    return {...this.#swimmer.tank, creature: this.#swimmer.creature, ...this.#patch('viscosity')};
  }

  /** What a slider changes in the scene. */
  #patch(id) {
    if (id === 'viscosity') {
      return {solver: {kinematicViscosity: this.#swimmer.viscosity * this.#settings.viscosity}};
    }
    return {creature: Object.fromEntries(['clusterStiffness', 'springStiffness']
        .map(key => [key, stiffened(this.#own[key], this.#settings.stiffness)]))};
  }

  /** Another swimmer from its start, with its own gait and stiffness, in water as it is set. */
  async #choose(title) {
    this.#swimmer = SWIMMERS.find(one => one.title === title);
    this.#settings = {...this.#settings, ...this.#swimmer.wave, stiffness: 1};
    this.#own = null;
    this.#changed = this.#view.frame?.time ?? 0;
    this.#report(await this.#view.setScene(this.#swimmer.scene, this.#overrides, this.#gait));
    this.#show();
  }

  /** All as it was at first, but for the swimmer. */
  async #restore() {
    this.#settings = {...this.#settings, ...USUAL};
    await this.#choose(this.#swimmer.title);
    byId('restore').focus();
  }

  #report(error) {
    if (error !== null) {
      showBanner(error, true);
    }
  }

  #show() {
    choose(byId('swimmers'), this.#swimmer.title);
    for (const [id, slider] of this.#sliders) {
      slider.show(this.#settings[id]);
    }
  }

  /** The stiffness of a creature before a slider was moved. */
  #own = null;

  #sceneChanged() {
    const {scene} = this.#view;
    if (scene !== null && this.#own === null) {
      const {clusterStiffness, springStiffness} = scene.definition.creature;
      this.#own = {clusterStiffness, springStiffness};
    }
    this.#showRun();
    this.#showLegend();
  }

  #setLook(change) {
    this.#look = {...this.#look, ...change};
    this.#view.stage.setLook(this.#look);
    this.#showLegend();
  }

  /** What WATERS names; without a graphics card the particles stand for their surface. */
  #setWater(name) {
    this.#setLook({water: name === 'surface' ? firstLook().water : name});
  }

  #showLegend() {
    if (this.#view?.scene) {
      const has = contents([this.#view.scene]);
      this.#legend.show(this.#look, has);
      const shown = waterShown(this.#look.water, has);
      choose(byId('shown'), isParticles(shown) ? 'surface' : shown);
      for (const input of byId('shown').querySelectorAll('input')) {
        input.parentElement.hidden = !watersOf(has).includes(input.value);
      }
    }
  }

  #nextWater() {
    const shown = [...byId('shown').querySelectorAll('input')].filter(input => !input.parentElement.hidden);
    this.#setWater(shown[(shown.findIndex(input => input.checked) + 1) % shown.length].value);
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
    const text = Number.isNaN(speed) ? '–' : speed.toFixed(2).replace('-', '−');
    byId('swim-speed').textContent = text;
    this.#tell(text, frame.time);
    byId('swum').textContent = (frame.distance / scene.bodyLength).toFixed(1).replace('-', '−');
    this.#chart.draw([history]);
  }

  /** Says the speed once for each change, to screen readers: numbers that never rest say nothing. */
  #tell(speed, time) {
    if (this.#changed === null) {
      return;
    }
    this.#changed = Math.min(this.#changed, time);  // it may have begun anew
    if (time - this.#changed > TOLD_BEATS / this.#settings.frequency) {
      this.#changed = null;
      byId('told').textContent = `Speed ${speed} body lengths per second`;
    }
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
    for (const name of /** @type {('dye' | 'pressure' | 'forces')[]} */ (['dye', 'pressure', 'forces'])) {
      byId(name).addEventListener('change', () => this.#setLook({[name]: byId(name).checked}));
    }
    byId('theme').addEventListener('change', () => this.#theme.choose(byId('theme').value));
    listen([
      [' ', 'swim or pause', () => this.#toggleRun()],
      ['r', 'back to the start', reset],
      [['1', '2', '3', '4'], 'camera: follow, side, top, free', key => this.#setCamera(CAMERAS[Number(key) - 1])],
      ['w', 'water: surface, vorticity, velocity, pressure, vortices, none', () => this.#nextWater()],
      ['y', 'dye from the tail', () => byId('dye').click()],
      ['u', 'pressure on the body', () => byId('pressure').click()],
      ['o', 'forces on the body', () => byId('forces').click()],
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
