// The JavaScript of the pages: plain scripts that share a page or, of explore, are joined to one; no build step.
import js from "@eslint/js";

const browser = ["window", "document", "addEventListener", "matchMedia", "getComputedStyle", "devicePixelRatio",
  "requestAnimationFrame", "setTimeout", "clearTimeout", "IntersectionObserver", "DecompressionStream", "Blob",
  "Response", "atob", "innerWidth", "Worker", "URL", "WebAssembly", "location", "history", "navigator", "Option", "CSS"];
const here = ["performance", "MessageChannel", "postMessage", "ResizeObserver", "getSelection", "structuredClone"];
// explore: what one script declares and another one uses
const joined = ["ABOUT", "Disc", "Kernel", "Model", "Plot", "PointModel", "VIEW", "allowed", "ask", "axisUnit", "digits", "el", "escaped", "headed",
  "ALONE", "SHALLOW", "Draw", "Walker", "CHANGES", "DRAWS", "bandOver", "bandWords", "SHARES", "Scatter", "Solver", "drawn", "quantiles", "numbersOf", "ruleWords", "settled", "solver",
  "Units", "KNOWN", "effective", "figuresOf", "isSame", "movedPoint", "profilesOf", "readProfile", "sceneText", "wrongWith", "writtenProfile",
  "fields", "inputChanged", "last", "pixelsOf", "pretty", "readQuantity", "shown", "state"];
const shared = ["el", "Disc", "pixelsOf", "uPlot", "Runs", "colour", "number", "Plots", "Controls", "Flow", "Live", "Discs", "Slip",
  "Units", "Address", "Exports", "Figures"];

const globals = (names, may = "readonly") => Object.fromEntries(names.map((name) => [name, may]));
const rules = {
  ...js.configs.recommended.rules,
  "no-redeclare": ["error", { builtinGlobals: false }],
  "prefer-const": "error", "no-var": "error", eqeqeq: "error", "no-eval": "error",
};

export default [
  { ignores: ["**/vendor/**"] },
  {
    files: ["thrustwasher/report/web/{*,shift/*,chart/*}.js"],
    languageOptions: { sourceType: "script", globals: globals([...browser, ...shared]) },
    rules: {
      ...rules, "no-shadow": "error",
      "no-unused-vars": ["error", { varsIgnorePattern: `^(${shared.join("|")})$` }],
    },
  },
  {
    files: ["thrustwasher/report/web/{explore,scene}/*.js"],
    languageOptions: { sourceType: "script", globals: { ...globals([...browser, ...here]), ...globals([...joined, "onmessage"], "writable") } },
    rules: { ...rules, "no-unused-vars": ["error", { vars: "local" }] },
  },
];
