/** Attributes and indices of three.js' geometries as buffers of WebGPU. */

/** Copies each array when it has changed. */
export class GpuBuffers {
  #device;
  #known = new WeakMap();
  #beforeWriting;

  /** `beforeWriting()` is called before what draws may still read is overwritten. */
  constructor(device, beforeWriting) {
    this.#device = device;
    this.#beforeWriting = beforeWriting;
  }

  /** The buffer of an attribute, or of what it is interleaved with. */
  of(attribute, usage) {
    const source = attribute.isInterleavedBufferAttribute ? attribute.data : attribute;
    const {array} = source;
    let known = this.#known.get(source);
    if (known === undefined) {
      const size = Math.max(4, 4 * Math.ceil(array.byteLength / 4));
      known = {buffer: this.#device.createBuffer({size, usage: usage | GPUBufferUsage.COPY_DST}), version: -1};
      this.#known.set(source, known);
    }
    if (known.version !== source.version) {
      this.#beforeWriting();
      this.#write(known, source);
      known.version = source.version;
    }
    return known.buffer;
  }

  #write(known, {array, updateRanges}) {
    const isPart = known.version >= 0 && updateRanges.length > 0;
    for (const {start, count} of isPart ? updateRanges : [{start: 0, count: array.length}]) {
      if (count > 0) {
        this.#device.queue.writeBuffer(known.buffer, 4 * start, array, start, count);
      }
    }
  }

  /** Frees what a geometry has. */
  dispose(geometry) {
    for (const attribute of [...Object.values(geometry.attributes), geometry.index]) {
      const source = attribute?.isInterleavedBufferAttribute ? attribute.data : attribute;
      this.#known.get(source)?.buffer.destroy();
      this.#known.delete(source);
    }
  }
}

/** How a geometry's attributes lie in their buffers; those of points belong to all corners of one. */
export function vertexLayout(geometry, attributes, isPoints) {
  return attributes.map(({name}, i) => {
    const attribute = geometry.attributes[name];
    const isShared = isPoints || attribute.isInstancedBufferAttribute || attribute.data?.isInstancedInterleavedBuffer === true;
    return {
      arrayStride: 4 * (attribute.data?.stride ?? attribute.itemSize), stepMode: isShared ? 'instance' : 'vertex',
      attributes: [{
        shaderLocation: i, offset: 4 * (attribute.offset ?? 0),
        format: attribute.itemSize === 1 ? 'float32' : `float32x${attribute.itemSize}`,
      }],
    };
  });
}
