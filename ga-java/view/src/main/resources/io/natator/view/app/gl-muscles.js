/** Muscles as ribbons, coloured by how far they are contracted or stretched. */

import * as THREE from 'three';
import {SCALES, scaleBytes} from './colours.js';
import {MUSCLE_WIDTH, bodySpacing, distinctMuscles, muscleChange} from './scene.js';
import {shader} from './gl-shader.js';
import {scaleTexture} from './gl-spheres.js';

const VERTEX = `
  in vec3 start;
  in vec3 end;
  in float change;
  uniform float width;
  uniform sampler2D scale;
  out vec3 colour;
  out float across;
  void main() {
    vec4 a = modelViewMatrix * vec4(start, 1.0);
    vec4 b = modelViewMatrix * vec4(end, 1.0);
    vec2 along = b.xy / -b.z - a.xy / -a.z;
    vec2 side = vec2(-along.y, along.x) / max(length(along), 1e-6);
    vec4 eye = mix(a, b, position.x);
    gl_Position = projectionMatrix * (eye + vec4(width * position.y * side, 0.0, 0.0));
    colour = texture(scale, vec2(0.5 + 0.498 * change, 0.5)).rgb;
    across = position.y;
  }`;

const FRAGMENT = `
  in vec3 colour;
  in float across;
  out vec4 shown;
  void main() {
    shown = vec4(colour * (1.0 - 0.35 * across * across), 1.0);
  }`;

/** One ribbon for each pair of particles that muscles join, seen through the body. */
export class GlMuscles {
  #muscles = [];
  #start;
  #end;
  #change;
  #mesh = null;
  #material = shader(VERTEX, FRAGMENT, {width: 1, scale: scaleTexture(scaleBytes(SCALES.diverging))},
      {side: THREE.DoubleSide, depthTest: false, depthWrite: false});

  /** What to add to a scene of three.js. */
  object = new THREE.Group();

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    this.#muscles = distinctMuscles(scene);
    this.#mesh?.geometry.dispose();
    this.object.clear();
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute([0, -1, 0, 1, -1, 0, 0, 1, 0, 1, 1, 0], 3));
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    this.#start = attribute(geometry, 'start', 3, this.#muscles.length);
    this.#end = attribute(geometry, 'end', 3, this.#muscles.length);
    this.#change = attribute(geometry, 'change', 1, this.#muscles.length);
    geometry.instanceCount = this.#muscles.length;
    this.#mesh = new THREE.Mesh(geometry, this.#material);
    this.#mesh.frustumCulled = false;
    this.#mesh.renderOrder = 5;
    this.object.add(this.#mesh);
    this.#material.uniforms.width.value = 0.5 * MUSCLE_WIDTH * bodySpacing(scene);
  }

  /**
   * Moves and colours the ribbons; a muscle at rest is grey.
   *
   * @param {Frame} frame
   */
  update(frame) {
    this.#muscles.forEach((muscle, i) => {
      for (let axis = 0; axis < 3; axis++) {
        this.#start.array[3 * i + axis] = frame.position[3 * muscle.a + axis];
        this.#end.array[3 * i + axis] = frame.position[3 * muscle.b + axis];
      }
      this.#change.array[i] = muscleChange(muscle, frame);
    });
    this.#start.needsUpdate = true;
    this.#end.needsUpdate = true;
    this.#change.needsUpdate = true;
  }
}

function attribute(geometry, name, size, count) {
  const made = new THREE.InstancedBufferAttribute(new Float32Array(size * count), size);
  made.setUsage(THREE.DynamicDrawUsage);
  geometry.setAttribute(name, made);
  return made;
}
