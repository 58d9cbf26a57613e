/** Pipelines of WebGPU for materials of three.js. */

import * as THREE from 'three';
import {vertexLayout} from './gpu-buffers.js';
import {DEPTH} from './gpu-textures.js';
import {UniformLayout} from './gpu-uniforms.js';
import {toWgsl} from './gpu-wgsl.js';

const ADDED = {srcFactor: 'one', dstFactor: 'one', operation: 'add'};
const MIXED = {
  color: {srcFactor: 'src-alpha', dstFactor: 'one-minus-src-alpha', operation: 'add'},
  alpha: {srcFactor: 'one', dstFactor: 'one-minus-src-alpha', operation: 'add'},
};

function blendOf(material) {
  if (material.blending === THREE.CustomBlending) {
    return {color: ADDED, alpha: ADDED};
  }
  return material.blending === THREE.NormalBlending && material.transparent ? MIXED : undefined;
}

function topologyOf(object) {
  if (object.isPoints) {
    return 'triangle-strip';
  }
  return object.isLineSegments ? 'line-list' : object.isLine ? 'line-strip' : 'triangle-list';
}

/** Makes each when it is first needed and keeps it. */
export class GpuPipelines {
  #device;
  #programs = new Map();
  #pipelines = new Map();

  constructor(device) {
    this.#device = device;
  }

  /** The shaders of a material, for what `object` is: their modules, and what they read; see `toWgsl`. */
  program(material, object) {
    const key = `${object.isPoints === true}${material.vertexShader}${material.fragmentShader}`;
    let program = this.#programs.get(key);
    if (program === undefined) {
      const made = toWgsl(material.vertexShader, material.fragmentShader, object.isPoints === true);
      program = {
        ...made, number: this.#programs.size, layout: new UniformLayout(made.uniforms),
        vertexModule: this.#device.createShaderModule({code: made.vertex}),
        fragmentModule: this.#device.createShaderModule({code: made.fragment}),
      };
      this.#programs.set(key, program);
    }
    return program;
  }

  /**
   * {pipeline, bindLayout} for drawing an object.
   *
   * @param {object} program see `program`
   * @param {object[]} textures that it reads; see `GpuTextures.of`
   * @param {object} to format of its colour, samples, hasDepth
   */
  of(program, material, object, textures, to) {
    const buffers = vertexLayout(object.geometry, program.attributes, object.isPoints);
    const {depthTest, depthWrite, side, polygonOffset, polygonOffsetUnits, polygonOffsetFactor} = material;
    const topology = topologyOf(object);
    const blend = blendOf(material);
    const filters = textures.map(({isFilterable}) => isFilterable);
    const stripIndex = topology.endsWith('strip') && object.geometry.index !== null
        ? object.geometry.index.array.BYTES_PER_ELEMENT === 2 ? 'uint16' : 'uint32' : undefined;
    const key = JSON.stringify([program.number, buffers, depthTest, depthWrite, side, polygonOffset, topology, blend, filters,
      stripIndex, to.format, to.samples, to.hasDepth]);
    let made = this.#pipelines.get(key);
    if (made === undefined) {
      const bindLayout = this.#bindLayout(filters);
      const pipeline = this.#device.createRenderPipeline({
        layout: this.#device.createPipelineLayout({bindGroupLayouts: [bindLayout]}),
        vertex: {module: program.vertexModule, buffers},
        fragment: {module: program.fragmentModule, targets: [{format: to.format, blend}]},
        // Rows are turned round (see `toWgsl`), and so are triangles.
        primitive: {topology, stripIndexFormat: stripIndex, frontFace: 'cw',
          cullMode: side === THREE.DoubleSide || !topology.startsWith('triangle') || object.isPoints ? 'none' : 'back'},
        depthStencil: to.hasDepth ? {
          format: DEPTH, depthWriteEnabled: depthWrite && depthTest, depthCompare: depthTest ? 'less-equal' : 'always',
          depthBias: polygonOffset ? polygonOffsetUnits : 0, depthBiasSlopeScale: polygonOffset ? polygonOffsetFactor : 0,
        } : undefined,
        multisample: {count: to.samples},
      });
      made = {pipeline, bindLayout};
      this.#pipelines.set(key, made);
    }
    return made;
  }

  #bindLayout(filters) {
    const visibility = GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT;
    return this.#device.createBindGroupLayout({
      entries: [
        {binding: 0, visibility, buffer: {hasDynamicOffset: true}},
        ...filters.flatMap((isFilterable, i) => [
          {binding: 1 + 2 * i, visibility, texture: {sampleType: isFilterable ? 'float' : 'unfilterable-float'}},
          {binding: 2 + 2 * i, visibility, sampler: {type: isFilterable ? 'filtering' : 'non-filtering'}},
        ]),
      ],
    });
  }
}
