/** Depth of the nearest water: each shape (water-shape.js) as an ellipsoid that rays are cast at, cut off at the walls. */

import * as THREE from 'three';
import {SHAPE_NUMBERS} from './water-shape.js';

const VERTEX = `
  in vec4 centre;
  in vec4 squares;
  in vec4 products;
  out vec3 ray;
  flat out vec3 middle;
  flat out vec3 first;
  flat out vec3 second;
  flat out vec3 third;
  void main() {
    mat3 turn = mat3(viewMatrix);
    mat3 shape = mat3(squares.x, products.x, products.y, products.x, squares.y, products.z, products.y, products.z, squares.z);
    shape = turn * shape * transpose(turn);
    middle = (viewMatrix * vec4(centre.xyz, 1.0)).xyz;
    vec3 half_ = sqrt(vec3(shape[0][0], shape[1][1], shape[2][2]));
    vec2 reach = 1.03 * (half_.xy + half_.z * abs(middle.xy / middle.z));
    mat3 inverted = inverse(shape);
    first = inverted[0];
    second = inverted[1];
    third = inverted[2];
    ray = vec3(middle.xy + position.xy * reach, middle.z);
    gl_Position = projectionMatrix * vec4(ray, 1.0);
    if (middle.z > -0.02) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }`;

const FRAGMENT = `
  precision highp float;
  uniform vec3 low;
  uniform vec3 high;
  uniform mat4 projectionMatrix;
  uniform float nearest;
  in vec3 ray;
  flat in vec3 middle;
  flat in vec3 first;
  flat in vec3 second;
  flat in vec3 third;
  layout(location = 0) out vec4 inverseDepth;
  void main() {
    mat3 inverted = mat3(first, second, third);
    vec3 turned = inverted * ray;
    float a = dot(ray, turned);
    float b = dot(middle, turned);
    float c = dot(middle, inverted * middle) - 1.0;
    float square = b * b - a * c;
    if (square < 0.0) discard;
    float root = sqrt(square);
    float enter = (b - root) / a;
    float leave = (b + root) / a;
    // The walls of the tank: water ends there, flat.
    vec3 along = transpose(mat3(viewMatrix)) * ray;
    vec3 one = (low - cameraPosition) / along;
    vec3 other = (high - cameraPosition) / along;
    vec3 before = min(one, other);
    vec3 after = max(one, other);
    float inside = max(max(before.x, before.y), max(before.z, nearest / -ray.z));
    float outside = min(after.x, min(after.y, after.z));
    enter = max(enter, inside);
    if (enter > min(leave, outside)) discard;
    float depth = enter * -ray.z;
    if (depth < 0.02) discard;
    vec2 clip = vec2(projectionMatrix[2][2] * -depth + projectionMatrix[3][2], depth);
    gl_FragDepth = 0.5 + 0.5 * clip.x / clip.y;
    inverseDepth = vec4(1.0 / depth, 0.0, 0.0, 1.0);
  }`;

/** One quad for each shape. */
export class GlFluidDepth {
  #world = new THREE.Scene();
  #mesh = null;
  #buffer = null;
  #capacity = 0;
  #clear = new THREE.Color(0);
  #material = new THREE.ShaderMaterial({
    vertexShader: VERTEX, fragmentShader: FRAGMENT, glslVersion: THREE.GLSL3, blending: THREE.NoBlending,
    uniforms: {low: {value: new THREE.Vector3()}, high: {value: new THREE.Vector3()}, nearest: {value: 0}},
  });

  /** Brings shapes (`WaterShapes`) to the GPU. */
  update(shapes) {
    if (shapes.count > this.#capacity) {
      this.#build(shapes.numbers.length / SHAPE_NUMBERS);
    }
    if (this.#mesh !== null) {
      this.#buffer.array.set(shapes.numbers.subarray(0, SHAPE_NUMBERS * shapes.count));
      this.#buffer.clearUpdateRanges();
      this.#buffer.addUpdateRange(0, SHAPE_NUMBERS * shapes.count);
      this.#buffer.needsUpdate = true;
      this.#mesh.geometry.instanceCount = shapes.count;
    }
  }

  /**
   * Writes 1 / depth of the nearest water into a target, 0 where there is none.
   *
   * @param {{min: number[], max: number[]}} walls beyond which no water is
   * @param {number} from depth before which none is
   */
  draw(renderer, camera, target, walls, from) {
    const {low, high, nearest} = this.#material.uniforms;
    low.value.fromArray(walls.min);
    high.value.fromArray(walls.max);
    nearest.value = Math.max(from, 0);
    renderer.setRenderTarget(target);
    renderer.setClearColor(this.#clear, 0);
    renderer.clear();
    if (this.#mesh !== null) {
      renderer.render(this.#world, camera);
    }
  }

  #build(capacity) {
    this.#capacity = capacity;
    if (this.#mesh !== null) {
      this.#mesh.geometry.dispose();
      this.#world.remove(this.#mesh);
    }
    this.#buffer = new THREE.InstancedInterleavedBuffer(new Float32Array(SHAPE_NUMBERS * capacity), SHAPE_NUMBERS)
        .setUsage(THREE.DynamicDrawUsage);
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute([-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0], 3));
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    ['centre', 'squares', 'products'].forEach((name, i) =>
      geometry.setAttribute(name, new THREE.InterleavedBufferAttribute(this.#buffer, 4, 4 * i)));
    this.#mesh = new THREE.Mesh(geometry, this.#material);
    this.#mesh.frustumCulled = false;
    this.#world.add(this.#mesh);
  }

  dispose() {
    this.#mesh?.geometry.dispose();
    this.#material.dispose();
  }
}
