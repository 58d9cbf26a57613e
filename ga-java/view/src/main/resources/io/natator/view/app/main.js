/** The page of `natator view`: puts its parts together. */

import {about} from './about.js';
import {CAMERAS} from './cameras.js';
import {Capture} from './capture.js';
import {byId, choose, fillSegments, fillSelect} from './element.js';
import {Figures} from './figures.js';
import {GaitControls, isAtRest, isSameGait, parseGait, randomGait, waveGait} from './gait.js';
import {listen} from './keys.js';
import {LiveCharts} from './livecharts.js';
import {Lockstep} from './lockstep.js';
import {LookControls} from './look.js';
import {remembered, rememberSoon} from './memory.js';
import {listenToBanner, showBanner, showStatus} from './notices.js';
import {Presentation} from './present.js';
import {figures} from './probe.js';
import {RunBrowser} from './runs.js';
import {download, fileName, gaitText, sceneText} from './save.js';
import {contents} from './scene.js';
import {SolverControls, withoutSettings} from './solver.js';
import {DEFAULT_LOOK, lookOfAddress} from './stage.js';
import {Theme} from './theme.js';
import {View} from './view.js';
import {Watching} from './watching.js';

const FIGURES_MS = 250;
const NAMES = ['a', 'b'];

/** The whole page: one or two views, and controls for the chosen one. */
class Page {
  #setup;
  #views = [];
  #figures = [];
  #ranges = [];
  #chosen = 0;
  #camera = 'follow';
  #look;
  #theme;
  #gait;
  #solver;
  #charts;
  #runs;
  #lastFigures = 0;
  #vacuumBusy = false;
  #lockstep;
  #watching = new Watching(this);
  #openAbout = about(true);
  #presentation = new Presentation(isOn => this.#views.forEach(view => {
    view.stage.rig.isOrbiting = isOn;
  }));
  #capture = new Capture(() => this.#views.map(view => view.stage));

  constructor(setup, memory) {
    this.#setup = setup;
    this.#look = new LookControls({...DEFAULT_LOOK, ...memory.look, ...lookOfAddress()}, () => this.#lookChanged());
    this.#charts = new LiveCharts(setup.modes);
    this.#theme = new Theme(memory.theme ?? 'auto', () => this.#themeChanged());
    this.#gait = new GaitControls(gait => this.view.setGait(gait));
    this.#solver = new SolverControls((key, patch) => this.view.setOverrides(key, patch));
    this.#runs = new RunBrowser(setup.runs, (run, best, beside) => this.#watching.watch(run, best, beside), () => this.#markRun());
    this.#lockstep = this.#newLockstep();
    fillSelect(byId('scheme'), setup.schemes.map(scheme => [scheme, scheme]));
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

  #tick(now) {
    if (!this.#lockstep.isBusy) {
      this.#views.forEach(view => view.receive());
    }
    if (this.#views.length > 1) {
      this.#lockstep.tick(now, this.#views);
    }
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
      range: range => this.#rangeChanged(which, range),
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
    this.#lockstep = this.#newLockstep();
    this.#views[0].isLed = false;
    this.#figures.pop();
    this.#ranges.length = 1;
    this.#views[0].stage.shareRange(null);
    if (this.#ranges[0] !== undefined) {
      this.#look.showRange(this.#ranges[0]);
    }
    const old = byId('stage-b').querySelector('.picture');
    old.replaceWith(old.cloneNode());
    byId('stage-b').querySelector('.overlay').hidden = false;
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
    byId('compare').setAttribute('aria-pressed', isTwo);
    byId('which').hidden = !isTwo;
    this.#remember();
  }

  #choose(which) {
    this.#chosen = which;
    choose(byId('which'), which);
    this.#showControls();
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
      this.#showControls();
    }
    this.#remember();
  }

  /** Who swims there: run and generation, or which other gait, and in what. */
  #name(which) {
    const {scene, origin} = this.#views[which];
    const place = scene.scene.split('/').at(-1);
    const figures = [scene.scheme, ...scene.actuators > 0 ? [`${scene.gait.frequency.toFixed(2)} beats/s`] : [],
      `${scene.particles} particles`];
    if (origin !== null) {
      this.#figures[which].name(`${origin.run}, ${origin.label ?? 'a gait'}`, [place, ...figures].join(', '));
    } else {
      const published = this.#setup.gaits?.[scene.scene] ?? null;
      const gait = scene.actuators === 0 ? '' : isSameGait(scene.gait, published) ? ', published gait' : ', gait of your own';
      this.#figures[which].name(place + gait, figures.join(', '));
    }
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

  /** Two pictures of water have one scale, over both. */
  #rangeChanged(which, range) {
    this.#ranges[which] = range;
    const all = this.#views.map((view, i) => view.isVacuum ? undefined : this.#ranges[i]).filter(one => one !== undefined);
    const both = [Math.min(...all.map(one => one[0])), Math.max(...all.map(one => one[1]))];
    this.#views.forEach(view => view.stage.shareRange(all.length > 1 ? both : null));
    if (all.length > 0) {
      this.#look.showRange(both);
    }
  }

  #showControls() {
    const view = this.view;
    this.#showRun();
    byId('rate').value = String(view.setting.rate);
    if (view.scene === null) {
      return;
    }
    const {scene} = view;
    const names = this.#setup.scenes.includes(scene.scene) ? this.#setup.scenes : [scene.scene, ...this.#setup.scenes];
    if (byId('scene').options.length !== names.length) {
      fillSelect(byId('scene'), names.map(name => [name, name]));
    }
    byId('scene').value = scene.scene;
    byId('scheme').value = scene.scheme;
    if (!this.#vacuumBusy) {
      byId('vacuum').checked = view.isVacuum;
    }
    this.#gait.show(scene);
    this.#solver.show(scene);
    byId('gait-save').disabled = scene.gait === null;
    for (const id of ['gait-random', 'gait-load']) {
      byId(id).disabled = scene.actuators === 0;
    }
  }

  #showRun() {
    byId('run').textContent = this.view.isPaused ? 'Run' : 'Pause';
  }

  #lookChanged() {
    const look = this.#look.look;
    this.#views.forEach(view => view.stage.setLook(look));
    this.#remember();
  }

  #themeChanged() {
    byId('theme').value = this.#theme?.choice ?? 'auto';
    this.#charts.recolour();
    this.#runs?.draw();
    this.#views.forEach(view => view.stage.setTheme(this.#theme.colours));
    this.#remember();
  }

  setCamera(mode) {
    this.#camera = mode;
    choose(byId('cameras'), mode);
    this.#views.forEach(view => view.stage.rig.setMode(mode));
    this.#remember();
  }

  #remember() {
    rememberSoon(() => ({
      views: this.#views.map(view => view.setting), camera: this.#camera, look: this.#look.look,
      theme: this.#theme.choice, run: this.#runs.choice,
    }));
  }

  // --- commands

  async #all(action, error) {
    const answers = await Promise.all(this.#views.map(action));
    byId(error).textContent = answers.find(answer => typeof answer === 'string') ?? '';
    this.#showRun();
    this.#remember();
  }

  toggleRun() {
    const isPaused = this.view.isPaused;
    return this.#all(view => isPaused ? view.run() : view.pause(), 'transport-error');
  }

  step() {
    if (this.#views.length > 1) {
      this.#lockstep.wanted++;
      return this.#all(view => view.pause(), 'transport-error');
    }
    return this.#all(view => view.step(), 'transport-error');
  }

  /** All back to the start. */
  reset() {
    return this.#views.length > 1 ? this.#lockstep.reset(this.#views)
        : this.#all(view => view.reset(), 'transport-error');
  }

  /** What leads two views; one that was led before has no more say, though its last step may still be under way. */
  #newLockstep() {
    const lockstep = new Lockstep();
    lockstep.onStep = error => lockstep === this.#lockstep && this.#stepped(error);
    return lockstep;
  }

  /** After a step of two views: where one cannot go on, neither does. */
  #stepped(error) {
    byId('transport-error').textContent = error ?? '';
    if (error !== null && this.#views.every(view => view.isReady)) {
      this.#views.forEach(view => view.pause());
      this.#showRun();
    }
  }

  setRate(value) {
    byId('rate').value = String(value);
    return this.#all(view => view.setRate(value), 'transport-error');
  }

  #moveRate(step) {
    const options = byId('rate').options;
    const at = Math.min(options.length - 1, Math.max(0, byId('rate').selectedIndex + step));
    this.setRate(Number(options[at].value));
  }

  async #changeScene(name) {
    const scheme = this.view.scene?.overrides?.scheme;
    const overrides = scheme === undefined ? null : {scheme};
    const error = await this.view.setScene(name, overrides, null);
    byId('scene-error').textContent = error ?? '';
    if (error === null && isAtRest(this.view.scene)) {
      this.view.setGait(this.#setup.gaits?.[name] ?? waveGait(this.view.scene.actuators));
    }
  }

  async #changeVacuum(isVacuum) {
    this.#vacuumBusy = true;
    const error = await this.view.setVacuum(isVacuum);
    this.#vacuumBusy = false;
    byId('scene-error').textContent = error ?? '';
    this.#showControls();
  }

  async #changeScheme(scheme) {
    byId('scene-error').textContent = await this.view.setOverrides('scheme', {scheme}) ?? '';
    this.#showControls();
  }

  async #loadGait(file) {
    try {
      byId('gait-error').textContent = await this.view.setGait(parseGait(await file.text())) ?? '';
    } catch (error) {
      byId('gait-error').textContent = `${file.name}: ${error.message}`;
    }
  }

  #savePicture() {
    return this.#capture.savePicture(fileName(this.view.scene, 'picture', 'png'));
  }

  #toggleFilm() {
    byId('transport-error').textContent = this.#capture.toggleRecording(fileName(this.view.scene, 'film', 'webm')) ?? '';
  }

  // --- inputs

  #listen() {
    const click = (id, action) => byId(id).addEventListener('click', action);
    const change = (id, action) => byId(id).addEventListener('change', event => action(event.target));
    click('run', () => this.toggleRun());
    click('step', () => this.step());
    click('reset', () => this.reset());
    click('compare', () => this.toggleCompare());
    listenToBanner();
    click('gait-save', () => download(fileName(this.view.scene, 'gait'), gaitText(this.view.scene)));
    click('scene-save', () => download(fileName(this.view.scene, 'scene'), sceneText(this.view.scene)));
    click('gait-load', () => byId('gait-file').click());
    click('gait-random', async () => {
      byId('gait-error').textContent = await this.view.setGait(randomGait(this.view.scene.actuators)) ?? '';
    });
    click('picture-save', () => this.#savePicture());
    click('film', () => this.#toggleFilm());
    this.#capture.onRecording = isOn => byId('film').setAttribute('aria-pressed', isOn);
    click('solver-default', async () => {
      const {scene, overrides, gait} = this.view.scene;
      byId('solver-error').textContent = await this.view.setScene(scene, withoutSettings(overrides), gait) ?? '';
    });
    change('gait-file', input => {
      if (input.files.length > 0) {
        this.#loadGait(input.files[0]);
        input.value = '';
      }
    });
    change('rate', select => this.setRate(Number(select.value)));
    change('scene', select => this.#changeScene(select.value));
    change('scheme', select => this.#changeScheme(select.value));
    change('vacuum', input => this.#changeVacuum(input.checked));
    change('theme', select => this.#theme.choose(select.value));
    this.#listenToKeys();
  }

  #listenToKeys() {
    listen([
      [' ', 'run or pause', () => this.toggleRun()],
      ['.', 'one frame', () => this.step()],
      ['r', 'back to the start', () => this.reset()],
      [['+', '-'], 'faster, slower', key => this.#moveRate(key === '+' ? 1 : -1)],
      [['1', '2', '3', '4'], 'camera: follow, side, top, free', key => this.setCamera(CAMERAS[Number(key) - 1])],
      ['v', 'vacuum, water', () => this.#changeVacuum(!this.view.isVacuum)],
      ['w', 'water: spheres, surface, none', () => this.#look.next('water')],
      ['c', 'colour: speed, density, mass, nothing', () => this.#look.next('colour')],
      ['k', 'body: skin, particles', () => this.#look.next('body')],
      ['x', 'cut the water open at the body', () => this.#look.toggle('cut')],
      ['m', 'muscles', () => this.#look.toggle('muscles')],
      ['t', 'trace of the spine', () => this.#look.toggle('trace')],
      ['b', 'two swimmers side by side', () => this.toggleCompare()],
      [['[', ']'], 'generation before, after', key => this.#runs.move(key === ']' ? 1 : -1)],
      ['d', 'light, dark', () => this.#theme.toggle()],
      ['p', 'presentation: the picture alone', () => this.#presentation.toggle()],
      ['i', 'save the picture', () => this.#savePicture()],
      ['f', 'film: record, save', () => this.#toggleFilm()],
      ['a', 'about this', () => this.#openAbout()],
      ['?', 'this list', () => byId('help').showModal()],
    ]);
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
