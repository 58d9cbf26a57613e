/** Rewrites a pair of shared shaders (gl-shader.js) in WGSL. */

const TYPES = 'float|int|bool|vec2|vec3|vec4|mat3|mat4';

/** What three.js declares for every shader: uniforms, and attributes of vertices. */
const UNIFORMS = {modelViewMatrix: 'mat4', projectionMatrix: 'mat4', viewMatrix: 'mat4', normalMatrix: 'mat3', cameraPosition: 'vec3'};
const ATTRIBUTES = {position: 'vec3', normal: 'vec3', uv: 'vec2'};

const LIBRARY = `
diagnostic(off, derivative_uniformity);
alias float = f32;
alias int = i32;
alias vec2 = vec2f;
alias vec3 = vec3f;
alias vec4 = vec4f;
alias mat3 = mat3x3f;
alias mat4 = mat4x4f;
fn rotation(matrix: mat4x4f) -> mat3x3f { return mat3x3f(matrix[0].xyz, matrix[1].xyz, matrix[2].xyz); }
fn differ(one: vec2f, other: vec2f) -> bool { return any(one != other); }
fn inverse(matrix: mat3x3f) -> mat3x3f {
  let first = cross(matrix[1], matrix[2]);
  let second = cross(matrix[2], matrix[0]);
  let third = cross(matrix[0], matrix[1]);
  return transpose(mat3x3f(first, second, third)) * (1.0 / dot(matrix[0], first));
}
`;

/** Takes the declarations of a kind out of a shader: its text without them, and [type, name] of each. */
function takeOut(text, kinds) {
  const found = [];
  const rest = text.replace(new RegExp(`^\\s*(?:${kinds})\\s+(\\w+)\\s+(\\w+)\\s*;`, 'gm'), (all, type, name) => {
    found.push({type, name, isFlat: /^\s*flat/.test(all)});
    return '';
  });
  return [rest, found];
}

/** Functions and constants in WGSL. A texture is followed by its sampler wherever it is named. */
function rewrite(text, textures) {
  const maps = new Set([...textures, ...Array.from(text.matchAll(/sampler2D\s+(\w+)/g), found => found[1])]);
  let result = text;
  for (const map of maps) {
    result = result.replace(new RegExp(`(?<!sampler2D )\\b${map}\\b`, 'g'), `${map}, ${map}_sampler`);
  }
  const parameter = one => one.trim().replace(/^sampler2D (\w+)$/, '$1: texture_2d<f32>, $1_sampler: sampler')
      .replace(/^(\w+) (\w+)$/, '$2: $1');
  result = result.replace(new RegExp(`\\b(void|${TYPES}) (\\w+)\\(([^)]*)\\) *\\{`, 'g'), (all, type, name, parameters) => {
    const list = parameters.trim() === '' ? '' : parameters.split(',').map(parameter).join(', ');
    return `fn ${name}(${list}) ${type === 'void' ? '' : `-> ${type} `}{`;
  });
  // Of the first level: WebGPU chooses a level only where all pixels come along.
  return result.replace(/\btexture\(/g, 'textureSampleBaseClampToEdge(')
      .replace(new RegExp(`\\bconst (${TYPES}) (\\w+) *=`, 'g'), 'const $2: $1 =')
      .replace(new RegExp(`\\b(${TYPES}) (\\w+) *(=|;)`, 'g'), 'var $2: $1 $3');
}

function globals(list) {
  return list.map(({type, name}) => `var<private> ${name}: ${type};\n`).join('');
}

function has(text, name) {
  return new RegExp(`\\b${name}\\b`).test(text);
}

function predeclared(known, text, declared) {
  return Object.entries(known).filter(([name]) => has(text, name) && !declared.some(one => one.name === name))
      .map(([name, type]) => ({name, type}));
}

/**
 * Vertices become those of WebGPU, whose depth goes from 0 to 1 and not from -1. Rows are turned round, so that textures
 * lie as in WebGL, from below. Points become squares of four corners.
 *
 * @param {string} vertexShader
 * @param {string} fragmentShader
 * @param {boolean} isPoints
 * @returns {{vertex: string, fragment: string, uniforms: object[], textures: string[], attributes: object[]}} two modules
 *     that begin at `begin`; uniforms and attributes as {name, type}: the struct at binding 0, which ends with the size of the
 *     target, and what is read from locations 0, 1, ...; textures at bindings 1, 3, ..., their samplers at 2, 4, ...
 */
export function toWgsl(vertexShader, fragmentShader, isPoints) {
  const [bareVertex, bareFragment] = [vertexShader, fragmentShader].map(text =>
    text.replace(/\/\*[\s\S]*?\*\/|\/\/.*|^\s*#.*/gm, ''));
  const [vertexRest, vertexUniforms] = takeOut(bareVertex, 'uniform');
  const [fragmentRest, fragmentUniforms] = takeOut(bareFragment, 'uniform');
  const [vertexOuts, declaredAttributes] = takeOut(vertexRest, 'in');
  const [vertexText, varyings] = takeOut(vertexOuts, 'flat out|out');
  const [fragmentOuts] = takeOut(fragmentRest, 'flat in|in');
  const [fragmentText, outputs] = takeOut(fragmentOuts, 'out');
  const declared = [...new Map([...vertexUniforms, ...fragmentUniforms].map(one => [one.name, one])).values()];
  const textures = declared.filter(({type}) => type === 'sampler2D').map(({name}) => name);
  const uniforms = declared.filter(({type}) => type !== 'sampler2D');
  uniforms.push(...predeclared(UNIFORMS, vertexText + fragmentText, uniforms), {name: 'targetSize', type: 'vec2'});
  const attributes = [...declaredAttributes, ...predeclared(ATTRIBUTES, vertexText, declaredAttributes)];
  const shared = LIBRARY + interfaceOf(uniforms, textures, isPoints ? [...varyings, {name: 'pointPlace', type: 'vec2'}] : varyings);
  return {
    vertex: shared + vertexModule(rewrite(vertexText, textures), uniforms, attributes, varyings, isPoints),
    fragment: shared + fragmentModule(rewrite(fragmentText, textures), uniforms, varyings, outputs[0].name, isPoints),
    uniforms, textures, attributes,
  };
}

function interfaceOf(uniforms, textures, varyings) {
  return `
struct Uniforms {
${uniforms.map(({name, type}) => `  ${name}: ${type},\n`).join('')}}
@group(0) @binding(0) var<uniform> uniforms: Uniforms;
${textures.map((name, i) => `@group(0) @binding(${1 + 2 * i}) var ${name}: texture_2d<f32>;
@group(0) @binding(${2 + 2 * i}) var ${name}_sampler: sampler;
`).join('')}
struct Varyings {
  @builtin(position) device: vec4f,
${varyings.map(({name, type, isFlat}, i) => `  @location(${i})${isFlat ? ' @interpolate(flat)' : ''} ${name}: ${type},\n`).join('')}}
`;
}

function vertexModule(text, uniforms, attributes, varyings, isPoints) {
  const reads = attributes.map(({name, type}, i) => `@location(${i}) ${name}_read: ${type}, `).join('');
  return `${globals(uniforms)}${globals(attributes)}${globals(varyings)}
var<private> gl_Position: vec4f;
var<private> gl_PointSize: f32;
${text}
@vertex fn begin(${reads}@builtin(vertex_index) corner_index: u32) -> Varyings {
${uniforms.map(({name}) => `  ${name} = uniforms.${name};\n`).join('')}${attributes.map(({name}) => `  ${name} = ${name}_read;\n`).join('')}
  main();
  var made: Varyings;
${varyings.map(({name}) => `  made.${name} = ${name};\n`).join('')}${isPoints ? `
  let corner = vec2f(f32(corner_index & 1u), f32(corner_index >> 1u)) * 2.0 - 1.0;
  gl_Position += vec4f(corner * gl_PointSize / targetSize * gl_Position.w, 0.0, 0.0);
  made.pointPlace = vec2f(0.5 + 0.5 * corner.x, 0.5 - 0.5 * corner.y);
` : ''}
  made.device = vec4f(gl_Position.x, -gl_Position.y, 0.5 * (gl_Position.z + gl_Position.w), gl_Position.w);
  return made;
}
`;
}

function fragmentModule(text, uniforms, varyings, output, isPoints) {
  const hasDepth = has(text, 'gl_FragDepth');
  return `${globals(uniforms)}${globals(varyings)}
var<private> gl_FragCoord: vec4f;
var<private> gl_PointCoord: vec2f;
var<private> gl_FragDepth: f32;
var<private> ${output}: vec4f;
struct Made {
  @location(0) colour: vec4f,
${hasDepth ? '  @builtin(frag_depth) depth: f32,\n' : ''}}
${text}
@fragment fn begin(read: Varyings) -> Made {
${uniforms.map(({name}) => `  ${name} = uniforms.${name};\n`).join('')}${varyings.map(({name}) => `  ${name} = read.${name};\n`).join('')}
  gl_FragCoord = read.device;
${isPoints ? '  gl_PointCoord = read.pointPlace;\n' : ''}
  main();
  var made: Made;
  made.colour = ${output};
${hasDepth ? '  made.depth = gl_FragDepth;\n' : ''}
  return made;
}
`;
}
