/** Where the spine has been: its last positions, fading, and the path of the head. */

import * as THREE from 'three';
import {centreOf} from './scene.js';

/** Spines kept. */
const SPINES = 28;
/** Simulated time between two, s. */
const INTERVAL = 0.1;
const HEAD_PLACES = 240;
const HEAD_INTERVAL = 1 / 30;

/** Thin lines through the slices' centres. */
export class SpineTrace {
  #scene = null;
  #slices = 0;
  #spines;
  #ages;
  #head;
  #geometry = null;
  #headGeometry = null;
  #kept = 0;
  #next = 0;
  #lastTime = -Infinity;
  #headKept = 0;
  #headTime = -Infinity;
  #centre = [0, 0, 0];
  #material = new THREE.ShaderMaterial({
    vertexShader: `
      attribute float age;
      varying float alpha;
      void main() {
        alpha = age;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      uniform vec3 ink;
      varying float alpha;
      void main() { gl_FragColor = vec4(ink, alpha); }`,
    uniforms: {ink: {value: new THREE.Color()}},
    transparent: true, depthTest: false, depthWrite: false,
  });

  /** What to add to a scene of three.js. */
  object = new THREE.Group();

  /** Takes over what is known of a scene (SCEN). */
  setScene(scene) {
    const isSame = this.#scene !== null && this.#slices === scene.slices.length;
    this.#scene = scene;
    this.#slices = scene.slices.length;
    if (isSame && !scene.restarted) {
      return;
    }
    this.#geometry?.dispose();
    this.#headGeometry?.dispose();
    this.object.clear();
    this.#geometry = this.#lines(SPINES * this.#slices);
    this.#geometry.setIndex(this.#spineIndex());
    this.#spines = this.#geometry.getAttribute('position');
    this.#ages = this.#geometry.getAttribute('age');
    this.#headGeometry = this.#lines(HEAD_PLACES);
    this.#head = this.#headGeometry.getAttribute('position');
    this.#headGeometry.getAttribute('age').array.fill(0.9);
    this.object.add(this.#shown(new THREE.LineSegments(this.#geometry, this.#material)));
    this.object.add(this.#shown(new THREE.Line(this.#headGeometry, this.#material)));
    this.clear();
  }

  /** Forgets what was. */
  clear() {
    this.#kept = 0;
    this.#next = 0;
    this.#lastTime = -Infinity;
    this.#headKept = 0;
    this.#headTime = -Infinity;
    this.#headGeometry?.setDrawRange(0, 0);
    this.#ages?.array.fill(0);
    if (this.#ages) {
      this.#ages.needsUpdate = true;
    }
  }

  /** Adds the spine of a frame when it is time for it; a jump back in time begins anew. */
  update(frame) {
    if (this.#slices < 2) {
      return;
    }
    if (frame.time < this.#headTime - 1e-9) {
      this.clear();
    }
    if (frame.time >= this.#headTime + HEAD_INTERVAL - 1e-6) {
      this.#addHead(frame);
    }
    if (frame.time >= this.#lastTime + INTERVAL - 1e-6) {
      this.#addSpine(frame);
    }
  }

  /** The colour of the lines. */
  setInk(colour) {
    this.#material.uniforms.ink.value.copy(colour);
  }

  #addHead(frame) {
    this.#headTime = frame.time;
    if (this.#headKept === HEAD_PLACES) {
      this.#head.array.copyWithin(0, 3);
      this.#headKept--;
    }
    centreOf(this.#scene.slices[0], frame.position, this.#centre);
    this.#head.array.set(this.#centre, 3 * this.#headKept++);
    this.#head.needsUpdate = true;
    this.#headGeometry.setDrawRange(0, this.#headKept);
  }

  #addSpine(frame) {
    this.#lastTime = frame.time;
    const at = this.#next;
    this.#next = (at + 1) % SPINES;
    this.#kept = Math.min(this.#kept + 1, SPINES);
    for (let slice = 0; slice < this.#slices; slice++) {
      centreOf(this.#scene.slices[slice], frame.position, this.#centre);
      this.#spines.array.set(this.#centre, 3 * (at * this.#slices + slice));
    }
    for (let back = 0; back < this.#kept; back++) {
      const spine = (at - back + SPINES) % SPINES;
      const alpha = 0.75 * (1 - back / SPINES) ** 1.5;
      this.#ages.array.fill(alpha, spine * this.#slices, (spine + 1) * this.#slices);
    }
    this.#spines.needsUpdate = true;
    this.#ages.needsUpdate = true;
  }

  #lines(places) {
    const geometry = new THREE.BufferGeometry();
    for (const [name, size] of [['position', 3], ['age', 1]]) {
      const attribute = new THREE.BufferAttribute(new Float32Array(size * places), size);
      geometry.setAttribute(name, attribute.setUsage(THREE.DynamicDrawUsage));
    }
    return geometry;
  }

  #spineIndex() {
    const index = [];
    for (let spine = 0; spine < SPINES; spine++) {
      for (let slice = 0; slice + 1 < this.#slices; slice++) {
        index.push(spine * this.#slices + slice, spine * this.#slices + slice + 1);
      }
    }
    return index;
  }

  #shown(line) {
    line.frustumCulled = false;
    line.renderOrder = 20;
    return line;
  }
}
