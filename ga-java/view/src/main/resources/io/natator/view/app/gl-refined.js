/** The mean of several samples of a picture, each moved by a part of a pixel: edges get smooth, and so does water. */

import * as THREE from 'three';
import {Pass, target} from './gl-pass.js';

const COPY = `
  uniform sampler2D source;
  uniform float share;
  out vec4 copied;
  void main() {
    copied = vec4(texture(source, place).rgb, share);
  }`;

/** Digits of `index` in a base, mirrored behind the point: evenly spread from 0 to 1 (Halton 1960). */
function mirrored(index, base) {
  let share = 0;
  for (let weight = 1 / base, rest = index; rest > 0; rest = Math.floor(rest / base), weight /= base) {
    share += weight * (rest % base);
  }
  return share;
}

/** Sums up in 16-bit floats, which the mean of 16 samples needs. */
export class Refined {
  #sample = target(1, 1, {samples: 0, depthBuffer: true});
  #mean = target(1, 1, {type: THREE.HalfFloatType});
  #add = new Pass(COPY, {source: null, share: 1}, THREE.NormalBlending);
  #copy = new Pass(COPY, {source: null, share: 1});

  /** By how much of a pixel a sample is moved: x, y. */
  shift(sample) {
    return [mirrored(sample + 1, 2) - 0.5, mirrored(sample + 1, 3) - 0.5];
  }

  /** What the next sample is to be drawn into. */
  target(width, height) {
    this.#sample.setSize(width, height);
    this.#mean.setSize(width, height);
    return this.#sample;
  }

  /** Takes it into the mean; sample 0 begins anew. */
  add(renderer, sample) {
    this.#add.uniforms.source.value = this.#sample.texture;
    this.#add.uniforms.share.value = 1 / (sample + 1);
    this.#add.draw(renderer, this.#mean);
  }

  /** Shows the mean on the canvas. */
  show(renderer) {
    this.#copy.uniforms.source.value = this.#mean.texture;
    this.#copy.draw(renderer, null);
  }

  dispose() {
    [this.#sample, this.#mean, this.#add, this.#copy].forEach(one => one.dispose());
  }
}
