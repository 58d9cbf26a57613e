/** Passes over the whole screen: a fragment shader that reads textures and writes a target. */

import * as THREE from 'three';
import {FullScreenQuad} from 'three/addons/postprocessing/Pass.js';
import {shader} from './gl-shader.js';

const VERTEX = `
  out vec2 place;
  void main() {
    place = uv;
    gl_Position = vec4(position.xy, 0.0, 1.0);
  }`;

const quad = new FullScreenQuad();

/** One fragment shader with `in vec2 place`, 0 to 1 over the target; `uniforms` are its own, by name. */
export class Pass {
  #material;

  /**
   * @param {string} fragmentShader
   * @param {object} values of its uniforms, by name
   * @param {THREE.Blending} blending none unless given
   */
  constructor(fragmentShader, values, blending = THREE.NoBlending) {
    this.#material = shader(VERTEX, `\nin vec2 place;\n${fragmentShader}`, values,
        {blending, transparent: blending !== THREE.NoBlending, depthTest: false, depthWrite: false});
  }

  get uniforms() {
    return this.#material.uniforms;
  }

  /** Writes all of a target, or of the canvas if that is null. */
  draw(renderer, to) {
    quad.material = this.#material;
    renderer.setRenderTarget(to);
    quad.render(renderer);
  }

  /** Filters `first` across and then down, by way of `second`; a step is so many texels. For uniforms `source` and `along`. */
  filter(renderer, first, second, stride) {
    const {source, along} = this.uniforms;
    source.value = first.texture;
    along.value.set(stride / first.width, 0);
    this.draw(renderer, second);
    source.value = second.texture;
    along.value.set(0, stride / first.height);
    this.draw(renderer, first);
  }

  dispose() {
    this.#material.dispose();
  }
}

/** A target without a depth buffer unless `options` say so; nearest texels. */
export function target(width, height, options) {
  return new THREE.WebGLRenderTarget(Math.max(1, width), Math.max(1, height), {
    minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, depthBuffer: false, generateMipmaps: false, ...options,
  });
}
