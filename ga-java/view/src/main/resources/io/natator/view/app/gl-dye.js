/** Dye as points, the older the fainter. */

import * as THREE from 'three';
import {GRAINS, dyeStrength} from './dye.js';

/** Pixels. */
const SIZE = 2.5;

/** Draws a `Dye`. */
export class GlDye {
  #dye;
  #version = -1;
  #colour = new THREE.Color();
  #geometry = new THREE.BufferGeometry();
  #tints = new THREE.BufferAttribute(new Float32Array(4 * GRAINS), 4).setUsage(THREE.DynamicDrawUsage);
  #places;

  /** What to add to a scene of three.js. */
  object = new THREE.Points(this.#geometry,
      new THREE.PointsMaterial({size: SIZE, sizeAttenuation: false, vertexColors: true, transparent: true, depthWrite: false}));

  constructor(dye) {
    this.#dye = dye;
    this.#places = new THREE.BufferAttribute(dye.places, 3).setUsage(THREE.DynamicDrawUsage);
    this.#geometry.setAttribute('position', this.#places).setAttribute('color', this.#tints);
    this.object.frustumCulled = false;
    this.object.renderOrder = 15;
  }

  /** Brings what changed to the GPU; `time` is that of the frame, s. */
  update(time) {
    const {version, count, born} = this.#dye;
    if (version === this.#version) {
      return;
    }
    this.#version = version;
    const {r, g, b} = this.#colour;
    for (let i = 0; i < count; i++) {
      this.#tints.array.set([r, g, b, dyeStrength(time - born[i])], 4 * i);
    }
    this.#places.needsUpdate = true;
    this.#tints.needsUpdate = true;
    this.#geometry.setDrawRange(0, count);
  }

  /** The colour of the dye, as CSS. */
  setColour(colour) {
    this.#colour.setStyle(colour);
    this.#version = -1;
  }

  dispose() {
    this.#geometry.dispose();
    this.object.material.dispose();
  }
}
