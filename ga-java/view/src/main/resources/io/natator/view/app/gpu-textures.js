/** Textures and targets of three.js in WebGPU. */

import * as THREE from 'three';

const COLOURS = 'rgba8unorm';
export const DEPTH = 'depth32float';

function formatOf(texture) {
  return texture.type === THREE.HalfFloatType ? 'rgba16float' : texture.type === THREE.FloatType ? 'rg32float' : COLOURS;
}

/** Makes what is asked for when it is asked for, anew where its size has changed. */
export class GpuTextures {
  #device;
  #targets = new WeakMap();
  #known = new WeakMap();
  #samplers = {};
  #empty;
  #beforeWriting;

  /** `beforeWriting()` is called before what draws may still read is overwritten. */
  constructor(device, beforeWriting) {
    this.#device = device;
    this.#beforeWriting = beforeWriting;
    this.#empty = this.#entry(this.#make(1, 1, COLOURS, GPUTextureUsage.TEXTURE_BINDING), true, false);
    for (const filter of ['nearest', 'linear']) {
      this.#samplers[filter] = device.createSampler({minFilter: filter, magFilter: filter});
    }
  }

  #make(width, height, format, usage, sampleCount = 1) {
    return this.#device.createTexture({size: [width, height], format, usage, sampleCount});
  }

  #entry(texture, isFilterable, isLinear) {
    return {texture, view: texture.createView(), isFilterable, isLinear, version: -1};
  }

  /** {view, isFilterable, isLinear} of a texture; an empty one for null and for targets that nothing was drawn into. */
  of(texture) {
    if (texture === null) {
      return this.#empty;
    }
    return texture.isDataTexture ? this.#data(texture) : this.#known.get(texture) ?? this.#empty;
  }

  #data(texture) {
    const {data, width, height} = texture.image;
    let known = this.#known.get(texture);
    if (known === undefined) {
      const made = this.#make(width, height, COLOURS, GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST);
      known = this.#entry(made, true, texture.minFilter === THREE.LinearFilter);
      this.#known.set(texture, known);
      texture.addEventListener('dispose', () => {
        made.destroy();
        this.#known.delete(texture);
      });
    }
    if (known.version !== texture.version) {
      known.version = texture.version;
      this.#beforeWriting();
      this.#device.queue.writeTexture({texture: known.texture}, data, {bytesPerRow: 4 * width}, [width, height]);
    }
    return known;
  }

  sampler(isLinear) {
    return this.#samplers[isLinear ? 'linear' : 'nearest'];
  }

  /**
   * What to draw into.
   *
   * @param {object} target of three.js: width, height, samples, texture, depthBuffer, depthTexture
   * @returns {{format: string, samples: number, colour: GPUTextureView, many: GPUTextureView|null, depth: GPUTextureView|null,
   *     depthSeen: GPUTextureView|null}} `many` has several samples of each pixel, of which `colour` is to become the mean;
   *     `depthSeen` is to become the depth of their first
   */
  target(target) {
    let known = this.#targets.get(target);
    if (known === undefined || known.width !== target.width || known.height !== target.height) {
      if (known === undefined) {
        target.addEventListener('dispose', () => this.#free(target));
      }
      this.#free(target);
      known = this.#build(target);
      this.#targets.set(target, known);
    }
    return known;
  }

  #build(target) {
    const {width, height, texture, depthTexture} = target;
    const {RENDER_ATTACHMENT, TEXTURE_BINDING} = GPUTextureUsage;
    const format = formatOf(texture);
    const samples = Math.max(1, target.samples);
    const all = [];
    const make = (...parts) => {
      all.push(this.#make(width, height, ...parts));
      return all.at(-1);
    };
    const colour = make(format, RENDER_ATTACHMENT | TEXTURE_BINDING);
    this.#known.set(texture, this.#entry(colour, format !== 'rg32float', texture.minFilter === THREE.LinearFilter));
    const many = samples === 1 ? null : make(format, RENDER_ATTACHMENT, samples);
    const depth = target.depthBuffer ? make(DEPTH, RENDER_ATTACHMENT | TEXTURE_BINDING, samples) : null;
    const seen = depthTexture === null ? null : samples === 1 ? depth : make(DEPTH, RENDER_ATTACHMENT | TEXTURE_BINDING);
    if (seen !== null) {
      this.#known.set(depthTexture, this.#entry(seen, false, false));
    }
    return {
      width, height, format, samples, all, colour: colour.createView(), many: many?.createView() ?? null,
      depth: depth?.createView() ?? null, depthSeen: seen === depth ? null : seen?.createView() ?? null,
    };
  }

  #free(target) {
    this.#targets.get(target)?.all.forEach(texture => texture.destroy());
    this.#targets.delete(target);
  }
}
