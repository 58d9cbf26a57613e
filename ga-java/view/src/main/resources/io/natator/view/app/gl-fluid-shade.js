/** What water looks like, from its depth: refraction, absorption, reflection and foam, laid over what is behind it. */

import * as THREE from 'three';
import {Pass} from './gl-pass.js';

/** The sky that is mirrored: lighter upwards, with a large soft lamp. */
export const SKY = `
  uniform vec3 zenith;
  uniform vec3 horizon;
  uniform vec3 lamp;
  vec3 skyOf(vec3 way) {
    vec3 colour = mix(horizon, zenith, smoothstep(-0.05, 0.75, way.y));
    float window = smoothstep(0.82, 0.97, dot(way, lamp));
    return colour + window * 0.55 * vec3(1.0, 0.98, 0.94);
  }`;

const FRAGMENT = `
  uniform sampler2D behind;
  uniform sampler2D behindDepth;
  uniform sampler2D bare;
  uniform sampler2D bareDepth;
  uniform sampler2D front;
  uniform sampler2D volume;
  uniform sampler2D scale;
  uniform vec2 step_;
  uniform vec2 tangent;
  uniform vec2 shift;
  uniform vec2 planes;
  uniform mat4 toWorld;
  uniform float density;
  uniform float spacing;
  uniform float tinted;
  uniform vec3 deep;
  uniform vec3 low;
  uniform vec3 high;
  const int STEPS = 20;
  out vec4 shown;
  ${SKY}
  float depthIn(sampler2D map, vec2 at) {
    float device = texture(map, at).r * 2.0 - 1.0;
    return 2.0 * planes.x * planes.y / (planes.y + planes.x - device * (planes.y - planes.x));
  }
  float depthOf(vec2 at) { return depthIn(behindDepth, at); }
  /** With the edges of the tank, which no ray is to stop at. */
  float edgeDepth(vec2 at) { return min(depthOf(at), depthIn(bareDepth, at)); }
  vec3 linear(vec3 colour) { return pow(max(colour, vec3(0.0)), vec3(2.2)); }
  vec3 screen(vec3 colour) { return pow(max(colour, vec3(0.0)), vec3(1.0 / 2.2)); }
  /** Slope of 1 / depth along a step; at an edge, and where a wall begins, that of one side. */
  float slope(vec2 along, vec2 here) {
    vec2 after = texture(front, place + along).rg;
    vec2 before = texture(front, place - along).rg;
    float up = after.r > 0.0 && after.g == here.g ? after.r - here.r : 1e3;
    float down = before.r > 0.0 && before.g == here.g ? here.r - before.r : 1e3;
    float best = abs(up) < abs(down) ? up : down;
    // Even where it is smooth, one-sided where an edge is near, and softly from one to the other.
    float rough = abs(up - down) / (0.25 * spacing * here.r * here.r);
    return abs(best) > 1e2 ? 0.0 : mix(0.5 * (up + down), best, clamp(rough, 0.0, 1.0));
  }
  float random(vec3 at) { return fract(sin(dot(at, vec3(12.9898, 78.233, 37.719))) * 43758.5453); }
  float noise(vec3 at) {
    vec3 cell = floor(at);
    vec3 share = smoothstep(vec3(0.0), vec3(1.0), at - cell);
    vec4 back = vec4(random(cell), random(cell + vec3(1, 0, 0)), random(cell + vec3(0, 1, 0)), random(cell + vec3(1, 1, 0)));
    cell.z += 1.0;
    vec4 front_ = vec4(random(cell), random(cell + vec3(1, 0, 0)), random(cell + vec3(0, 1, 0)), random(cell + vec3(1, 1, 0)));
    vec4 both = mix(back, front_, share.z);
    return mix(mix(both.x, both.y, share.x), mix(both.z, both.w, share.x), share.y);
  }
  vec2 seenAt(vec3 at) { return (at.xy / -at.z / tangent - shift) * 0.5 + 0.5; }
  float isBefore(float depth, float here) { return depth * here < 1.003 ? 1.0 : 0.0; }
  void main() {
    vec3 plain = texture(behind, place).rgb;
    vec2 water = texture(front, place).rg;
    float here = water.r;
    shown = vec4(plain, 1.0);
    if (here <= 0.0) { return; }
    // How much of the pixel is before the water: edges and thin lines have many depths and only one is known.
    float before = isBefore(edgeDepth(place), here) * 2.0 + isBefore(edgeDepth(place + vec2(step_.x, 0.0)), here)
        + isBefore(edgeDepth(place - vec2(step_.x, 0.0)), here) + isBefore(edgeDepth(place + vec2(0.0, step_.y)), here)
        + isBefore(edgeDepth(place - vec2(0.0, step_.y)), here);
    before = min(1.0, before / 5.0);
    if (before == 1.0) { return; }
    float depth = 1.0 / here;
    vec2 device = place * 2.0 - 1.0 + shift;
    vec2 grow = vec2(slope(vec2(step_.x, 0.0), water), slope(vec2(0.0, step_.y), water)) / (2.0 * step_);
    // A plane n p = d has 1 / depth linear in the place on the screen: its slopes are the normal.
    vec3 normal = normalize(vec3(-grow / tangent, here - dot(device, grow)));
    vec3 eye = vec3(device * tangent, -1.0) * depth;
    vec3 view = normalize(eye);
    if (dot(normal, view) > -0.02) { normal = normalize(normal - view * (dot(normal, view) + 0.02)); }
    vec4 splat = texture(volume, place);
    float thickness = splat.r;
    // Refraction: along the bent ray to what it hits, or to where it leaves the tank; spray ends with its own thickness.
    vec3 bent = refract(view, normal, 1.0 / 1.333);
    vec3 begin = (toWorld * vec4(eye, 1.0)).xyz;
    vec3 along = mat3(toWorld) * bent;
    vec3 exits = max((low - begin) / along, (high - begin) / along);
    float leave = max(0.0, min(exits.x, min(exits.y, exits.z)));
    float reach = leave < 1e3 ? mix(thickness, leave, smoothstep(1.0, 3.0, thickness / spacing)) : thickness;
    vec2 there = place;
    float path = reach;
    float stride = reach / float(STEPS);
    bool wasBefore = true;
    bool isHit = false;
    for (int i = 1; i <= STEPS; i++) {
      float far = stride * float(i);
      vec3 at = eye + bent * far;
      vec2 next = seenAt(at);
      if (at.z > -0.02 || next != clamp(next, vec2(0.0), vec2(1.0))) { break; }
      bool isBefore_ = -at.z <= depthOf(next);
      if (!isBefore_ && wasBefore) {
        // It went through something, or behind it: the first only if it comes close.
        float back = far - stride;
        for (int k = 0; k < 6; k++) {
          float middle = 0.5 * (back + far);
          vec3 half_ = eye + bent * middle;
          if (-half_.z > depthOf(seenAt(half_))) { far = middle; } else { back = middle; }
        }
        vec3 found = eye + bent * far;
        vec2 hit = seenAt(found);
        if (-found.z - depthOf(hit) < 0.2 * spacing + stride * 0.04) {
          there = hit;
          path = far;
          isHit = true;
          break;
        }
      }
      wasBefore = isBefore_;
    }
    // Else it sees the tank alone: what a body hides from here it may not hide from the bent ray.
    vec2 last = clamp(seenAt(eye + bent * reach), step_, 1.0 - step_);
    vec3 through = linear(isHit ? texture(behind, there).rgb : texture(bare, last).rgb);
    // Absorption by Beer and Lambert: red first; and what the water itself sends back.
    float tint = splat.a > 1e-4 ? splat.g / splat.a : 0.0;
    vec3 body = mix(linear(deep), linear(texture(scale, vec2(tint * 0.996 + 0.002, 0.5)).rgb), tinted);
    vec3 clear = exp(-density * path * mix(vec3(1.7, 0.6, 0.42), vec3(1.4), tinted * 0.75));
    vec3 world = normalize(mat3(toWorld) * normal);
    float lit = 0.62 + 0.38 * max(0.0, dot(world, lamp));
    vec3 colour = through * clear + body * lit * (1.0 - exp(-density * path * mix(0.9, 1.5, tinted)));
    // Fresnel by Schlick, and a mirrored sky.
    vec3 mirrored = reflect(view, normal);
    vec3 away = normalize(mat3(toWorld) * mirrored);
    float fresnel = 0.02 + 0.98 * pow(1.0 - clamp(-dot(view, normal), 0.0, 1.0), 5.0);
    vec3 sky = linear(skyOf(away));
    colour = mix(colour, sky, fresnel);
    colour += vec3(1.0, 0.97, 0.92) * 1.6 * pow(max(0.0, dot(away, lamp)), 420.0);
    // Foam: bubbles that cover more of the surface where there is more of it.
    vec3 there3 = (toWorld * vec4(eye, 1.0)).xyz / spacing;
    float bubbles = 0.55 * noise(there3 * 3.1) + 0.3 * noise(there3 * 7.3) + 0.15 * noise(there3 * 15.0);
    float foam = smoothstep(0.0, 0.3, clamp(splat.b, 0.0, 1.0) - bubbles * 0.9) * mix(0.9, 0.6, tinted);
    colour = mix(colour, vec3(0.86, 0.92, 0.95) * (0.55 + 0.45 * max(0.0, world.y)), foam);
    shown = vec4(mix(screen(colour), plain, before), 1.0);
  }`;

/** One pass over the picture. */
export class GlFluidShade {
  #pass;

  /** `scale` is the texture of the colour scale. */
  constructor(scale) {
    this.#pass = new Pass(FRAGMENT, {
      behind: null, behindDepth: null, bare: null, bareDepth: null, front: null, volume: null, scale, step_: new THREE.Vector2(),
      tangent: new THREE.Vector2(), shift: new THREE.Vector2(), planes: new THREE.Vector2(), toWorld: null, density: 1, spacing: 1, tinted: 0,
      low: new THREE.Vector3(), high: new THREE.Vector3(),
      deep: new THREE.Color(), zenith: new THREE.Color(), horizon: new THREE.Color(), lamp: new THREE.Vector3(),
    });
  }

  /**
   * Lays the water over the picture.
   *
   * @param {THREE.WebGLRenderTarget|null} target where to; null for the canvas
   * @param {THREE.WebGLRenderTarget} behind the picture without water, with its depth
   * @param {THREE.WebGLRenderTarget} bare the same without bodies, with the edges of the tank in its depth
   * @param {THREE.Texture} front 1 / depth of the water
   * @param {THREE.Texture} volume see `GlFluidVolume`
   * @param {{min: number[], max: number[]}} walls where the water ends
   * @param {object} water spacing, density (absorption per length), tinted (how much of the scale's colour, 0 to 1)
   * @param {object} light deep, zenith, horizon (colours), lamp (direction)
   */
  draw(renderer, camera, target, behind, bare, front, volume, walls, water, light) {
    const {uniforms} = this.#pass;
    uniforms.behind.value = behind.texture;
    uniforms.behindDepth.value = behind.depthTexture;
    uniforms.bare.value = bare.texture;
    uniforms.bareDepth.value = bare.depthTexture;
    uniforms.front.value = front;
    uniforms.volume.value = volume;
    uniforms.step_.value.set(1 / behind.width, 1 / behind.height);
    const projection = camera.projectionMatrix.elements;
    uniforms.tangent.value.set(1 / projection[0], 1 / projection[5]);
    uniforms.shift.value.set(projection[8], projection[9]);
    uniforms.planes.value.set(camera.near, camera.far);
    uniforms.toWorld.value = camera.matrixWorld;
    uniforms.low.value.fromArray(walls.min);
    uniforms.high.value.fromArray(walls.max);
    for (const [name, value] of Object.entries({...water, ...light})) {
      uniforms[name].value = value;
    }
    this.#pass.draw(renderer, target);
  }

  dispose() {
    this.#pass.dispose();
  }
}
