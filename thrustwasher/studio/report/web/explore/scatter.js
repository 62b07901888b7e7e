/* Scatter: the model solved at draws of what is not known exactly, by two workers; quantiles of what it gives. */

import { el } from "../draw.js";
import { ABOUT, digits, quantiles, shown } from "./dom.js";
import { CHANGES, DRAWS, SOURCES, drawn } from "./draws.js";
import { fields, last, ruleWords, settled, solver, state } from "./page.js";
import { Solver } from "./solver.js";

const FRAME = 120; // ms between two looks at what is there so far

/** Return parameters and inputs by name as they are in a draw. */
function drawnValues(k) {
  const present = { ...state.parameters, ...state.inputs },
    found = { ...present };
  for (const change of CHANGES.filter(({ name }) => Object.hasOwn(fields, name))) {
    const { name, at_zero: zero } = change,
      counts = typeof zero === "string" ? present[zero] : zero;
    found[name] = drawn(change, k, present[name], fields[name].about, counts);
  }
  return found;
}

/** Return a band and its median over `x` of what `value(result, i)` is in the draws. */
export function bandOver(x, scatter, name, look, value) {
  const { sound, on, stale } = scatter,
    looks = `${look}${stale ? " stale" : ""}`;
  if (!on || sound.length < 2) return { bands: [], medians: [] };
  const rows = scatter.once(name, () => x.map((at, i) => [at, ...quantiles(sound.map((r) => value(r, i)))]));
  return {
    bands: [
      {
        name: `${name}: 5 to 95 % of the draws`,
        look: looks,
        points: rows.map(([at, low, , high]) => [at, low, high]),
      },
    ],
    medians: [
      {
        name: `${name}: median`,
        look: `median ${looks}`,
        points: rows.map(([at, , middle]) => [at, middle]),
      },
    ],
  };
}

/** Say in which band results of the draws lie, by their names. */
export function bandWords(names, results) {
  const one = (name) => {
    const { unit, relative } = ABOUT.outputs[name],
      [low, middle, high] = quantiles(results.map((r) => r.outputs[name])).map((v) =>
        shown(v, unit, relative, 3),
      );
    return `${name.replaceAll("_", " ")} ${low} .. ${high}, median ${middle}`;
  };
  return `5 to 95 % of the draws: ${names.map(one).join("; ")}.`;
}

/** The switch, the list of what scatters, and what the draws gave. */
export class Scatter {
  /** @type {() => any} */
  depends;
  /** @type {() => any} */
  show;
  /** @type {(values: Record<string, any>, k: number) => any} */
  given;
  /** @type {(result: any) => boolean} */
  lacks;
  /** @type {() => string} */
  told;
  /** @type {any[]} */
  results;
  /** @type {number[]} */
  queue;
  /** @type {string} */
  known;
  /** @type {boolean} */
  stale;
  /** @type {number} */
  version;
  /** @type {number} */
  began;
  /** @type {number} */
  took;
  /** @type {Record<string, any>} */
  kept;
  /** @type {any} */
  helper;
  /** @type {any} */
  input;
  /** @type {any} */
  said;
  /** @type {any} */
  drawing;

  /**
   * `of`: what the band is one of; `depends()`: what the draws depend on next to themselves; `given(values, k)`: what a
   * worker needs for a draw; `lacks(result)`: tells if a part of it is missing; `show()`: shows `results`; `told()`: a sentence on all of them.
   */
  constructor(host, { of, depends, given, lacks = () => false, show, told }) {
    Object.assign(this, {
      depends,
      given,
      lacks,
      show,
      told,
      results: [],
      queue: [],
      known: "",
      stale: false,
      helper: null,
      version: 0,
      kept: {},
    });
    this.input = el("input", { type: "checkbox", role: "switch", id: "scatter", disabled: !DRAWS });
    this.input.addEventListener("change", () => {
      this.set(this.input.checked);
      if (last) this.follow();
      settled();
    });
    this.said = el("p", { class: "folds", role: "status", id: "scatter-state" });
    const row = ({ name, law, reason }) =>
      el(
        "tr",
        {},
        el("th", { scope: "row" }, el("code", {}, name)),
        el("td", {}, law),
        el("td", {}, reason || "given"),
      );
    const list = el(
      "details",
      {},
      el("summary", {}, `inputs with a scatter (${SOURCES.length})`),
      el(
        "p",
        {},
        `${of}: 5 to 95 % of ${DRAWS} draws of what stands here, the same each time, about the values that are set. This band is of inputs; the error of the mesh is another one and is said above.`,
      ),
      el(
        "div",
        { class: "wide-table", tabindex: 0 },
        el(
          "table",
          {},
          el(
            "thead",
            {},
            el("tr", {}, ...["name", "law", "from"].map((text) => el("th", { scope: "col" }, text))),
          ),
          el("tbody", {}, ...SOURCES.map(row)),
        ),
      ),
      ...(ABOUT.scatter?.warnings ?? []).map((text) => el("p", {}, text)),
    );
    const label = el("label", { for: "scatter" }, this.input, " scatter (uncertainty): band of the draws");
    host.append(
      el(
        "div",
        { class: "scatter" },
        label,
        DRAWS ? list : el("p", {}, "This part has no [scatter]: nothing is known of how its inputs scatter."),
      ),
      this.said,
    );
  }

  get on() {
    return this.input.checked;
  }
  get complete() {
    return !this.stale && this.found.length === DRAWS;
  }
  get found() {
    return this.results.filter(Boolean);
  }
  get sound() {
    return this.found.filter((r) => !r.problem && !r.broken);
  }

  /** Return what was made of the present results under a name, made once. */
  once(name, make) {
    if (this.kept[name]?.version !== this.version) this.kept[name] = { version: this.version, made: make() };
    return this.kept[name].made;
  }

  /** Switch on or off; on, `follow` solves. */
  set(on) {
    this.input.checked = on && DRAWS > 0;
    if (!this.on) this.cancel();
    if (last) this.show();
  }

  /** Solve the draws about the present values, unless that has been done. */
  follow() {
    const known = JSON.stringify(this.depends());
    if (!this.on || known === this.known) return;
    Object.assign(this, {
      known,
      results: [],
      stale: false,
      began: performance.now(),
      queue: Array.from({ length: DRAWS }, (_, k) => k),
    });
    this.said.textContent = `Solving ${DRAWS} draws …`;
    this.feed(solver);
    if (this.helper?.ready) this.feed(this.helper);
    if (this.helper) return;
    this.helper = new Solver((problem) => (this.said.textContent = `The draws stopped: ${problem.message}.`));
    this.helper.begin((problem) => {
      this.helper.ready = !problem;
      if (!problem) this.feed(this.helper);
    });
  }

  /** Give a worker a draw: from one end each, so that both keep constants of about the same draws. */
  feed(one) {
    const k = one === solver ? this.queue.shift() : this.queue.pop(),
      { known } = this;
    if (k === undefined) return;
    one.ask("draw", { given: this.given(drawnValues(k), k) }, (found, problem) => {
      if (known !== this.known) return;
      this.results[k] = found ?? { problem };
      this.version += 1;
      this.feed(one);
      this.changed();
    });
  }

  changed() {
    if (this.complete) {
      this.took = performance.now() - this.began;
      this.show();
      this.say();
      document.documentElement.dataset.scattered = this.known;
    } else
      this.drawing ??= setTimeout(() => {
        this.drawing = undefined;
        if (this.known && !this.complete) this.show();
      }, FRAME);
  }

  /** Say what all draws gave, and which failed. */
  say() {
    if (!this.on || !this.complete) return;
    const why = new Set(
      this.results
        .map((r, k) => r.problem ?? (r.broken ? ruleWords(r.broken, drawnValues(k)) : ""))
        .filter(Boolean),
    );
    const failed = DRAWS - this.sound.length,
      partly = this.sound.filter(this.lacks).length;
    const words = [this.told()];
    if (failed)
      words.push(`${failed} of ${DRAWS} draws failed and do not count: ${[...why].slice(0, 3).join("; ")}.`);
    if (partly)
      words.push(
        `${partly} of ${DRAWS} draws have no solution at some of the loads, where they do not count.`,
      );
    this.said.textContent = `${words.join(" ")} ${DRAWS} draws in ${digits(this.took / 1000, 2)} s.`;
  }

  /** The present values are others, or `stopped`: the first worker has dropped its draw. */
  moved(stopped = false) {
    if (!this.known || (JSON.stringify(this.depends()) === this.known && (this.complete || !stopped))) return;
    this.cancel();
    this.show();
  }

  cancel() {
    Object.assign(this, { known: "", queue: [], stale: true });
    this.said.textContent = "";
    delete document.documentElement.dataset.scattered;
  }
}
