/** Depth of the nearest water, and its foam: each shape (water-shape.js) as an ellipsoid that rays are cast at, cut off at the walls. */

import * as THREE from 'three';
import {ADDING, shader} from './gl-shader.js';
import {SHAPE_NUMBERS} from './water-numbers.js';

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
    if (middle.z > -0.02) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); }
  }`;

const FRAGMENT = `
  uniform vec3 low;
  uniform vec3 high;
  uniform mat4 projectionMatrix;
  uniform float nearest;
  in vec3 ray;
  flat in vec3 middle;
  flat in vec3 first;
  flat in vec3 second;
  flat in vec3 third;
  out vec4 inverseDepth;
  void main() {
    mat3 inverted = mat3(first, second, third);
    vec3 turned = inverted * ray;
    float a = dot(ray, turned);
    float b = dot(middle, turned);
    float c = dot(middle, inverted * middle) - 1.0;
    float square = b * b - a * c;
    if (square < 0.0) { discard; }
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
    float isCut = enter < inside ? 1.0 : 0.0;
    enter = max(enter, inside);
    if (enter > min(leave, outside)) { discard; }
    float depth = enter * -ray.z;
    if (depth < 0.02) { discard; }
    vec2 clip = vec2(projectionMatrix[2][2] * -depth + projectionMatrix[3][2], depth);
    gl_FragDepth = 0.5 + 0.5 * clip.x / clip.y;
    inverseDepth = vec4(1.0 / depth, isCut, 0.0, 1.0);
  }`;

const FOAM_VERTEX = `
  in vec4 centre;
  in vec4 squares;
  uniform float radius;
  out vec2 side;
  out float foam;
  out float depth;
  void main() {
    vec4 eye = viewMatrix * vec4(centre.xyz, 1.0);
    depth = -eye.z;
    foam = squares.w;
    side = position.xy;
    gl_Position = foam > 0.0 ? projectionMatrix * (eye + vec4(radius * position.xy, 0.0, 0.0)) : vec4(2.0, 2.0, 2.0, 1.0);
  }`;

const FOAM_FRAGMENT = `
  uniform sampler2D front;
  uniform vec2 size;
  uniform float radius;
  in vec2 side;
  in float foam;
  in float depth;
  out vec4 added;
  void main() {
    float share = max(0.0, 1.0 - dot(side, side));
    float nearest = texture(front, gl_FragCoord.xy / size).r;
    if (nearest <= 0.0 || depth - 1.0 / nearest > 1.5 * radius) { discard; }
    added = vec4(0.0, 0.0, foam * share, 0.0);
  }`;

/** Radius of foam around a shape, in spacings. */
const FOAM_RADIUS = 0.9;

/** One quad for each shape. */
export class GlFluidDepth {
  #world = new THREE.Scene();
  #mesh = null;
  #buffer = null;
  #capacity = 0;
  #clear = new THREE.Color(0);
  #material = shader(VERTEX, FRAGMENT, {low: new THREE.Vector3(), high: new THREE.Vector3(), nearest: 0}, {blending: THREE.NoBlending});
  #foam = shader(FOAM_VERTEX, FOAM_FRAGMENT, {front: null, size: new THREE.Vector2(), radius: 1}, ADDING);

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
   * Writes 1 / depth of the nearest water into r of a target, 0 where there is none, and into g whether it is cut off there.
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

  /** Adds foam to b of a target whose pixels see the water at `front` (1 / depth). */
  drawFoam(renderer, camera, target, front, spacing) {
    if (this.#mesh === null) {
      return;
    }
    this.#foam.uniforms.front.value = front;
    this.#foam.uniforms.size.value.set(target.width, target.height);
    this.#foam.uniforms.radius.value = FOAM_RADIUS * spacing;
    this.#mesh.material = this.#foam;
    renderer.setRenderTarget(target);
    renderer.render(this.#world, camera);
    this.#mesh.material = this.#material;
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
    this.#foam.dispose();
  }
}
