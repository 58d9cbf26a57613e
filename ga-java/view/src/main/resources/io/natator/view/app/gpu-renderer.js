/** Draws scenes of three.js with WebGPU: those parts of three.js' `WebGLRenderer` that the picture uses. */

import * as THREE from 'three';
import {GpuBuffers} from './gpu-buffers.js';
import {GpuCopy} from './gpu-copy.js';
import {GpuPipelines} from './gpu-pipelines.js';
import {GpuTextures} from './gpu-textures.js';
import {UniformRing} from './gpu-uniforms.js';
import {target} from './gl-pass.js';

/** Samples of each pixel of the canvas, so that edges are smooth. */
const SAMPLES = 4;

/**
 * Knows materials of `shader` (gl-shader.js) on meshes, points and lines, drawn in their `renderOrder`, opaque ones first.
 * What is drawn is seen after `finish`.
 */
export class GpuRenderer {
  #device;
  #context;
  #ring;
  #buffers;
  #textures;
  #pipelines;
  #copy;
  #encoder = null;
  #pixelRatio = 1;
  #target = null;
  #colour = new THREE.Color(0);
  #alpha = 0;
  #isCleared = false;
  /** The canvas' picture, from below; and with several samples what is drawn after `clear`. */
  #screen = target(1, 1, {});
  #smooth = target(1, 1, {samples: SAMPLES, depthBuffer: true});
  #heard = new WeakSet();
  #modelView = new THREE.Matrix4();
  #normal = new THREE.Matrix3();
  #size = new THREE.Vector2();

  domElement;

  /** @throws if the canvas has no context for WebGPU */
  constructor(canvas, device) {
    this.domElement = canvas;
    this.#device = device;
    this.#context = canvas.getContext('webgpu');
    if (this.#context === null) {
      throw new Error('no canvas for WebGPU');
    }
    const format = navigator.gpu.getPreferredCanvasFormat();
    this.#context.configure({device, format, alphaMode: 'opaque'});
    this.#ring = new UniformRing(device);
    this.#buffers = new GpuBuffers(device, () => this.#flush());
    this.#textures = new GpuTextures(device, () => this.#flush());
    this.#pipelines = new GpuPipelines(device);
    this.#copy = new GpuCopy(device, format);
  }

  setPixelRatio(ratio) {
    this.#pixelRatio = ratio;
  }

  /** The size in CSS pixels. */
  setSize(width, height) {
    this.domElement.width = Math.max(1, Math.floor(width * this.#pixelRatio));
    this.domElement.height = Math.max(1, Math.floor(height * this.#pixelRatio));
    for (const one of [this.#screen, this.#smooth]) {
      one.setSize(this.domElement.width, this.domElement.height);
    }
  }

  /** What to draw into from now on; null for the canvas. */
  setRenderTarget(to) {
    this.#clearUnused();
    this.#target = to;
  }

  setClearColor(colour, alpha) {
    this.#colour.copy(colour);
    this.#alpha = alpha;
  }

  /** The next drawing begins with an empty target. */
  clear() {
    this.#isCleared = true;
  }

  render(world, camera) {
    world.updateMatrixWorld();
    camera.updateMatrixWorld();
    const objects = [];
    world.traverseVisible(object => object.material !== undefined && objects.push(object));
    objects.sort((one, other) => one.material.transparent - other.material.transparent || one.renderOrder - other.renderOrder);
    // Uploads first: they end what is recorded.
    const draws = objects.map(object => this.#prepare(object)).filter(draw => draw !== null);
    if (!this.#ring.hasRoom(draws.map(({program}) => program.layout))) {
      this.#flush();
    }
    this.#pass((pass, to) => draws.forEach(draw => this.#draw(pass, to, camera, draw)));
  }

  /** Makes the canvas show what was drawn. */
  finish() {
    this.#clearUnused();
    this.#copy.show(this.#commands(), this.#textures.target(this.#screen).colour, this.#context.getCurrentTexture().createView());
    this.#flush();
  }

  #commands() {
    this.#encoder ??= this.#device.createCommandEncoder();
    return this.#encoder;
  }

  #flush() {
    if (this.#encoder !== null) {
      this.#ring.send();
      this.#device.queue.submit([this.#encoder.finish()]);
      this.#encoder = null;
    }
  }

  #clearUnused() {
    if (this.#isCleared) {
      this.#pass(() => {});
    }
  }

  #pass(draw) {
    // What fills the canvas without `clear` before it needs neither samples nor depth.
    const into = this.#target ?? (this.#isCleared ? this.#smooth : this.#screen);
    const to = this.#textures.target(into);
    const colour = into === this.#smooth ? this.#textures.target(this.#screen).colour : to.colour;
    if (to.samples > 1 && !this.#isCleared) {
      throw new Error('what has several samples must be cleared before it is drawn');
    }
    const {r, g, b} = this.#colour;
    const loadOp = this.#isCleared ? 'clear' : 'load';
    const encoder = this.#commands();
    const pass = encoder.beginRenderPass({
      colorAttachments: [{
        view: to.many ?? colour, resolveTarget: to.many === null ? undefined : colour, loadOp,
        clearValue: [r, g, b, this.#alpha], storeOp: to.many === null ? 'store' : 'discard',
      }],
      depthStencilAttachment: to.depth === null ? undefined : {
        view: to.depth, depthLoadOp: loadOp, depthClearValue: 1,
        depthStoreOp: to.many === null || to.depthSeen !== null ? 'store' : 'discard',
      },
    });
    draw(pass, to);
    pass.end();
    if (to.depthSeen !== null) {
      this.#copy.firstDepth(encoder, to.depth, to.depthSeen);
    }
    this.#isCleared = false;
  }

  /** Brings what an object needs to the GPU; null if it draws nothing. */
  #prepare(object) {
    const {geometry, material} = object;
    const {index, drawRange} = geometry;
    const first = geometry.attributes.position;
    const all = (index ?? first)?.count ?? 0;
    const count = Math.min(all - drawRange.start, drawRange.count);
    const instances = geometry.isInstancedBufferGeometry ? geometry.instanceCount : 1;
    if (count <= 0 || instances <= 0) {
      return null;
    }
    if (!this.#heard.has(geometry)) {
      this.#heard.add(geometry);
      geometry.addEventListener('dispose', () => this.#buffers.dispose(geometry));
    }
    const program = this.#pipelines.program(material, object);
    return {
      object, material, program, count, instances,
      values: Object.fromEntries(Object.entries(material.uniforms).map(([name, {value}]) => [name, value])),
      textures: program.textures.map(name => this.#textures.of(material.uniforms[name].value)),
      buffers: program.attributes.map(({name}) => this.#buffers.of(geometry.attributes[name], GPUBufferUsage.VERTEX)),
      indices: index === null ? null : this.#buffers.of(index, GPUBufferUsage.INDEX),
    };
  }

  #draw(pass, to, camera, {object, material, program, count, instances, values, textures, buffers, indices}) {
    const {pipeline, bindLayout} = this.#pipelines.of(program, material, object, textures,
        {format: to.format, samples: to.samples, hasDepth: to.depth !== null});
    this.#modelView.multiplyMatrices(camera.matrixWorldInverse, object.matrixWorld);
    const known = {
      modelViewMatrix: this.#modelView, projectionMatrix: camera.projectionMatrix, viewMatrix: camera.matrixWorldInverse,
      normalMatrix: this.#normal.getNormalMatrix(this.#modelView), cameraPosition: camera.position,
      targetSize: this.#size.set(to.width, to.height),
    };
    const offset = this.#ring.add(program.layout, name => known[name] ?? values[name]);
    const bindings = textures.flatMap(({view, isFilterable, isLinear}) => [view, this.#textures.sampler(isFilterable && isLinear)]);
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, this.#device.createBindGroup({
      layout: bindLayout, entries: [
        {binding: 0, resource: {buffer: this.#ring.buffer, size: 4 * program.layout.size}},
        ...bindings.map((resource, i) => ({binding: i + 1, resource})),
      ],
    }), [offset]);
    buffers.forEach((buffer, i) => pass.setVertexBuffer(i, buffer));
    const {start} = object.geometry.drawRange;
    if (object.isPoints) {
      pass.draw(4, count, 0, start);
    } else if (indices === null) {
      pass.draw(count, instances, start);
    } else {
      pass.setIndexBuffer(indices, object.geometry.index.array.BYTES_PER_ELEMENT === 2 ? 'uint16' : 'uint32');
      pass.drawIndexed(count, instances, start);
    }
  }

  dispose() {
    [this.#screen, this.#smooth].forEach(one => one.dispose());
    this.#context.unconfigure();
  }
}
