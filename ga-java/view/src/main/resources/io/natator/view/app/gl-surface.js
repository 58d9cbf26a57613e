/**
 * Water as a smooth surface, in the space of the screen: depth of the nearest spheres, smoothed without crossing edges,
 * normals from it, light, and the whole laid over the picture.
 */

import * as THREE from 'three';
import {SURFACE_RADIUS} from './scene.js';

/** Pixels of the surface for each of the picture. */
const SHARE = 0.5;
/** How often depth is smoothed. */
const ROUNDS = 2;
const DEPTH_VERTEX = `
  attribute float value;
  uniform float radius;
  uniform float pixelsPerUnit;
  varying float distance;
  varying float shade;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * eye;
    gl_PointSize = max(1.0, 2.0 * radius * pixelsPerUnit / -eye.z);
    distance = -eye.z;
    shade = value;
  }`;

const DEPTH_FRAGMENT = `
  uniform float radius;
  varying float distance;
  varying float shade;
  void main() {
    vec2 side = gl_PointCoord * 2.0 - 1.0;
    float square = dot(side, side);
    if (square > 1.0) discard;
    gl_FragColor = vec4(distance - radius * sqrt(1.0 - square), shade, 0.0, 1.0);
  }`;

const FULL_VERTEX = `
  varying vec2 place;
  void main() {
    place = uv;
    gl_Position = vec4(position.xy, 0.0, 1.0);
  }`;

/** A Gaussian along one direction, over neighbours that are about as deep. */
const SMOOTH_FRAGMENT = `
  uniform sampler2D source;
  uniform vec2 step;
  uniform float edge;
  varying vec2 place;
  void main() {
    vec4 centre = texture2D(source, place);
    if (centre.a < 0.5) { gl_FragColor = centre; return; }
    vec2 sum = centre.rg;
    float weights = 1.0;
    for (int i = 1; i <= 4; i++) {
      float near = exp(-float(i * i) / 9.0);
      for (int side = -1; side <= 1; side += 2) {
        vec4 other = texture2D(source, place + float(side * i) * step);
        float off = (other.r - centre.r) / edge;
        float weight = near * other.a * exp(-off * off);
        sum += weight * other.rg;
        weights += weight;
      }
    }
    gl_FragColor = vec4(sum / weights, 0.0, 1.0);
  }`;

const SHADE_FRAGMENT = `
  uniform sampler2D source;
  uniform sampler2D scale;
  uniform vec2 range;
  uniform vec2 step;
  uniform vec2 tangent;
  uniform float opacity;
  uniform float edge;
  uniform vec3 sky;
  varying vec2 place;
  vec3 eyeOf(vec2 at, float depth) {
    return vec3((at * 2.0 - 1.0) * tangent * depth, -depth);
  }
  vec3 slope(vec2 along, vec4 centre, vec3 here) {
    vec4 after = texture2D(source, place + along);
    vec4 before = texture2D(source, place - along);
    vec3 forward = eyeOf(place + along, after.r) - here;
    vec3 backward = here - eyeOf(place - along, before.r);
    bool useForward = after.a > 0.5 && (before.a < 0.5 || abs(forward.z) < abs(backward.z));
    vec3 best = useForward ? forward : backward;
    return max(after.a, before.a) < 0.5 || abs(best.z) > edge ? eyeOf(place + along, centre.r) - here : best;
  }
  void main() {
    vec4 centre = texture2D(source, place);
    if (centre.a < 0.5) discard;
    vec3 here = eyeOf(place, centre.r);
    vec3 across = slope(vec2(2.0 * step.x, 0.0), centre, here);
    vec3 upwards = slope(vec2(0.0, 2.0 * step.y), centre, here);
    vec3 normal = normalize(cross(across, upwards));
    vec3 view = normalize(-here);
    vec3 lamp = normalize(vec3(-0.35, 0.8, 0.5));
    vec3 colour = texture2D(scale, vec2((centre.g - range.x) / (range.y - range.x) * 0.996 + 0.002, 0.5)).rgb;
    float rim = pow(1.0 - max(dot(normal, view), 0.0), 3.0);
    float gloss = pow(max(dot(normal, normalize(lamp + view)), 0.0), 48.0);
    vec3 lit = colour * (0.66 + 0.4 * max(dot(normal, lamp), 0.0));
    gl_FragColor = vec4(mix(lit, sky, 0.45 * rim) + 0.24 * gloss, clamp(opacity + 0.35 * rim + 0.3 * gloss, 0.0, 1.0));
  }`;

/** Passes at half the size of the picture, and one over it. */
export class GlSurface {
  #scene = new THREE.Scene();
  #points = null;
  #depth;
  #smooth;
  #shade;
  #quadScene = new THREE.Scene();
  #quad;
  #camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
  #targets = null;
  #hidden = new THREE.Group();
  #clear = new THREE.Color(0);
  #width = 1;
  #height = 1;

  constructor(scale) {
    this.#depth = new THREE.ShaderMaterial({
      vertexShader: DEPTH_VERTEX, fragmentShader: DEPTH_FRAGMENT, blending: THREE.NoBlending,
      uniforms: {radius: {value: 1}, pixelsPerUnit: {value: 1}},
    });
    this.#smooth = fullScreen(SMOOTH_FRAGMENT, {source: null, step: new THREE.Vector2(), edge: 1}, THREE.NoBlending);
    this.#shade = fullScreen(SHADE_FRAGMENT, {
      source: null, scale, range: new THREE.Vector2(), step: new THREE.Vector2(), tangent: new THREE.Vector2(),
      opacity: 1, edge: 1, sky: new THREE.Color(),
    }, THREE.NormalBlending);
    this.#quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), this.#smooth);
    this.#quad.frustumCulled = false;
    this.#quadScene.add(this.#quad);
    this.#scene.add(this.#hidden);
  }

  /** Draws the points of this geometry from now on. */
  setScene(scene, geometry) {
    if (this.#points !== null) {
      this.#scene.remove(this.#points);
    }
    this.#points = new THREE.Points(geometry, this.#depth);
    this.#points.frustumCulled = false;
    this.#scene.add(this.#points);
    const radius = SURFACE_RADIUS * scene.fluidRestDistance;
    this.#depth.uniforms.radius.value = radius;
    this.#smooth.uniforms.edge.value = 1.5 * radius;
    this.#shade.uniforms.edge.value = 1.5 * radius;
  }

  /** The size of the picture in pixels; see `GlWater.setPixels`. */
  setSize(pixelsPerUnit, width, height) {
    this.#width = Math.max(1, Math.round(SHARE * width));
    this.#height = Math.max(1, Math.round(SHARE * height));
    this.#depth.uniforms.pixelsPerUnit.value = SHARE * pixelsPerUnit;
    this.#targets?.forEach(target => target.setSize(this.#width, this.#height));
  }

  /** Draws over the picture; what the body hides is left out. */
  draw(renderer, camera, range, opacity, bodyPoints, sky) {
    this.#targets ??= [this.#target(true), this.#target(false)];
    const [first, second] = this.#targets;
    const step = this.#smooth.uniforms.step.value;
    this.#drawDepth(renderer, camera, bodyPoints, first);
    for (let round = 0; round < ROUNDS; round++) {
      this.#pass(renderer, this.#smooth, first, second, step.set(1 / this.#width, 0));
      this.#pass(renderer, this.#smooth, second, first, step.set(0, 1 / this.#height));
    }
    const uniforms = this.#shade.uniforms;
    uniforms.range.value.fromArray(range);
    uniforms.step.value.set(1 / this.#width, 1 / this.#height);
    uniforms.tangent.value.set(1 / camera.projectionMatrix.elements[0], 1 / camera.projectionMatrix.elements[5]);
    uniforms.opacity.value = opacity;
    uniforms.sky.value.copy(sky);
    this.#pass(renderer, this.#shade, first, null);
  }

  #drawDepth(renderer, camera, bodyPoints, target) {
    const parent = bodyPoints.parent;
    bodyPoints.material.colorWrite = false;
    bodyPoints.material.uniforms.pixelsPerUnit.value *= SHARE;
    this.#hidden.add(bodyPoints);
    renderer.setRenderTarget(target);
    renderer.setClearColor(this.#clear, 0);
    renderer.clear();
    renderer.render(this.#scene, camera);
    bodyPoints.material.colorWrite = true;
    bodyPoints.material.uniforms.pixelsPerUnit.value /= SHARE;
    parent.add(bodyPoints);
  }

  #pass(renderer, material, source, target) {
    material.uniforms.source.value = source.texture;
    this.#quad.material = material;
    renderer.setRenderTarget(target);
    renderer.render(this.#quadScene, this.#camera);
  }

  #target(depthBuffer) {
    return new THREE.WebGLRenderTarget(this.#width, this.#height, {
      type: THREE.HalfFloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, depthBuffer,
    });
  }
}

function fullScreen(fragmentShader, values, blending) {
  const uniforms = Object.fromEntries(Object.entries(values).map(([name, value]) => [name, {value}]));
  return new THREE.ShaderMaterial({
    vertexShader: FULL_VERTEX, fragmentShader, uniforms, blending, transparent: blending === THREE.NormalBlending,
    depthTest: false, depthWrite: false,
  });
}
