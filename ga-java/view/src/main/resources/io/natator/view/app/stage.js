/** A picture of one scene: which frame, from where, how fine; drawn with WebGL or without. */

import * as THREE from 'three';
import {CameraRig} from './cameras.js';
import {Dye} from './dye.js';
import {FieldValues} from './fields.js';
import {Forces} from './forces.js';
import {GlPicture} from './gl-picture.js';
import {hasGraphicsCard} from './graphics-card.js';
import {PlainPicture} from './plain-picture.js';
import {Quality} from './quality.js';
import {boundsAround, centreOf, contents, hasOpenAxes, movedBounds, tankBounds, waterShown} from './scene.js';
import {SkinPressure} from './skin-pressure.js';
import {SpineTrace} from './trace.js';
import {Wake} from './wake.js';

/**
 * What can be chosen: water spheres, surface, vorticity, velocity, pressure, vortices or none; plane level, along or across, and its
 * place, −1 to 1; body skin or particles, with its pressure and forces; colour speed, density, mass or none; drawing
 * auto, webgl or plain.
 */
const DEFAULT_LOOK = {
  water: hasGraphicsCard() ? 'surface' : 'spheres', body: 'skin', colour: 'speed', opacity: 0.55, cut: false, muscles: true, trace: true, dye: false, pressure: false, forces: false,
  plane: 'level', place: 0, quality: 'auto',
  drawing: 'auto',
};

/** Ways of drawing, each tried if the one before fails. */
const DRAWINGS = ['webgl', 'plain'];

/**
 * What a page begins with: what it remembers, and the drawing that its address asks for, as in `?drawing=webgl`. A drawing
 * that is not known is chosen automatically.
 */
export function firstLook(remembered = {}) {
  const asked = [new URLSearchParams(location.search).get('drawing'), remembered.drawing];
  return {...DEFAULT_LOOK, ...remembered, drawing: asked.find(one => DRAWINGS.includes(one)) ?? 'auto'};
}

/** Drawings of the screen after which a picture that rests is refined: drawn again with all its pixels, and more samples. */
const REST = 10;

/** Where a wake is shown the camera looks so far behind the body, in its lengths: bodies begin along x. */
const BEHIND = 0.35;

/** What counts as the time of drawing where the graphics card is not done when the next drawing begins. */
const LATE_MS = 100;

/** Draws into an element when there is something new, and else does nothing. */
export class Stage {
  #host;
  #picture = null;
  #drawing = null;
  #trace = new SpineTrace();
  #field = new FieldValues();
  #wake = new Wake();
  #dye = new Dye();
  #forces = new Forces();
  #pressure = new SkinPressure();
  /** @type {Scene|null} */
  #scene = null;
  /** @type {Frame|null} */
  #frame = null;
  #tank = null;
  #bounds = null;
  #look = {...DEFAULT_LOOK};
  #colours = null;
  #quality = new Quality();
  #forward = new THREE.Vector3();
  #centre = [0, 0, 0];
  #last = 0;
  #isNew = true;
  #listening = new AbortController();
  #rested = 0;
  #samples = 0;
  #origin = '';
  #isTooSlow = false;
  #share = 0;
  #width = 0;
  #height = 0;

  /** `host` is what the picture fills, and what takes drags and keys. */
  constructor(host) {
    this.#host = host;
    this.rig = new CameraRig(host);
    this.#field.onRange = range => this.onRange(range);
    this.#wake.onRange = range => this.onTurning(range);
    this.#forces.onRange = range => this.onForce(range);
    this.#pressure.onRange = range => this.onPressure(range);
    new ResizeObserver(() => {
      this.#isNew = true;
    }).observe(host);
    document.addEventListener('visibilitychange', () => this.#quality.rest(), {signal: this.#listening.signal});
  }

  /**
   * Called with the ends of the water's colour scale.
   *
   * @type {(range: number[]) => void}
   */
  onRange = () => {};

  /**
   * Called with the ends of the scale of vorticity.
   *
   * @type {(range: number[]) => void}
   */
  onTurning = () => {};

  /**
   * Called with 0 and the force of an arrow of a certain length; with the ends of the scale of pressure on the body.
   *
   * @type {(range: number[]) => void}
   */
  onForce = () => {};
  /** @type {(range: number[]) => void} */
  onPressure = () => {};

  /** Ends of the colour scale that hold instead of this picture's own; null for its own. */
  shareRange(range) {
    this.#field.shared = range;
    this.#isNew = true;
  }

  /** Likewise of vorticity. */
  shareTurning(range) {
    this.#wake.shared = range;
    this.#isNew = true;
  }

  /** Likewise of forces and of pressure. */
  shareForce(range) {
    this.#forces.shared = range;
    this.#isNew = true;
  }

  sharePressure(range) {
    this.#pressure.shared = range;
    this.#isNew = true;
  }

  /** The share of the screen's pixels that are drawn, along each side. */
  get share() {
    return this.#share;
  }

  /** How many samples a picture that rests has been refined by so far. */
  get samples() {
    return this.#isNew || this.rig.hasMoved ? 0 : this.#samples;
  }

  /** What draws: WebGL or processor. */
  get drawing() {
    return this.#picture?.name ?? '';
  }

  /**
   * Takes over a scene (SCEN); the next frame is one of it.
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    this.#tank = this.#scene === null || scene.restarted ? null : this.#tank;
    this.#scene = scene;
    this.#wake.setScene(scene);
    this.#dye.setScene(scene);
    this.#forces.setScene(scene);
    this.#pressure.setScene(scene);
    this.#frame = scene.restarted ? null : this.#frame;
    this.#trace.setScene(scene);
    this.#picture?.setScene(scene);
    this.#showLook();
  }

  /**
   * Shows this frame from the next drawing on.
   *
   * @param {Frame} frame
   */
  setFrame(frame) {
    this.#frame = frame;
    const origin = frame.origin ?? [0, 0, 0];
    if (this.#tank === null) {
      this.#tank = tankBounds(this.#scene, frame.position);
      this.#bounds = this.#tank;
      this.#picture?.setBounds(this.#bounds);
      this.rig.setBounds(this.#bounds);
    } else if (hasOpenAxes(this.#scene) || `${origin}` !== this.#origin) {
      this.#bounds = boundsAround(movedBounds(this.#tank, origin), this.#scene, frame.position);
      this.#picture?.setBounds(this.#bounds);
      this.rig.moveBounds(this.#bounds);
    }
    this.#origin = `${origin}`;
    this.#trace.update(frame);
    if (this.#hasDye) {
      this.#dye.update(frame, this.#wake.water);
    }
    this.#forces.update(frame);
    this.#isNew = true;
  }

  /** What is shown; see `DEFAULT_LOOK`. */
  setLook(look) {
    this.#look = {...look};
    if (!look.dye) {
      this.#dye.clear();
    }
    this.#choosePicture();
    this.#showLook();
    this.#quality.rest();
    this.#isNew = true;
  }

  /** The force on each part of bodies, mass length/s²; empty where it is not shown. */
  get forces() {
    return this.#look.forces ? this.#forces.forces : [];
  }

  /** Whether something of the wake is drawn: a slice, or vortices. */
  get hasWake() {
    return this.#wake.slice !== null || this.#wake.vortices !== null;
  }

  /** Whether it is to be given water on a grid. */
  get wantsWater() {
    return this.#wake.isShown || this.#hasDye || this.#pressure.isShown;
  }

  get #hasDye() {
    return this.#look.dye && this.#scene !== null && contents([this.#scene]).wake;
  }

  /**
   * Shows this water from the next drawing on.
   *
   * @param {Water} water
   */
  setWater(water) {
    const {body} = this.#scene;
    const {min, max} = this.#bounds;
    this.#wake.setWater(water, body.length > 0 ? centreOf(body, this.#frame.position, [0, 0, 0])
      : min.map((low, axis) => (low + max[axis]) / 2), this.#frame.position);
    this.#pressure.setWater(water, this.#frame.position);
    this.#isNew = true;
  }

  /** What of the look can be shown of the scene. */
  #showLook() {
    const has = this.#scene === null ? null : contents([this.#scene]);
    const water = has === null ? this.#look.water : waterShown(this.#look.water, has);
    this.#wake.show(water, this.#look.plane, this.#look.place);
    this.#pressure.isShown = this.#look.pressure && (has?.forces ?? false);
    this.#forces.isShown = this.#look.forces;
    if (this.#frame !== null) {
      this.#forces.update(this.#frame);
    }
    this.#picture?.setLook({...this.#look, water});
  }

  /** Colours as CSS; see `Theme.colours`. */
  setTheme(colours) {
    this.#colours = colours;
    this.#picture?.setTheme(colours);
    this.#isNew = true;
  }

  /**
   * Draws if the frame, the camera or the look changed. What rests is refined, a sample at a time.
   *
   * @param {number} now milliseconds
   * @param {boolean} isPaused whether no frame is to come
   * @returns {boolean} whether it drew
   */
  draw(now, isPaused) {
    const seconds = Math.min((now - this.#last) / 1000, 0.1);
    this.#last = now;
    if (this.#frame === null || this.#host.clientWidth === 0 || this.#host.clientHeight === 0) {
      return false;
    }
    const {body} = this.#scene;
    const centre = body.length > 0 ? centreOf(body, this.#frame.position, this.#centre) : null;
    if (centre !== null && this.#wake.isShown) {
      centre[0] -= BEHIND * this.#scene.bodyLength;
    }
    this.rig.setBody(centre);
    this.rig.update(seconds, this.#host.clientWidth / this.#host.clientHeight);
    const isChanged = this.#isNew || this.rig.hasMoved;
    this.#rested = isChanged ? 0 : this.#rested + 1;
    const isRefining = !isChanged && isPaused && this.#rested >= REST && this.#samples < this.#picture.samples
        && !this.#picture.isBusy;
    if (!isChanged) {
      this.#quality.rest();
    }
    if (!isChanged && !isRefining) {
      return false;
    }
    this.#isNew = false;
    this.rig.hasMoved = false;
    const {camera} = this.rig;
    camera.updateMatrixWorld();
    const from = this.#look.cut ? this.rig.depthOfBody(camera.getWorldDirection(this.#forward)) : -Infinity;
    // A new size empties the canvas: only here, where it is drawn at once.
    this.#fit(isRefining);
    if (isRefining) {
      this.#picture.refine(this.#frame, camera, from, this.#samples++);
      return true;
    }
    this.#samples = 0;
    const isLate = this.#picture.isBusy;
    const began = performance.now();
    this.#picture.draw(this.#frame, camera, from);
    const milliseconds = isLate ? LATE_MS : performance.now() - began;
    if (this.#look.quality === 'auto' && this.#quality.drawn(now / 1000, milliseconds)) {
      this.#isNew = true;
    }
    if (this.#quality.isHopeless && this.#look.drawing === 'auto' && this.#drawing !== 'plain') {
      this.#isTooSlow = true;
      this.#quality = new Quality();
      this.#choosePicture();
      this.#isNew = true;
    }
    return true;
  }

  /** Paints what is seen onto a canvas whose context counts in pixels of the page from the corner of `box` on. */
  paintOn(context, box) {
    if (this.#frame !== null) {
      this.#picture.show();
      const place = this.#host.getBoundingClientRect();
      context.drawImage(this.#host.firstChild, place.x - box.x, place.y - box.y, place.width, place.height);
    }
  }

  /** The way to draw that the look and this machine ask for. */
  #wantedDrawing() {
    const {drawing} = this.#look;
    const isCard = drawing === 'auto' && hasGraphicsCard() && !this.#isTooSlow;
    return isCard || drawing === 'webgl' ? 'webgl' : 'plain';
  }

  /** Frees what it drew with. It is drawn no more. */
  close() {
    this.#listening.abort();
    this.#picture?.dispose();
    this.#picture = null;
  }

  #choosePicture() {
    const wanted = this.#wantedDrawing();
    if (this.#picture !== null && wanted === this.#drawing) {
      return;
    }
    this.#picture?.dispose();
    this.#picture = null;
    this.#drawing = wanted;
    for (const way of DRAWINGS.slice(DRAWINGS.indexOf(wanted))) {
      try {
        this.#picture ??= this.#newPicture(way);
      } catch (error) {
        console.warn(`without ${way}: ${error.message}`);
      }
    }
    this.#share = 0;
    this.#showLook();
    if (this.#colours !== null) {
      this.#picture.setTheme(this.#colours);
    }
    if (this.#scene !== null) {
      this.#picture.setScene(this.#scene);
    }
    if (this.#bounds !== null) {
      this.#picture.setBounds(this.#bounds);
    }
  }

  #newPicture(way) {
    const canvas = document.createElement('canvas');
    this.#host.replaceChildren(canvas);
    const Picture = way === 'plain' ? PlainPicture : GlPicture;
    return new Picture(canvas,
        {trace: this.#trace, field: this.#field, wake: this.#wake, dye: this.#dye, forces: this.#forces, pressure: this.#pressure});
  }

  /** Gives the canvas the size and detail that hold now. */
  #fit(isRefining) {
    const width = this.#host.clientWidth;
    const height = this.#host.clientHeight;
    const share = this.#look.quality !== 'auto' ? Number(this.#look.quality) : isRefining ? 1 : this.#quality.share;
    if (width !== this.#width || height !== this.#height || share !== this.#share) {
      this.#width = width;
      this.#height = height;
      this.#share = share;
      this.#picture.setSize(width, height, share, this.rig.camera.fov);
    }
  }
}
