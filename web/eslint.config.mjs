// What the pages, their tests and what builds them keep to: faults that a reader misses, no rules of style. Run from the repository's root.
import js from '@eslint/js';
import globals from 'globals';

export default [
  { ignores: ['**/node_modules/**', 'web/made/**'] },
  js.configs.recommended,
  {
    languageOptions: { ecmaVersion: 2024, sourceType: 'module' },
    linterOptions: { reportUnusedDisableDirectives: 'error' },
    rules: {
      'array-callback-return': 'error',
      'eqeqeq': ['error', 'always', { null: 'ignore' }],
      'no-control-regex': 'off',  // what comes from others is looked through for them
      'no-implicit-globals': 'error',
      'no-self-compare': 'error',
      'no-shadow': 'error',
      'no-template-curly-in-string': 'error',
      'no-unused-vars': ['error', { args: 'after-used', ignoreRestSiblings: true }],
      'no-use-before-define': ['error', { functions: false, classes: false, variables: false }],
      'no-var': 'error',
      'prefer-const': 'error',
    },
  },
  { files: ['web/report/**', 'web/studio/**', 'web/site/**'], languageOptions: { globals: globals.browser } },
  { files: ['web/core/**'], languageOptions: { globals: { ...globals.browser, ...globals.worker } } },
  { files: ['web/*.mjs', 'web/site/**', 'tests/web/**'], languageOptions: { globals: { ...globals.node, ...globals.browser } } },
];
