/** Arrows as flat shapes that face the camera. */

import * as THREE from 'three';
import {HEAD} from './arrows.js';
import {shader} from './gl-shader.js';

/** Each corner: share of the way, half widths to the side, and whether it is at the neck. */
const VERTEX = `
  in vec3 start;
  in vec3 end;
  uniform float halfWidth;
  void main() {
    vec4 a = modelViewMatrix * vec4(start, 1.0);
    vec4 b = modelViewMatrix * vec4(end, 1.0);
    vec2 along = b.xy / -b.z - a.xy / -a.z;
    vec2 side = vec2(-along.y, along.x) / max(length(along), 1e-9);
    float head = min(${HEAD.length.toFixed(2)} * halfWidth / max(distance(a, b), 1e-9), ${HEAD.most.toFixed(2)});
    vec4 eye = mix(a, b, position.x - head * position.z);
    gl_Position = projectionMatrix * (eye + vec4(halfWidth * position.y * side, 0.0, 0.0));
  }`;

const FRAGMENT = `
  uniform vec3 ink;
  uniform float opacity;
  out vec4 shown;
  void main() { shown = vec4(ink, opacity); }`;

/** Any number of arrows of one width and colour. */
export class GlArrows {
  #material;
  #shown = null;

  /** What to add to a scene of three.js. */
  object;

  /** `isSeenThrough` whether they are seen through what is before them. */
  constructor(opacity, isSeenThrough) {
    this.#material = shader(VERTEX, FRAGMENT, {halfWidth: 1, ink: new THREE.Color(), opacity},
        {side: THREE.DoubleSide, transparent: true, depthTest: !isSeenThrough, depthWrite: false});
    this.object = new THREE.Mesh(new THREE.BufferGeometry(), this.#material);
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  /** Their colour, as CSS. */
  setColour(colour) {
    this.#material.uniforms.ink.value.setStyle(colour);
  }

  /**
   * Shows these, if they are others.
   *
   * @param {{from: Float32Array, to: Float32Array}} arrows three numbers each
   * @param {number} half of their width, length
   */
  show(arrows, half) {
    this.#material.uniforms.halfWidth.value = half;
    if (arrows === this.#shown) {
      return;
    }
    this.#shown = arrows;
    this.object.visible = arrows.from.length > 0;
    this.object.geometry.dispose();
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(
        [0, 1, 0, 0, -1, 0, 1, 1, 1, 1, -1, 1, 1, HEAD.half, 1, 1, -HEAD.half, 1, 1, 0, 0], 3));
    geometry.setIndex([0, 1, 2, 2, 1, 3, 4, 5, 6]);
    geometry.setAttribute('start', new THREE.InstancedBufferAttribute(arrows.from, 3));
    geometry.setAttribute('end', new THREE.InstancedBufferAttribute(arrows.to, 3));
    geometry.instanceCount = arrows.from.length / 3;
    this.object.geometry = geometry;
  }

  dispose() {
    this.object.geometry.dispose();
    this.#material.dispose();
  }
}
