/** The fluid: which particles are seen, nearest first, with the value that they are coloured by. */

import * as THREE from 'three';
import {SCALES, scaleBytes} from './colours.js';
import {WATER_RADIUS, isParticles} from './scene.js';
import {NearestFirst} from './sort.js';
import {PlaceBuffer, scaleTexture, sphereMaterial} from './gl-spheres.js';
import {GlSurface} from './gl-surface.js';

/**
 * Drawn nearest first with depth written, so of spheres behind each other only the first is seen: one layer, through
 * which the body shows.
 */
export class GlWater {
  /** @type {Scene|null} */
  #scene = null;
  #places = null;
  #points = null;
  #values = null;
  #order = new NearestFirst();
  #field;
  #scale = scaleTexture(scaleBytes(SCALES.sequential));
  #material = sphereMaterial(this.#scale, 1, 0.5);
  #surface = new GlSurface(this.#scale);
  #forward = new THREE.Vector3();
  #from = -Infinity;

  /** What to add to a scene of three.js. */
  object = new THREE.Group();

  /** `field` gives values and their scale; see `FieldValues`. */
  constructor(field) {
    this.#field = field;
  }

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    const count = scene.fluid[1];
    this.#scene = scene;
    this.#places?.dispose();
    this.object.clear();
    this.#places = new PlaceBuffer(count);
    this.#values = new Float32Array(count);
    this.#points = new THREE.Points(this.#places.geometry, this.#material);
    this.#points.frustumCulled = false;
    this.#points.renderOrder = 10;
    this.object.add(this.#points);
    this.#material.uniforms.radius.value = WATER_RADIUS * scene.fluidRestDistance;
    this.#surface.setScene(scene, this.#places.geometry);
  }

  /**
   * Brings places and values of a frame to the GPU.
   *
   * @param {object} look what is shown: water (spheres, surface or what is not drawn here), colour, opacity, cut
   * @param {number} from depth before which water is cut away
   */
  update(frame, camera, look, from) {
    const [first, count] = this.#scene.fluid;
    const isShown = isParticles(look.water) && count > 0;
    this.#points.visible = isShown && look.water === 'spheres';
    if (!isShown) {
      return;
    }
    this.#field.read(look.colour, this.#scene, frame, first, count, this.#values);
    this.#material.uniforms.range.value.fromArray(this.#field.range);
    camera.getWorldDirection(this.#forward);
    const seen = this.#order.sort(frame.position, first, count, camera.position, this.#forward, from);
    this.#write(frame.position, first, seen);
    if (look.water === 'surface') {
      this.#surface.update(frame, first, this.#order.order, seen, this.#values);
    }
    this.#from = from;
    this.#material.uniforms.opacity.value = look.opacity;
    this.#material.transparent = look.opacity < 1;
  }

  #write(position, first, seen) {
    const numbers = this.#places.numbers;
    const order = this.#order.order;
    for (let i = 0, out = 0; i < seen; i++, out += 4) {
      const from = 3 * (first + order[i]);
      numbers[out] = position[from];
      numbers[out + 1] = position[from + 1];
      numbers[out + 2] = position[from + 2];
      numbers[out + 3] = this.#values[order[i]];
    }
    this.#places.written(seen);
  }

  /** Whether water is shown as a surface, by `drawSurface`. */
  isSurface(look) {
    return look.water === 'surface' && this.#scene !== null && this.#scene.fluid[1] > 0;
  }

  /** Shapes of the surface (`WaterShapes`). */
  get shapes() {
    return this.#surface.shapes;
  }

  /** Lays the surface over a picture; see `GlSurface.draw`. */
  drawSurface(renderer, camera, to, behind, bare, look, light) {
    this.#surface.draw(renderer, camera, to, behind, bare, look, this.#field.range, this.#from, light);
  }

  /** The tank; see `tankBounds`. */
  setBounds(bounds) {
    this.#surface.setBounds(bounds);
  }

  /** The size of the picture: height in pixels over twice the tangent of half the view angle. */
  setPixels(pixelsPerUnit, width, height) {
    this.#material.uniforms.pixelsPerUnit.value = pixelsPerUnit;
    this.#surface.setSize(pixelsPerUnit, width, height);
  }

  /** Whether the surface is made of balls, which costs less than ellipsoids. */
  set isPlain(value) {
    this.#surface.isPlain = value;
  }

  dispose() {
    this.#places?.dispose();
    this.#surface.dispose();
  }
}
