/** Faults that no type shows. Form is a reader's business, types are tsc's. */

import js from '@eslint/js';
import globals from 'globals';

const SHARED_RULES = {
  eqeqeq: 'error',
  'no-var': 'error',
  'prefer-const': 'error',
  'no-shadow': 'error',
};

export default [
  js.configs.recommended,
  {files: ['src/main/resources/**/*.js'], languageOptions: {globals: globals.browser}, rules: SHARED_RULES},
  {files: ['src/test/js/**/*.js', '*.js'], languageOptions: {globals: globals.node}, rules: SHARED_RULES},
  {ignores: ['target/']},
];
