/** Smooths the depth of water across the screen. */

import * as THREE from 'three';
import {Pass} from './gl-pass.js';

/**
 * The narrow-range filter (Truong and Yuksel: A Narrow-Range Filter for Screen-Space Fluid Rendering, 2018) along one
 * direction: what is much nearer counts as little nearer, what is much farther not at all, nor what lies opposite to it,
 * so that a slope stays one; and the range widens as it is followed outwards. It works on 1 / depth, in which a plane seen
 * in perspective is straight, and walls so stay flat.
 */
const FRAGMENT = `
  uniform sampler2D source;
  uniform vec2 along;
  uniform float range;
  out vec4 smoothed;
  void main() {
    smoothed = texture(source, place);
    float here = smoothed.r;
    // What is cut off by a wall is flat, and its edge sharp.
    if (here <= 0.0 || smoothed.g > 0.0) { return; }
    float width = range * here * here;
    float low = here - width;
    float high = here + width;
    float sum = 0.375 * here;
    float weights = 0.375;
    float open = 1.0;
    for (int i = 1; i <= 2; i++) {
      vec2 offset = float(i) * along;
      vec2 first = texture(source, place + offset).rg;
      vec2 second = texture(source, place - offset).rg;
      float one = first.r;
      float other = second.r;
      float farther = min(one, other);
      open *= 1.0 - max(first.g, second.g);
      // Not all at once: a sharp end would be seen as a line.
      open *= smoothstep(-1.0, 0.0, (farther - low) / width);
      float weight = open * (i == 1 ? 0.25 : 0.0625);
      one = min(one, high);
      other = min(other, high);
      sum += weight * (one + other);
      weights += 2.0 * weight;
      low = min(low, farther - width);
      high = max(high, max(one, other) + width);
    }
    smoothed.r = sum / weights;
  }`;

/** Width of the filter, in spacings of particles; and the range of depth that is smoothed over, likewise. */
const WIDTH = 0.9;
const RANGE = 0.7;
const MOST_ROUNDS = 7;

/** Rounds of five texels along each side, farther apart in each (an "à trous" wavelet): as wide as they are cheap. */
export class GlFluidSmooth {
  #pass = new Pass(FRAGMENT, {source: null, along: new THREE.Vector2(), range: 1});

  /**
   * Smooths `first`, which holds the result then; `second` is of the same size.
   *
   * @param {number} spacing of particles, length
   * @param {number} pixels that a spacing has at a middle depth
   */
  draw(renderer, first, second, spacing, pixels) {
    const wanted = Math.max(1, WIDTH * pixels);
    // Variances add up: after n rounds the width is sqrt((4^n - 1) / 3).
    const rounds = Math.min(MOST_ROUNDS, Math.max(1, Math.round(Math.log2(3 * wanted * wanted + 1) / 2)));
    this.#pass.uniforms.range.value = RANGE * spacing;
    for (let round = -1; round < rounds; round++) {
      // Wide ones first; the narrow one is done again at the end, against what the gaps of the wide ones leave.
      const stride = round < 0 ? 1 : 2 ** (rounds - 1 - round);
      this.#pass.filter(renderer, first, second, stride);
    }
  }

  dispose() {
    this.#pass.dispose();
  }
}
