/** Particles as shaded discs that look like spheres: one point each, no geometry. */

import * as THREE from 'three';
import {shader} from './gl-shader.js';

const VERTEX = `
  in float value;
  uniform float radius;
  uniform float pixelsPerUnit;
  uniform sampler2D scale;
  uniform vec2 range;
  out vec3 colour;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * eye;
    gl_PointSize = max(1.0, 2.0 * radius * pixelsPerUnit / -eye.z);
    colour = texture(scale, vec2((value - range.x) / (range.y - range.x) * 0.996 + 0.002, 0.5)).rgb;
  }`;

const FRAGMENT = `
  uniform float opacity;
  in vec3 colour;
  out vec4 shown;
  void main() {
    vec2 side = gl_PointCoord * 2.0 - 1.0;
    float square = dot(side, side);
    if (square > 1.0) { discard; }
    float light = 0.62 + 0.42 * sqrt(1.0 - square) - 0.16 * side.y - 0.08 * side.x;
    shown = vec4(colour * light, opacity);
  }`;

/** A texture of a colour scale, for `scale`. */
export function scaleTexture(bytes) {
  const texture = new THREE.DataTexture(bytes, bytes.length / 4, 1);
  texture.minFilter = THREE.LinearFilter;
  texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Four numbers per particle, place and value, that are sent to the GPU anew in each frame. */
export class PlaceBuffer {
  /** x, y, z, value of each. */
  numbers;
  #buffer;

  constructor(capacity) {
    this.numbers = new Float32Array(4 * capacity);
    this.#buffer = new THREE.InterleavedBuffer(this.numbers, 4).setUsage(THREE.DynamicDrawUsage);
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute('position', new THREE.InterleavedBufferAttribute(this.#buffer, 3, 0));
    this.geometry.setAttribute('value', new THREE.InterleavedBufferAttribute(this.#buffer, 1, 3));
    this.geometry.setDrawRange(0, 0);
  }

  /** Says that the first `count` have been written and are all there is. */
  written(count) {
    this.geometry.setDrawRange(0, count);
    this.#buffer.clearUpdateRanges();
    this.#buffer.addUpdateRange(0, 4 * count);
    this.#buffer.needsUpdate = true;
  }

  dispose() {
    this.geometry.dispose();
  }
}

/** Material of spheres; `uniforms.scale`, `range`, `radius`, `pixelsPerUnit` and `opacity` can be changed. */
export function sphereMaterial(scale, radius, opacity) {
  return shader(VERTEX, FRAGMENT, {scale, range: new THREE.Vector2(0, 1), radius, pixelsPerUnit: 1, opacity},
      {transparent: opacity < 1});
}
