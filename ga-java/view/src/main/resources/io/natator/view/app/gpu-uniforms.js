/** Uniforms of a draw as WebGPU wants them: a struct in a buffer. */

/** Alignment and size of each type in the uniform address space of WGSL, in floats. */
const LAYOUT = {float: [1, 1], vec2: [2, 2], vec3: [4, 3], vec4: [4, 4], mat3: [4, 12], mat4: [4, 16]};

/** Where the members of a struct are; `members` as {name, type}. */
export class UniformLayout {
  #members;

  /** Floats of the struct. */
  size;

  constructor(members) {
    let end = 0;
    this.#members = members.map(({name, type}) => {
      const [alignment, size] = LAYOUT[type];
      const at = Math.ceil(end / alignment) * alignment;
      end = at + size;
      return {name, type, at};
    });
    this.size = 4 * Math.ceil(end / 4);
  }

  /** Writes the values that `valueOf(name)` gives, numbers or objects of three.js, into floats from `begin` on. */
  write(floats, begin, valueOf) {
    for (const {name, type, at} of this.#members) {
      const value = valueOf(name);
      if (type === 'float') {
        floats[begin + at] = value;
      } else if (type === 'mat3') {
        value.elements.forEach((element, i) => {
          floats[begin + at + i + Math.floor(i / 3)] = element;
        });
      } else {
        floats.set(value.elements ?? value.toArray(), begin + at);
      }
    }
  }
}

/** What bind offsets are multiples of, in bytes. */
const STEP = 256;
const BYTES = 1 << 18;

/** Uniforms of all draws of a frame, one after the other in one buffer. */
export class UniformRing {
  #device;
  #floats = new Float32Array(BYTES / 4);
  #end = 0;

  constructor(device) {
    this.#device = device;
    this.buffer = device.createBuffer({size: BYTES, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST});
  }

  /** Whether there is room for structs of these layouts. */
  hasRoom(layouts) {
    return layouts.reduce((end, {size}) => end + Math.ceil(4 * size / STEP) * STEP, this.#end) <= BYTES;
  }

  /** Adds a struct and returns where it begins, in bytes. */
  add(layout, valueOf) {
    const at = this.#end;
    layout.write(this.#floats, at / 4, valueOf);
    this.#end = Math.ceil((at + 4 * layout.size) / STEP) * STEP;
    return at;
  }

  /** Brings them to the GPU; the next one is the first again. */
  send() {
    if (this.#end > 0) {
      this.#device.queue.writeBuffer(this.buffer, 0, this.#floats, 0, Math.min(this.#end, BYTES) / 4);
    }
    this.#end = 0;
  }
}
