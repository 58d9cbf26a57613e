/** The spine's trace as thin lines. */

import * as THREE from 'three';
import {shader} from './gl-shader.js';
import {HEAD_PLACES, SPINES} from './trace.js';

/** Strength of faint lines. */
const FAINT = 0.4;

/** Draws a `SpineTrace`. */
export class GlTrace {
  #trace;
  #version = -1;
  #slices = -1;
  #spines = null;
  #head = null;
  #material = shader(`
      in float strength;
      out float alpha;
      void main() {
        alpha = strength;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`, `
      uniform vec3 ink;
      uniform float share;
      in float alpha;
      out vec4 shown;
      void main() { shown = vec4(ink, share * alpha); }`,
      {ink: new THREE.Color(), share: 1}, {transparent: true, depthTest: false, depthWrite: false});

  /** What to add to a scene of three.js. */
  object = new THREE.Group();

  constructor(trace) {
    this.#trace = trace;
  }

  /** Brings what changed to the GPU. */
  update() {
    const trace = this.#trace;
    if (trace.slices !== this.#slices) {
      this.#build();
    }
    if (trace.version === this.#version || trace.slices < 2) {
      return;
    }
    this.#version = trace.version;
    const places = this.#spines.getAttribute('position');
    const strength = this.#spines.getAttribute('strength');
    places.array.set(trace.spines);
    for (let spine = 0; spine < SPINES; spine++) {
      strength.array.fill(0.75 * trace.strength[spine] ** 1.5, spine * this.#slices, (spine + 1) * this.#slices);
    }
    const head = this.#head.getAttribute('position');
    head.array.set(trace.head);
    for (const attribute of [places, strength, head]) {
      attribute.needsUpdate = true;
    }
    this.#head.setDrawRange(0, trace.headPlaces);
  }

  /** Whether lines are faint and the body hides those behind it. */
  set isFaint(value) {
    this.#material.depthTest = value;
    this.#material.uniforms.share.value = value ? FAINT : 1;
  }

  /** The colour of the lines. */
  setInk(colour) {
    this.#material.uniforms.ink.value.setStyle(colour);
  }

  #build() {
    this.#slices = this.#trace.slices;
    this.#spines?.dispose();
    this.#head?.dispose();
    this.object.clear();
    this.#spines = linePlaces(SPINES * this.#slices);
    const index = [];
    for (let spine = 0; spine < SPINES; spine++) {
      for (let slice = 0; slice + 1 < this.#slices; slice++) {
        index.push(spine * this.#slices + slice, spine * this.#slices + slice + 1);
      }
    }
    this.#spines.setIndex(index);
    this.#head = linePlaces(HEAD_PLACES);
    this.#head.getAttribute('strength').array.fill(0.9);
    for (const line of [new THREE.LineSegments(this.#spines, this.#material), new THREE.Line(this.#head, this.#material)]) {
      line.frustumCulled = false;
      line.renderOrder = 20;
      this.object.add(line);
    }
  }
}

function linePlaces(count) {
  const geometry = new THREE.BufferGeometry();
  for (const [name, size] of Object.entries({position: 3, strength: 1})) {
    const attribute = new THREE.BufferAttribute(new Float32Array(size * count), size);
    geometry.setAttribute(name, attribute.setUsage(THREE.DynamicDrawUsage));
  }
  return geometry;
}
