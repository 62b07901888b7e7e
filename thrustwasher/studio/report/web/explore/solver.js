/* A worker with the kernels, and what it is asked. */

import { byId } from "../draw.js";
import { ABOUT } from "./dom.js";

export class Solver {
  constructor(stopped) {
    const source = byId("worker").textContent;
    this.heard = {};
    this.count = 0;
    this.worker = new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
    this.worker.onmessage = ({ data }) =>
      this.heard[data.task]?.id === data.id && this.heard[data.task].answer(data.result, data.problem);
    this.worker.onerror = stopped;
  }

  /** Have it get ready; `answer` hears what is in the way. */
  begin(answer) {
    const bytes = Uint8Array.from(atob(byId("module").textContent.trim()), (c) => c.charCodeAt(0));
    this.ask("begin", { about: ABOUT.worker, bytes }, (_, problem) => answer(problem));
  }

  /** Ask for a task; of each task only the newest answer is heard. */
  ask(task, given, answer) {
    this.heard[task] = { id: (this.count += 1), answer };
    this.worker.postMessage({ id: this.count, task, ...given });
  }

  forget(task) {
    delete this.heard[task];
  }
}
