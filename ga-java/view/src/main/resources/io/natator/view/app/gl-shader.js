/**
 * Shaders that WebGL and WebGPU share. Each is written once, in what GLSL ES 3 and WGSL have in common, so that
 * gpu-wgsl.js need only rewrite its declarations:
 *
 * - braces around what `if`, `else` and `for` rule; one variable in each declaration; no arrays;
 * - no `? :` but `select(no, yes, is)`, in which both are computed;
 * - arguments of `min`, `max`, `clamp`, `mix`, `pow`, `step` and `smoothstep` of one type, but for the last one of `mix`;
 * - no assignment to several components at once; `rotation(matrix)` for the 3 x 3 part, `differ(a, b)` for vectors;
 * - names that are reserved in neither; `in`, `out`, `flat` and `uniform` at the start of their lines.
 */

import * as THREE from 'three';

const COMMON = `
  #define select(no, yes, is) ((is) ? (yes) : (no))
  #define rotation(matrix) mat3(matrix)
  #define differ(one, other) ((one) != (other))
`;

/** A material of two such shaders; `uniforms` are values by name, `options` those of three.js. */
export function shader(vertexShader, fragmentShader, uniforms, options = {}) {
  return new THREE.ShaderMaterial({
    vertexShader: COMMON + vertexShader, fragmentShader: COMMON + fragmentShader, glslVersion: THREE.GLSL3,
    uniforms: Object.fromEntries(Object.entries(uniforms).map(([name, value]) => [name, {value}])), ...options,
  });
}

/** Options of what adds to what is there. */
export const ADDING = {
  transparent: true, blending: THREE.CustomBlending, blendEquation: THREE.AddEquation, blendSrc: THREE.OneFactor,
  blendDst: THREE.OneFactor, blendSrcAlpha: THREE.OneFactor, blendDstAlpha: THREE.OneFactor, depthTest: false, depthWrite: false,
};
