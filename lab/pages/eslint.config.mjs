// The JavaScript of the pages, and of the tests that run it in node.
import js from "@eslint/js";

const readonly = (names) =>
  Object.fromEntries(
    names
      .trim()
      .split(/\s+/)
      .map((name) => [name, "readonly"]),
  );
const page = readonly(`
  window document addEventListener matchMedia getComputedStyle devicePixelRatio requestAnimationFrame setTimeout
  clearTimeout IntersectionObserver ResizeObserver DecompressionStream Blob Response atob innerWidth Worker URL
  WebAssembly location history navigator Option CSS performance getSelection structuredClone`);
const worker = { onmessage: "writable", ...readonly("performance MessageChannel postMessage WebAssembly") };
const node = readonly("process performance Buffer URL WebAssembly console");

export default [
  { ignores: ["**/vendor/**", "**/bundle/**", "**/site/**"] },
  {
    files: ["**/*.{js,mjs}"],
    languageOptions: { sourceType: "module", globals: node },
    rules: {
      ...js.configs.recommended.rules,
      "no-redeclare": ["error", { builtinGlobals: false }],
      "no-shadow": ["error", { allow: ["state"] }],
      "no-unused-vars": ["error", { argsIgnorePattern: "^_", caughtErrors: "none" }],
      "prefer-const": "error",
      "no-var": "error",
      eqeqeq: "error",
      "no-eval": "error",
    },
  },
  { files: ["thrustwasher/studio/report/web/**/*.js"], languageOptions: { globals: page } },
  {
    files: ["thrustwasher/studio/report/web/{explore,scene}/*{worker,kernel,system}.js"],
    languageOptions: { globals: worker },
  },
];
