/* The worker: answers "solve" at once; curves are made in slices between, the newest of each kind. */

import { Kernel } from "./kernel.js";

const SLICE = 12; // ms between two looks for messages
const jobs = new Map(),
  next = new MessageChannel();
let solver = null;

const describe = (problem) => String(problem?.message || problem);

function work() {
  const until = performance.now() + SLICE;
  for (const [name, job] of jobs) {
    try {
      let step;
      do step = job.steps.next();
      while (!step.done && performance.now() < until);
      if (!step.done) break;
      jobs.delete(name);
      postMessage({ id: job.id, task: name, result: step.value });
    } catch (problem) {
      jobs.delete(name);
      postMessage({ id: job.id, task: name, problem: describe(problem) });
    }
    if (performance.now() >= until) break;
  }
  if (jobs.size) next.port2.postMessage(0);
}
next.port1.onmessage = work;

/** Answer the page with a model: a class of what is made of kernels and of what they are about. */
export function serve(Model) {
  onmessage = ({ data }) => {
    const { id, task } = data;
    try {
      if (task === "begin") {
        const { about, bytes, modules } = data,
          each = ([key, own]) => [key, new Kernel(own, about.models[key].functions)];
        solver = new Model(
          modules
            ? Object.fromEntries(Object.entries(modules).map(each))
            : new Kernel(bytes, about.functions),
          about,
        );
        postMessage({ id, task });
      } else if (task === "set") {
        jobs.clear();
        postMessage({ id, task, result: solver.set(data.parameters, data.level) });
      } else if (task === "stop") jobs.clear();
      else if (task === "solve")
        postMessage({ id, task, result: solver.solve(data.point, data.fresh, data.branch, data.extra) });
      else {
        const idle = jobs.size === 0;
        jobs.set(task, { id, steps: solver[task](...data.given) });
        if (idle) next.port2.postMessage(0);
      }
    } catch (problem) {
      postMessage({ id, task, problem: describe(problem) });
    }
  };
}
