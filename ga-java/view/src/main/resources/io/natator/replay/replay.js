/** The page of `natator page`: plays packed swims. */

import {about} from './about.js';
import {CAMERAS} from './cameras.js';
import {TimeChart, chartColours} from './charts.js';
import {byId, choose, fillSegments, fillSelect, make} from './element.js';
import {namedFacts} from './facts.js';
import {Figures} from './figures.js';
import {History} from './history.js';
import {listen} from './keys.js';
import {LookControls} from './look.js';
import {Meter} from './meter.js';
import {Presentation} from './present.js';
import {Recording} from './recording.js';
import {fixed} from './scaling.js';
import {contents} from './scene.js';
import {Stage, firstLook} from './stage.js';
import {Theme} from './theme.js';

const SLOW_MS = 100;

/** One swim at a time, played round and round. */
class Player {
  #texts = /** @type {HTMLElement[]} */ ([...document.querySelectorAll('script.swim')]);
  #stage = new Stage(document.querySelector('.picture'));
  #figures = new Figures(byId('stage-a'));
  #meter = new Meter();
  #history = new History();
  #charts;
  #look;
  #theme;
  #openAbout = about(false);
  #presentation = new Presentation(isOn => {
    this.#stage.rig.isOrbiting = isOn;
  });
  #recording = null;
  #water = null;
  #time = 0;
  #speed = 1;
  #isPaused = false;
  #isMoved = true;
  #last = 0;
  #lastSlow = 0;

  /**
   * The frame that is shown, or null.
   *
   * @type {Frame|null}
   */
  frame = null;

  constructor() {
    this.#look = new LookControls(firstLook(), look => this.#stage.setLook(look));
    this.#stage.onRange = range => this.#look.showRange(range);
    this.#stage.onTurning = range => this.#look.showTurning(range);
    this.#charts = [
      new TimeChart(byId('chart-distance'), ['distance'], 0.01),
      new TimeChart(byId('chart-speed'), ['beatSpeed', 'speed'], 0.02),
      new TimeChart(byId('chart-momentum'), ['momentum', 'angularMomentum'], 0.01),
    ];
    this.#theme = new Theme('auto', () => this.#themeChanged());
    this.#stage.setTheme(this.#theme.colours);
    this.#stage.setLook(this.#look.look);
    fillSelect(byId('swim'), this.#texts.map((one, i) => [i, one.dataset.title]));
    const cameras = CAMERAS.map((name, i) => [name, name, `key ${i + 1}`]);
    fillSegments(byId('cameras'), 'camera', cameras, mode => this.#setCamera(mode));
    this.#setCamera('follow');
    this.#stage.rig.onMode = mode => choose(byId('cameras'), mode);
    this.#listen();
    requestAnimationFrame(now => this.#tick(now));
  }

  get stage() {
    return this.#stage;
  }

  get scene() {
    return this.#recording?.scene ?? null;
  }

  get isPaused() {
    return this.#isPaused;
  }

  get fps() {
    return this.#meter.fps;
  }

  get pace() {
    return this.#meter.pace;
  }

  get dropped() {
    return 0;
  }

  /** Unpacks a swim and plays it from its start. */
  async show(which) {
    byId('status').textContent = 'unpacking';
    byId('status').dataset.state = 'connecting';
    this.#recording = await Recording.of(this.#texts[which].textContent);
    const {scene, frames, duration} = this.#recording;
    this.#history = new History();
    const every = Math.ceil(frames / 1400);
    for (let i = 0; i < frames; i += every) {
      this.#history.add(this.#recording.at(i * this.#recording.interval), scene.bodyLength, scene.gait?.frequency ?? 0);
    }
    byId('scrub').max = String(duration);
    this.#stage.setScene(scene);
    this.#water = null;
    this.#look.has = contents([scene]);
    this.#figures.name(this.#recording.title, `${scene.scheme}, ${scene.particles} particles`);
    this.#showFacts();
    this.seek(0);
    byId('status').textContent = `${duration.toFixed(1)} s`;
    byId('status').dataset.state = 'open';
  }

  /** Goes to a time. */
  seek(time) {
    const duration = this.#recording?.duration ?? 0;
    this.#time = Math.min(duration, Math.max(0, time));
    this.#isMoved = true;
  }

  /** Goes so many frames on and stays there. */
  step(frames) {
    this.setPaused(true);
    this.seek((Math.round(this.#time / this.#recording.interval) + frames) * this.#recording.interval);
  }

  setPaused(isPaused) {
    this.#isPaused = isPaused;
    byId('play').textContent = isPaused ? 'Play' : 'Pause';
  }

  #tick(now) {
    const seconds = Math.min(0.1, (now - this.#last) / 1000);
    this.#last = now;
    if (this.#recording !== null) {
      this.#advance(seconds);
      if (this.#isMoved) {
        this.#isMoved = false;
        this.frame = this.#recording.at(this.#time);
        this.#stage.setFrame(this.frame);
        const water = this.#recording.waterAt(this.#time);
        if (water !== this.#water) {
          this.#water = water;
          this.#stage.setWater(water);
        }
        this.#meter.drawn(this.frame.time);
      }
      this.#stage.draw(now, this.#isPaused);
      this.#meter.update(now);
      if (now - this.#lastSlow > SLOW_MS) {
        this.#lastSlow = now;
        this.#showSlowly();
      }
    }
    requestAnimationFrame(next => this.#tick(next));
  }

  #advance(seconds) {
    if (!this.#isPaused) {
      const next = this.#time + this.#speed * seconds;
      this.seek(this.#time >= this.#recording.duration ? 0 : next);
    }
  }

  #showSlowly() {
    byId('scrub').value = String(this.#time);
    byId('scrub').setAttribute('aria-valuetext', `${this.#time.toFixed(2)} s`);
    this.#figures.show(this);
    for (const chart of this.#charts) {
      chart.draw([this.#history], {from: 0, until: this.#recording.duration, cursor: this.#time});
    }
    const index = Math.round(this.#time / this.#recording.duration * (this.#history.length - 1));
    for (const output of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll('[data-chart]'))) {
      output.textContent = fixed(this.#history.at(output.dataset.chart, index), 3);
    }
  }

  #showFacts() {
    const {scene, frames, duration} = this.#recording;
    const gait = scene.gait;
    const list = numbers => numbers.map(one => one.toFixed(3)).join(', ');
    const perSecond = duration > 0 ? Math.round(10 * (frames - 1) / duration) / 10 : 0;
    const facts = [['Scene', scene.scene], ['Scheme', scene.scheme], ['Frames', `${frames}, ${perSecond} per second`]];
    facts.unshift(...namedFacts(this.#recording.facts));
    if (gait) {
      facts.push(['Frequency', `${gait.frequency.toFixed(3)} /s`], ['Amplitude', list(gait.amplitude)],
          ['Phase', list(gait.phase)], ...gait.offset?.some(one => one !== 0) ? [['Offset', list(gait.offset)]] : []);
    }
    facts.push(['Program', `Natator ${scene.program?.version ?? ''}`]);
    byId('facts').replaceChildren(...facts.flatMap(([name, value]) => [
      make('dt', {textContent: name}), make('dd', {textContent: value}),
    ]));
  }

  #setCamera(mode) {
    choose(byId('cameras'), mode);
    this.#stage.rig.setMode(mode);
  }

  #themeChanged() {
    for (const chart of this.#charts) {
      chart.colours = chartColours(byId('chart-distance'));
    }
    byId('theme').value = this.#theme?.choice ?? 'auto';
    if (this.#theme !== undefined) {
      this.#stage.setTheme(this.#theme.colours);
    }
  }

  #listen() {
    byId('play').addEventListener('click', () => this.setPaused(!this.#isPaused));
    byId('before').addEventListener('click', () => this.step(-1));
    byId('after').addEventListener('click', () => this.step(1));
    byId('scrub').addEventListener('input', () => this.seek(Number(byId('scrub').value)));
    byId('speed').addEventListener('change', () => {
      this.#speed = Number(byId('speed').value);
    });
    byId('swim').addEventListener('change', () => this.show(Number(byId('swim').value)));
    byId('theme').addEventListener('change', () => this.#theme.choose(byId('theme').value));
    listen([
      [' ', 'play or pause', () => this.setPaused(!this.#isPaused)],
      [[',', '.'], 'frame before, after', key => this.step(key === '.' ? 1 : -1)],
      ['r', 'back to the start', () => this.seek(0)],
      [['1', '2', '3', '4'], 'camera: follow, side, top, free', key => this.#setCamera(CAMERAS[Number(key) - 1])],
      ['w', 'water: spheres, surface, vorticity, velocity, none', () => this.#look.next('water')],
      ['c', 'colour: speed, density, mass, nothing', () => this.#look.next('colour')],
      ['k', 'body: skin, particles', () => this.#look.next('body')],
      ['x', 'cut the water open at the body', () => this.#look.toggle('cut')],
      ['m', 'muscles', () => this.#look.toggle('muscles')],
      ['t', 'trace of the spine', () => this.#look.toggle('trace')],
      ['y', 'dye from the tail', () => this.#look.toggle('dye')],
      ['p', 'presentation: the picture alone', () => this.#presentation.toggle()],
      ['a', 'about this', () => this.#openAbout()],
      ['d', 'light, dark', () => this.#theme.toggle()],
      ['?', 'this list', () => byId('help').showModal()],
    ]);
  }
}

const player = new Player();
await player.show(0);

/** Figures of what is shown, to be read by tests. */
window.natator = {
  frame: () => player.frame?.frame ?? -1,
  time: () => player.frame?.time ?? 0,
  distance: () => player.frame?.distance ?? 0,
  fps: () => player.fps,
  share: () => player.stage.share,
  drawing: () => player.stage.drawing,
  scene: () => player.scene,
  position: () => Array.from(player.frame?.position ?? []),
};
