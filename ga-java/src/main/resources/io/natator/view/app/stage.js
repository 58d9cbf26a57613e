/** A canvas that shows frames of one scene: tank, water, body, muscles, trace, seen by a camera. */

import * as THREE from 'three';
import {Body} from './body.js';
import {CameraRig} from './cameras.js';
import {Muscles} from './muscles.js';
import {Quality} from './quality.js';
import {centreOf, tankBounds} from './scene.js';
import {Tank} from './tank.js';
import {SpineTrace} from './trace.js';
import {Water} from './water.js';

THREE.ColorManagement.enabled = false;

/** Screens with more pixels per length get no finer picture than this. */
const MAX_PIXEL_RATIO = 2;

/** What can be switched: water spheres, surface or none; colour speed, density or mass. */
export const DEFAULT_LOOK = {
  water: 'spheres', colour: 'speed', opacity: 0.55, cut: false, muscles: true, trace: true, quality: 'auto',
};

/** Draws when there is something new, and nothing else. */
export class Stage {
  #renderer;
  #world = new THREE.Scene();
  #water = new Water();
  #body = new Body();
  #muscles = new Muscles();
  #trace = new SpineTrace();
  #tank = new Tank();
  #canvas;
  #scene = null;
  #frame = null;
  #bounds = null;
  #look = {...DEFAULT_LOOK};
  #quality = new Quality();
  #background = new THREE.Color();
  #sky = new THREE.Color();
  #forward = new THREE.Vector3();
  #centre = [0, 0, 0];
  #last = 0;
  #isNew = true;
  #share = 0;
  #width = 0;
  #height = 0;

  constructor(canvas) {
    this.#canvas = canvas;
    this.#renderer = new THREE.WebGLRenderer({canvas, antialias: false, alpha: false, powerPreference: 'high-performance'});
    this.#renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.#renderer.autoClear = false;
    this.rig = new CameraRig(canvas);
    this.#world.add(this.#tank.object, this.#body.object, this.#muscles.object, this.#trace.object, this.#water.object);
    this.#water.onRange = range => this.onRange(range);
    new ResizeObserver(() => this.#resized()).observe(canvas);
    this.#resized();
  }

  /** Called with the ends of the water's colour scale. */
  onRange = () => {};

  /** The share of the screen's pixels that are drawn, along each side. */
  get share() {
    return this.#share;
  }

  /** Takes over a scene (SCEN); the next frame is one of it. */
  setScene(scene) {
    const isOther = this.#scene === null || scene.restarted;
    this.#scene = scene;
    this.#water.setScene(scene);
    this.#body.setScene(scene);
    this.#muscles.setScene(scene);
    this.#trace.setScene(scene);
    this.#bounds = isOther ? null : this.#bounds;
    this.#frame = null;
  }

  /** Shows this frame from the next drawing on. */
  setFrame(frame) {
    this.#frame = frame;
    if (this.#bounds === null) {
      this.#bounds = tankBounds(this.#scene, frame.position);
      this.#tank.setBounds(this.#bounds);
      this.rig.setBounds(this.#bounds);
    }
    this.#trace.update(frame);
    this.#isNew = true;
  }

  /** What is shown; see `DEFAULT_LOOK`. */
  setLook(look) {
    this.#look = {...look};
    this.#muscles.object.visible = look.muscles;
    this.#trace.object.visible = look.trace;
    this.#isNew = true;
    this.#quality.rest();
    this.#resized();
  }

  /** Colours as CSS: background, floor, marks, edges, ink. */
  setTheme(colours) {
    this.#background.setStyle(colours.background);
    this.#sky.setStyle(colours.sky);
    this.#tank.setColours(colours.floor, colours.marks, colours.edges);
    this.#trace.setInk(new THREE.Color(colours.ink));
    this.#isNew = true;
  }

  /**
   * Draws if the frame, the camera or the look changed.
   *
   * @param {number} now milliseconds
   * @returns {boolean} whether it drew
   */
  draw(now) {
    const seconds = Math.min((now - this.#last) / 1000, 0.1);
    this.#last = now;
    if (this.#frame === null || this.#width === 0) {
      return false;
    }
    this.rig.setBody(this.#scene.body.length > 0
        ? centreOf(this.#scene.body, this.#frame.position, this.#centre) : null);
    this.rig.update(seconds, this.#width / this.#height);
    if (!this.#isNew && !this.rig.hasMoved) {
      this.#quality.rest();
      return false;
    }
    this.#isNew = false;
    this.rig.hasMoved = false;
    this.#render();
    if (this.#look.quality === 'auto' && this.#quality.drawn(now / 1000)) {
      this.#resized();
    }
    return true;
  }

  #render() {
    const camera = this.rig.camera;
    camera.updateMatrixWorld();
    camera.getWorldDirection(this.#forward);
    const from = this.#look.cut ? this.rig.depthOfBody(this.#forward) : -Infinity;
    this.#body.update(this.#frame);
    this.#muscles.update(this.#frame);
    this.#water.update(this.#frame, camera, this.#look, from);
    this.#renderer.setRenderTarget(null);
    this.#renderer.setClearColor(this.#background, 1);
    this.#renderer.clear();
    this.#renderer.render(this.#world, camera);
    this.#water.drawSurface(this.#renderer, camera, this.#look, this.#body.points, this.#sky);
  }

  #resized() {
    const width = this.#canvas.clientWidth;
    const height = this.#canvas.clientHeight;
    const share = this.#look.quality === 'auto' ? this.#quality.share : Number(this.#look.quality);
    if (width === 0 || height === 0) {
      this.#width = 0;
      return;
    }
    if (width === this.#width && height === this.#height && share === this.#share) {
      return;
    }
    this.#width = width;
    this.#height = height;
    this.#share = share;
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, MAX_PIXEL_RATIO) * share);
    this.#renderer.setSize(width, height, false);
    const pixels = this.#canvas.height / 2 / Math.tan(this.rig.camera.fov * Math.PI / 360);
    this.#water.setPixels(pixels, this.#canvas.width, this.#canvas.height);
    this.#body.setPixels(pixels);
    this.#isNew = true;
  }
}
