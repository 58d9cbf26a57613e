/**
 * Water as a surface, in the space of the screen (van der Laan, Green and Sainz: Screen Space Fluid Rendering with Curvature
 * Flow, 2009): depth of the nearest water, smoothed; thickness; then light through it and from it.
 */

import * as THREE from 'three';
import {GlFluidDepth} from './gl-fluid-depth.js';
import {GlFluidShade} from './gl-fluid-shade.js';
import {GlFluidSmooth} from './gl-fluid-smooth.js';
import {GlFluidVolume} from './gl-fluid-volume.js';
import {target} from './gl-pass.js';
import {WaterShapes} from './water-shape.js';

/** Texels of thickness and colour for each of the picture, along each side. */
const VOLUME_SHARE = 0.25;
/** Absorption through the height and the depth of a tank together, at full opacity. */
const ABSORPTION = 4.2;
const ENDLESS = {min: [-1e9, -1e9, -1e9], max: [1e9, 1e9, 1e9]};

/** Passes at the size of the picture, and some at a quarter of it. */
export class GlSurface {
  /** @type {Scene|null} */
  #scene = null;
  #walls = ENDLESS;
  #depth = new GlFluidDepth();
  #smooth = new GlFluidSmooth();
  #volume = new GlFluidVolume();
  #shade;
  #targets = null;
  #density = 1;
  #pixelsPerUnit = 1;
  #width = 1;
  #height = 1;

  /** What it is made of. */
  shapes = new WaterShapes();

  /** `scale` is the texture of the colour scale. */
  constructor(scale) {
    this.#shade = new GlFluidShade(scale);
  }

  /**
   * Takes over what is known of a scene (SCEN); `geometry` holds places and values of the particles.
   *
   * @param {Scene} scene
   */
  setScene(scene, geometry) {
    this.#scene = scene;
    this.shapes.setScene(scene);
    this.#volume.setScene(scene, geometry);
  }

  /** The tank; see `tankBounds`. Water ends flat at its walls; it has no lid. */
  setBounds({min, max, walls}) {
    this.#density = ABSORPTION / Math.max(0.1, max[1] - min[1] + max[2] - min[2]);
    this.#walls = walls ? {min, max: [max[0], ENDLESS.max[1], max[2]]} : ENDLESS;
  }

  /** The size of the picture in pixels; see `GlWater.setPixels`. */
  setSize(pixelsPerUnit, width, height) {
    this.#pixelsPerUnit = pixelsPerUnit;
    this.#width = width;
    this.#height = height;
  }

  /** Whether it is made of balls. */
  set isPlain(value) {
    this.shapes.isPlain = value;
  }

  /**
   * Takes over the particles of a frame; see `WaterShapes.update`.
   *
   * @param {Frame} frame
   */
  update(frame, first, chosen, count, values) {
    this.shapes.update(frame.position, frame.velocities, first, chosen, count, values, this.#walls);
    this.#depth.update(this.shapes);
  }

  /**
   * Lays the water over a picture.
   *
   * @param {THREE.WebGLRenderTarget|null} to where to; null for the canvas
   * @param {THREE.WebGLRenderTarget} behind the picture without water, with its depth
   * @param {THREE.WebGLRenderTarget} bare see `GlFluidShade.draw`
   * @param {object} look opacity, colour
   * @param {number[]} range ends of the colour scale
   * @param {number} from depth before which no water is
   * @param {object} light see `GlFluidShade.draw`
   */
  draw(renderer, camera, to, behind, bare, look, range, from, light) {
    const [front, other, volume, blurred] = this.#fit();
    const spacing = this.#scene.fluidRestDistance;
    this.#depth.draw(renderer, camera, front, this.#walls, from);
    const middle = camera.position.distanceTo(light.centre);
    this.#smooth.draw(renderer, front, other, spacing, spacing * this.#pixelsPerUnit / middle);
    this.#volume.draw(renderer, camera, volume, blurred, front.texture, range,
        VOLUME_SHARE * this.#pixelsPerUnit);
    this.#depth.drawFoam(renderer, camera, volume, front.texture, spacing);
    const tinted = look.colour === 'none' ? 0 : 0.85;
    const {deep, zenith, horizon, lamp} = light;
    this.#shade.draw(renderer, camera, to, behind, bare, front.texture, volume.texture, this.#walls,
        {spacing, density: this.#density * look.opacity, tinted}, {deep, zenith, horizon, lamp});
  }

  /** Targets of the size of the picture. */
  #fit() {
    const width = Math.max(1, Math.round(VOLUME_SHARE * this.#width));
    const height = Math.max(1, Math.round(VOLUME_SHARE * this.#height));
    if (this.#targets === null) {
      const depth = {format: THREE.RGFormat, type: THREE.FloatType};
      const soft = {type: THREE.HalfFloatType, minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter};
      this.#targets = [target(1, 1, {...depth, depthBuffer: true}), target(1, 1, depth), target(1, 1, soft), target(1, 1, soft)];
    }
    this.#targets.forEach((one, i) => i < 2 ? one.setSize(this.#width, this.#height) : one.setSize(width, height));
    return this.#targets;
  }

  dispose() {
    this.#targets?.forEach(one => one.dispose());
    [this.#depth, this.#smooth, this.#volume, this.#shade].forEach(one => one.dispose());
  }
}
