/* The washer solved in the page: a worker with the compiled kernels, started with the first question. */

import * as Runs from "./decode.js";

/** @type {any} with `solveAt`, which another script may have brought */
const page = window;
const NEAR = 0.05; // relative difference of film ratios on one branch

async function begin({ module, script, about, parameters, level }) {
  const worker = new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
  const asked = new Map();
  const ask = (task, given) =>
    new Promise((resolve, reject) => {
      const id = asked.size + 1;
      asked.set(id, { resolve, reject });
      worker.postMessage({ id, task, ...given });
    });
  worker.onmessage = ({ data: { id, result, problem } }) => {
    if (problem) asked.get(id)?.reject(new Error(problem));
    else asked.get(id)?.resolve(result);
  };
  await ask("begin", { bytes: await Runs.inflate(module), about });
  await ask("set", { parameters, level });
  return ask;
}

/* Of the branches that exist the one nearest to the recorded film ratio, as the report's moments. */
async function solve(ask, { about, least_load: least }, inputs, recorded) {
  const point = ["load", "speed", "tilt", "oil_temperature", "far_face_temperature"].map(
    (name) => inputs[name],
  );
  point[0] = Math.max(point[0], least);
  const away = (one) => Math.abs(one.outputs.film_ratio - recorded);
  const found = [];
  let unsolved = "on none of the branches";
  for (const branch of ["", "film", "contact"]) {
    const one = await ask("solve", { point, fresh: true, branch });
    if (one.code < about.first_failure && !one.missing) found.push(one);
    else if (!branch) unsolved = about.statuses[one.code];
    if (found.length && !(away(found[0]) > NEAR * recorded)) break;
  }
  if (!found.length) throw new Error(unsolved);
  return found.reduce((best, one) => (away(one) < away(best) ? one : best));
}

/* Say why nothing is solved at the cursor's time. */
export function missing(about) {
  return about
    ? "The washer cannot be solved at the cursor's time: this browser has no WebAssembly, in which its kernels run."
    : "The washer cannot be solved at the cursor's time: this page holds no kernels for it.";
}

/* Give the page `solveAt`, if it has none, holds the kernels and the browser runs them. */
export function start(about) {
  if (!about || page.solveAt || typeof WebAssembly === "undefined") return;
  let ready;
  page.solveAt = async (inputs, recorded) => {
    ready ??= begin(about);
    const { fields, outputs } = await solve(await ready, about, inputs, recorded);
    return { ...outputs, ...fields };
  };
}
