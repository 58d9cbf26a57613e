/** The page of `natator view`: puts its parts together. */

import {about} from './about.js';
import {CAMERAS} from './cameras.js';
import {caption} from './caption.js';
import {Capture} from './capture.js';
import {byId, choose, fillSegments} from './element.js';
import {Figures} from './figures.js';
import {LiveCharts} from './livecharts.js';
import {LookControls} from './look.js';
import {remembered, rememberSoon} from './memory.js';
import {listenToBanner, showBanner, showStatus} from './notices.js';
import {Presentation} from './present.js';
import {figures} from './probe.js';
import {RunBrowser} from './runs.js';
import {fileName} from './save.js';
import {contents} from './scene.js';
import {SharedRange} from './shared-range.js';
import {listenToShortcuts} from './shortcuts.js';
import {firstLook} from './stage.js';
import {SwimControls} from './swim-controls.js';
import {Theme} from './theme.js';
import {Transport} from './transport.js';
import {View} from './view.js';
import {Watching} from './watching.js';

const FIGURES_MS = 250;
const NAMES = ['a', 'b'];

/** The whole page: one or two views, and controls for the chosen one. */
export class Page {
  #setup;
  /** @type {View[]} */
  #views = [];
  #figures = [];
  #chosen = 0;
  #camera = 'follow';
  #look;
  #theme;
  #controls;
  #charts;
  #runs;
  #lastFigures = 0;
  #range = new SharedRange(range => this.#look.showRange(range), (view, range) => view.stage.shareRange(range),
      view => view.scene?.fluid[1] > 0);
  #turning = new SharedRange(range => this.#look.showTurning(range), (view, range) => view.stage.shareTurning(range),
      view => view.stage.wantsWater);
  #force = new SharedRange(range => this.#look.showForce(range), (view, range) => view.stage.shareForce(range),
      view => view.scene?.fields.includes('force'));
  #pressure = new SharedRange(range => this.#look.showPressure(range), (view, range) => view.stage.sharePressure(range),
      view => view.scene?.fields.includes('force'));
  #transport = new Transport(this);
  #watching = new Watching(this);
  #capture = new Capture(() => this.#views.map(view => view.stage));

  constructor(setup, memory) {
    this.#setup = setup;
    const openAbout = about(true);
    const presentation = new Presentation(isOn => this.#views.forEach(view => {
      view.stage.rig.isOrbiting = isOn;
    }));
    this.#look = new LookControls(firstLook(memory.look), () => this.#lookChanged());
    this.#charts = new LiveCharts();
    this.#theme = new Theme(memory.theme ?? 'auto', () => this.#themeChanged());
    this.#controls = new SwimControls(this, setup);
    this.#runs = new RunBrowser(setup.runs, (run, best, beside) => this.#watching.watch(run, best, beside), () => this.#markRun());
    const cameras = CAMERAS.map((name, i) => [name, name, `key ${i + 1}`]);
    fillSegments(byId('cameras'), 'camera', cameras, mode => this.setCamera(mode));
    fillSegments(byId('which'), 'which', [['0', 'Left'], ['1', 'Right']], which => this.#choose(Number(which)));
    this.#addView(memory.views?.[0] ?? setup.start);
    if (memory.views?.[1]) {
      this.#addView(memory.views[1]);
    }
    this.setCamera(memory.camera ?? 'follow');
    this.#choose(0);
    this.#listen();
    listenToShortcuts(this, {transport: this.#transport, controls: this.#controls, look: this.#look, runs: this.#runs,
      theme: this.#theme, presentation, openAbout});
    if (setup.runs.length > 0) {
      const run = setup.runs.some(({id}) => id === memory.run?.run) ? memory.run : {run: setup.runs[0].id};
      this.#runs.load(run.run).then(() => this.#markRun());
    }
    requestAnimationFrame(now => this.#tick(now));
  }

  get views() {
    return this.#views;
  }

  /** The chosen one. */
  get view() {
    return this.#views[this.#chosen];
  }

  #listen() {
    listenToBanner();
    byId('compare').addEventListener('click', () => this.toggleCompare());
    byId('picture-save').addEventListener('click', () => this.savePicture());
    byId('film').addEventListener('click', () => this.toggleFilm());
    this.#capture.onRecording = isOn => byId('film').setAttribute('aria-pressed', String(isOn));
    byId('theme').addEventListener('change', () => this.#theme.choose(byId('theme').value));
  }

  #tick(now) {
    this.#transport.tick(now);
    this.#views.forEach(view => view.draw(now));
    this.#capture.tick();
    this.#charts.tick(this.#views);
    if (now - this.#lastFigures > FIGURES_MS) {
      this.#lastFigures = now;
      this.#views.forEach((view, i) => this.#figures[i].show(view));
    }
    requestAnimationFrame(next => this.#tick(next));
  }

  // --- views

  #addView(setting) {
    const which = this.#views.length;
    const element = byId(`stage-${NAMES[which]}`);
    element.hidden = false;
    const view = new View(element.querySelector('.picture'), setting, this.#setup.start, this.#setup.scenes, {
      scene: () => this.#sceneChanged(which),
      status: showStatus,
      notice: showBanner,
      range: range => this.#range.changed(which, range, this.#views),
      turning: range => this.#turning.changed(which, range, this.#views),
      force: range => this.#force.changed(which, range, this.#views),
      pressure: range => this.#pressure.changed(which, range, this.#views),
    });
    view.stage.setTheme(this.#theme.colours);
    view.stage.setLook(this.#look.look);
    view.stage.rig.setMode(this.#camera);
    view.stage.rig.onMode = () => choose(byId('cameras'), view.stage.rig.mode);
    this.#views.push(view);
    this.#figures.push(new Figures(element));
    this.#views.forEach(one => {
      one.isLed = this.#views.length > 1;
    });
    this.#compareChanged();
  }

  #removeSecond() {
    this.#views.pop().close();
    this.#transport.renew();
    this.#views[0].isLed = false;
    this.#figures.pop();
    this.#range.keepFirst(this.#views[0]);
    [this.#turning, this.#force, this.#pressure].forEach(one => one.keepFirst(this.#views[0]));
    const old = byId('stage-b').querySelector('.picture');
    old.replaceWith(old.cloneNode());
    /** @type {HTMLElement} */ (byId('stage-b').querySelector('.overlay')).hidden = false;
    byId('stage-b').hidden = true;
    this.#choose(0);
    this.#compareChanged();
  }

  /** Shows a second view that begins as the first is, or closes it. */
  toggleCompare(setting = null) {
    if (this.#views.length === 2) {
      this.#removeSecond();
      return;
    }
    this.#addView(setting ?? {...this.#views[0].setting});
  }

  #compareChanged() {
    const isTwo = this.#views.length === 2;
    byId('compare').setAttribute('aria-pressed', String(isTwo));
    byId('which').hidden = !isTwo;
    this.remember();
  }

  #choose(which) {
    this.#chosen = which;
    choose(byId('which'), which);
    this.showControls();
  }

  /** All back to the start. */
  reset() {
    return this.#transport.reset();
  }

  // --- what changes

  #sceneChanged(which) {
    const {scene} = this.#views[which];
    if (scene !== null) {
      this.#markRun();
      this.#name(which);
    }
    const has = contents(this.#views.map(view => view.scene).filter(one => one !== null));
    this.#look.has = has;
    this.#charts.show(has);
    if (which === this.#chosen) {
      this.showControls();
    }
    this.remember();
  }

  #name(which) {
    this.#figures[which].name(...caption(this.#views[which], this.#setup.gaits));
  }

  /** The list of a run marks what swims in the chosen view; what swims is named by the run if it is of it. */
  #markRun() {
    this.#views.forEach((view, which) => {
      const found = view.scene === null ? null : this.#runs.find(view.scene, view.origin);
      if (found !== null && view.origin === null) {
        view.setOrigin(found);
        this.#name(which);
      }
      if (which === this.#chosen) {
        this.#runs.mark(found?.item ?? null);
      }
    });
  }

  /** Shows in the controls what is set for the chosen view. */
  showControls() {
    this.#transport.show();
    if (this.view.scene !== null) {
      this.#controls.show();
    }
  }

  #lookChanged() {
    const look = this.#look.look;
    this.#views.forEach(view => view.stage.setLook(look));
    this.remember();
  }

  #themeChanged() {
    byId('theme').value = this.#theme?.choice ?? 'auto';
    this.#charts.recolour();
    this.#runs?.draw();
    this.#views.forEach(view => view.stage.setTheme(this.#theme.colours));
    this.remember();
  }

  setCamera(mode) {
    this.#camera = mode;
    choose(byId('cameras'), mode);
    this.#views.forEach(view => view.stage.rig.setMode(mode));
    this.remember();
  }

  /** Keeps what is set in the page's address, soon. */
  remember() {
    rememberSoon(() => ({
      views: this.#views.map(view => view.setting), camera: this.#camera, look: this.#look.look,
      theme: this.#theme.choice, run: this.#runs.choice,
    }));
  }

  // --- pictures

  savePicture() {
    return this.#capture.savePicture(fileName(this.view.scene, 'picture', 'png'));
  }

  toggleFilm() {
    byId('transport-error').textContent = this.#capture.toggleRecording(fileName(this.view.scene, 'film', 'webm')) ?? '';
  }
}

async function begin() {
  try {
    const answer = await fetch('/api/setup');
    if (!answer.ok) {
      throw new Error(`${answer.status} ${answer.statusText}`);
    }
    window.natator = figures(new Page(await answer.json(), remembered()));
  } catch (error) {
    showStatus('lost', `The page cannot start: ${error.message}`);
    throw error;
  }
}

begin();
