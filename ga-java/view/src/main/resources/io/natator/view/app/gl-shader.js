/** Materials of three.js from shaders of ours. */

import * as THREE from 'three';

/** A material of two shaders in GLSL ES 3; `uniforms` are values by name, `options` those of three.js. */
export function shader(vertexShader, fragmentShader, uniforms, options = {}) {
  return new THREE.ShaderMaterial({
    vertexShader, fragmentShader, glslVersion: THREE.GLSL3,
    uniforms: Object.fromEntries(Object.entries(uniforms).map(([name, value]) => [name, {value}])), ...options,
  });
}

/** Options of what adds to what is there. */
export const ADDING = {
  transparent: true, blending: THREE.CustomBlending, blendEquation: THREE.AddEquation, blendSrc: THREE.OneFactor,
  blendDst: THREE.OneFactor, blendSrcAlpha: THREE.OneFactor, blendDstAlpha: THREE.OneFactor, depthTest: false, depthWrite: false,
};
