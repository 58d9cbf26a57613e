/** Copies between textures that WebGPU does not do by itself. */

import {DEPTH} from './gpu-textures.js';

/** Covers the target with one triangle. */
const WHOLE = `
@vertex fn whole(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
  return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}`;

/** Rows of targets lie as in WebGL, from below; those of a canvas from above. */
const SHOW = `${WHOLE}
@group(0) @binding(0) var source: texture_2d<f32>;
@fragment fn show(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let size = textureDimensions(source);
  return vec4f(textureLoad(source, vec2u(u32(place.x), size.y - 1u - u32(place.y)), 0).rgb, 1.0);
}`;

const FIRST_DEPTH = `${WHOLE}
@group(0) @binding(0) var source: texture_depth_multisampled_2d;
@fragment fn first(@builtin(position) place: vec4f) -> @builtin(frag_depth) f32 {
  return textureLoad(source, vec2u(place.xy), 0);
}`;

/** A picture to the canvas; the depth of the first of several samples. */
export class GpuCopy {
  #device;
  #show;
  #first;

  constructor(device, canvasFormat) {
    this.#device = device;
    const module = device.createShaderModule({code: SHOW});
    this.#show = device.createRenderPipeline({layout: 'auto', vertex: {module}, fragment: {module, targets: [{format: canvasFormat}]}});
    const depth = device.createShaderModule({code: FIRST_DEPTH});
    this.#first = device.createRenderPipeline({
      layout: 'auto', vertex: {module: depth}, fragment: {module: depth, targets: []},
      depthStencil: {format: DEPTH, depthWriteEnabled: true, depthCompare: 'always'},
    });
  }

  /** Copies a picture of the same size to a view of the canvas. */
  show(encoder, source, canvas) {
    this.#draw(encoder, this.#show, source, {colorAttachments: [{view: canvas, loadOp: 'clear', storeOp: 'store'}]});
  }

  /** Copies the depth of each pixel's first sample. */
  firstDepth(encoder, source, to) {
    this.#draw(encoder, this.#first, source, {
      colorAttachments: [], depthStencilAttachment: {view: to, depthLoadOp: 'clear', depthClearValue: 1, depthStoreOp: 'store'},
    });
  }

  #draw(encoder, pipeline, source, pass) {
    const drawing = encoder.beginRenderPass(pass);
    drawing.setPipeline(pipeline);
    drawing.setBindGroup(0, this.#device.createBindGroup({
      layout: pipeline.getBindGroupLayout(0), entries: [{binding: 0, resource: source}],
    }));
    drawing.draw(3);
    drawing.end();
  }
}
