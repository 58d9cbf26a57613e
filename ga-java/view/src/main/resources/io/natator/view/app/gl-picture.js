/** Draws with WebGL 2: a scene of three.js, and water over it. */

import * as THREE from 'three';
import {Fence} from './gl-fence.js';
import {GlArrows} from './gl-arrows.js';
import {GlBody} from './gl-body.js';
import {GlDye} from './gl-dye.js';
import {GlLightMap} from './gl-light-map.js';
import {GlMuscles} from './gl-muscles.js';
import {Layer} from './gl-layer.js';
import {GlTank} from './gl-tank.js';
import {GlTrace} from './gl-trace.js';
import {GlWake} from './gl-wake.js';
import {GlWater} from './gl-water.js';
import {Refined} from './gl-refined.js';
import {bodiesReach, solids} from './scene.js';

THREE.ColorManagement.enabled = false;

/** Screens with more pixels per length get no finer picture than this. */
const MAX_PIXEL_RATIO = 2;

/** With a smaller share of the pixels than this the surface of the water is simpler, too. */
const PLAIN_SHARE = 0.65;

/** Half the width of an arrow of force, in lengths of the body. */
const ARROW_WIDTH = 0.008;

/** Samples of a picture that rests. */
const SAMPLES = 16;

/** The direction to the lamp of bodies; what water mirrors lies opposite, where glints are seen. */
const LAMP = new THREE.Vector3(-0.3, 0.85, 0.5).normalize();

/** One canvas. The same methods as `PlainPicture`. */
export class GlPicture {
  #renderer;
  #fence;
  #world = new THREE.Scene();
  #water;
  #body = new GlBody();
  #muscles = new GlMuscles();
  #tank = new GlTank();
  #trace;
  #wake;
  #dye;
  #forces;
  #arrows = new GlArrows(1, true);
  #background = new THREE.Color();
  #behind = new Layer();
  #bare = new Layer();
  #light = {
    deep: new THREE.Color(), zenith: new THREE.Color(), horizon: new THREE.Color(),
    lamp: new THREE.Vector3(-0.45, 0.8, -0.4).normalize(),
    centre: new THREE.Vector3(),
  };
  #look = null;
  #last = () => {};
  #refined = null;
  /** @type {Scene|null} */
  #scene = null;
  #solids = [];
  #map;

  /** What draws, for people. */
  name = 'WebGL';

  /** @throws if the canvas has no context for WebGL */
  constructor(canvas, {trace, field, wake, dye, forces, pressure}) {
    this.#renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: false, powerPreference: 'high-performance'});
    this.#renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.#renderer.autoClear = false;
    this.#fence = new Fence(this.#renderer.getContext());
    this.#water = new GlWater(field);
    this.#map = new GlLightMap(LAMP);
    this.#tank.light = this.#map.texture;
    this.#body.lamp = LAMP;
    this.#trace = new GlTrace(trace);
    this.#wake = new GlWake(wake);
    this.#dye = new GlDye(dye);
    this.#forces = forces;
    this.#body.pressure = pressure;
    this.#arrows.object.renderOrder = 21;
    this.#world.add(this.#tank.object, this.#body.object, this.#muscles.object, this.#trace.object, this.#water.object,
        this.#wake.object, this.#dye.object, this.#arrows.object);
  }

  setScene(scene) {
    this.#scene = scene;
    this.#solids = solids(scene);
    this.#water.setScene(scene);
    this.#body.setScene(scene);
    this.#muscles.setScene(scene);
  }

  setBounds(bounds) {
    this.#tank.setBounds(bounds);
    this.#water.setBounds(bounds);
    this.#map.setBounds(bounds, this.#scene.fluidRestDistance);
    this.#tank.light = this.#map.texture;
    this.#light.centre.fromArray(bounds.min.map((low, axis) => (low + bounds.max[axis]) / 2));
  }

  setLook(look) {
    this.#look = look;
    this.#muscles.object.visible = look.muscles && look.body !== 'skin';
    this.#body.setLook(look);
    this.#trace.object.visible = look.trace;
    this.#trace.isFaint = look.body === 'skin';
  }

  setTheme(colours) {
    this.#background.setStyle(colours.background);
    for (const name of ['deep', 'zenith', 'horizon']) {
      this.#light[name].setStyle(colours[name]);
    }
    this.#tank.setColours(colours);
    this.#trace.setInk(colours.ink);
    this.#dye.setColour(colours.dye);
    this.#wake.setInk(colours.ink);
    this.#arrows.setColour(colours.dye);
  }

  /** The size in CSS pixels, the share of the screen's pixels along each side, and the angle of view in degrees. */
  setSize(width, height, share, angle) {
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, MAX_PIXEL_RATIO) * share);
    this.#renderer.setSize(width, height, false);
    this.#water.isPlain = share < PLAIN_SHARE;
    const {width: columns, height: rows} = this.#renderer.domElement;
    const pixels = rows / 2 / Math.tan(angle * Math.PI / 360);
    this.#water.setPixels(pixels, columns, rows);
    this.#body.setPixels(pixels);
  }

  /** How often a picture that rests is drawn again by `refine`. */
  get samples() {
    return SAMPLES;
  }

  /** Whether the card still draws. */
  get isBusy() {
    return this.#fence.isBusy;
  }

  /**
   * Draws a frame; water nearer than `from` is left out.
   *
   * @param {Frame} frame
   */
  draw(frame, camera, from) {
    this.#last = () => this.#render(frame, camera, from, null);
    this.show();
  }

  /**
   * Draws another sample of a picture that rests, moved by less than a pixel, and shows the mean of those so far.
   *
   * @param {Frame} frame
   */
  refine(frame, camera, from, sample) {
    const {width, height} = this.#renderer.domElement;
    this.#refined ??= new Refined();
    camera.setViewOffset(width, height, ...this.#refined.shift(sample), width, height);
    this.#render(frame, camera, from, this.#refined.target(width, height));
    camera.clearViewOffset();
    this.#refined.add(this.#renderer, sample);
    this.#last = () => this.#refined.show(this.#renderer);
    this.show();
  }

  /** Makes the canvas hold what was drawn last, until the browser shows it. */
  show() {
    this.#last();
    this.#fence.set();
  }

  #render(frame, camera, from, to) {
    this.#body.update(frame);
    this.#muscles.update(frame);
    this.#trace.update();
    this.#wake.update(this.#look.opacity);
    this.#dye.update(frame.time);
    this.#arrows.show(this.#forces.arrows, ARROW_WIDTH * bodiesReach(this.#scene, 2));
    this.#water.update(frame, camera, this.#look, from);
    const isSurface = this.#water.isSurface(this.#look);
    this.#map.update(isSurface ? this.#water.shapes : null, this.#solids, frame.position);
    if (isSurface) {
      const {width, height} = this.#renderer.domElement;
      this.#body.object.visible = false;
      this.#draw(camera, this.#bare.of(width, height));
      this.#body.object.visible = true;
      this.#tank.areEdgesDeep = false;
      this.#draw(camera, this.#behind.of(width, height));
      this.#tank.areEdgesDeep = true;
      this.#water.drawSurface(this.#renderer, camera, to, this.#behind.target, this.#bare.target, this.#look, this.#light);
    } else {
      this.#draw(camera, to);
    }
  }

  #draw(camera, to) {
    this.#renderer.setRenderTarget(to);
    this.#renderer.setClearColor(this.#background, 1);
    this.#renderer.clear();
    this.#renderer.render(this.#world, camera);
  }

  dispose() {
    this.#behind.dispose();
    this.#bare.dispose();
    this.#refined?.dispose();
    this.#water.dispose();
    this.#body.dispose();
    this.#wake.dispose();
    this.#dye.dispose();
    this.#arrows.dispose();
    this.#map.dispose();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss();
  }
}
