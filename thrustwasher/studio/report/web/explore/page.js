/* The page: controls, figures, address; what is solved comes from the worker. */

import { byId, el, every } from "../draw.js";
import { ABOUT, allowed, digits, pretty, readQuantity, shown } from "./dom.js";
import { DRAWS } from "./draws.js";
import { Solver } from "./solver.js";
import * as Units from "../units.js";

const SETTLE = 180; // ms without a change until the numbers are those of a fresh solve
const SLOW = 100; // ms from which on the page says that a solution is not there yet
const NOISE = 1e-12,
  USUAL = 100; // of an output's usual size, and that of one of no known size: what is less is rounding
export const state = {
  inputs: {},
  parameters: {},
  level: ABOUT.level,
  branch: "",
  asked: "",
  held: "",
  extra: {},
  strange: "",
};
const BRANCHES_ASKED = ["", "film", "contact"],
  TRUE = ["true", "1"],
  FALSE = ["false", "0"];
export const fields = {};
let view,
  solver,
  quiet = false,
  busy = false,
  setting = false,
  anew = false,
  waiting = null,
  timer = 0,
  broken = "",
  point = null,
  last = null;

/** A number field with its unit, its range, what is wrong with it, and a slider if requested. */
class Field {
  /** @type {any} */
  about;
  /** @type {any} */
  kept;
  /** @type {any} */
  input;
  /** @type {any} */
  slider;
  /** @type {(name: string) => any} */
  changed;

  constructor(about, kept, changed, withSlider) {
    Object.assign(this, { about, kept, changed });
    const { name, unit, help, kind, options } = about,
      id = `in-${name}`;
    this.error = el("p", { class: "error", id: `${id}-error`, role: "alert" });
    this.more = el("span", { class: "more" });
    const common = { id, name, "aria-describedby": `${id}-error` };
    if (kind === "enumeration") {
      this.input = el(
        "select",
        common,
        ...Object.entries(options).map(([key, text]) => el("option", { value: key, title: text }, key)),
      );
    } else if (kind === "boolean") this.input = el("input", { ...common, type: "checkbox" });
    else
      this.input = el("input", { ...common, inputmode: "decimal", autocomplete: "off", spellcheck: "false" });
    this.input.addEventListener("input", () =>
      this.take(kind === "boolean" ? this.input.checked : this.input.value),
    );
    this.input.addEventListener(
      "change",
      () => this.input.ariaInvalid === "true" || this.put(this.kept[name]),
    );
    const line = el(
      "div",
      { class: "line" },
      this.input,
      el("span", { class: "unit" }, unit === "1" ? "" : pretty(unit)),
      this.more,
    );
    this.box = el(
      "div",
      { class: "field" },
      el("label", { for: id }, help, el("code", {}, name)),
      line,
      this.error,
    );
    if (withSlider) {
      this.slider = el("input", {
        type: "range",
        min: 0,
        max: 1000,
        step: "any",
        "aria-label": `${help}, slider`,
        id: `${id}-slider`,
      });
      this.slider.addEventListener("input", () =>
        this.take(this.valueAt(Number(this.slider.value) / 1000), this.slider),
      );
      line.after(this.slider);
    }
    this.put(kept[name]);
  }

  get log() {
    return this.about.from > 0 && this.about.to / this.about.from > 50;
  }

  valueAt(share) {
    const { from, to, kind } = this.about;
    const value = this.log ? from * (to / from) ** share : from + (to - from) * share;
    return kind === "integer" ? Math.round(value) : Number(value.toPrecision(4));
  }

  /** Take what was given if it is allowed; else mark it, the last good value stays. */
  take(given, from = this.input) {
    const { name, kind, min, max, options } = this.about;
    let value = given,
      good = true,
      words,
      wrong = ` = ${given}`;
    if (kind === "enumeration")
      [good, words] = [Object.hasOwn(options, given), Object.keys(options).join(" or ")];
    else if (kind === "boolean")
      [value, good, words] = [
        TRUE.includes(String(given)),
        [...TRUE, ...FALSE].includes(String(given)),
        "true or false",
      ];
    else {
      const read = readQuantity(given, this.about);
      [value, wrong, words] = [read.value, read.wrong, allowed(this.about, read.as)];
      good = value >= min && value <= max && (kind !== "integer" || Number.isInteger(value));
    }
    this.input.setAttribute("aria-invalid", String(!good));
    this.error.textContent = good
      ? ""
      : `${name}${wrong}${wrong.includes(":") ? ";" : ","} allowed: ${words}`;
    if (!good) {
      if (from !== this.input && !options && kind !== "boolean") this.input.value = given; // what the message is about
      return false;
    }
    this.kept[name] = value;
    this.put(value, from);
    this.changed(name);
    return true;
  }

  /** Show a value; what it came from stays as it is. */
  put(value, from = null) {
    const { kind, unit, from: low, to: high, relative } = this.about;
    if (kind === "boolean") this.input.checked = Boolean(value);
    else if (from !== this.input) this.input.value = String(value);
    if (this.slider) {
      const share = this.log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
      if (from !== this.slider) this.slider.value = 1000 * Math.min(Math.max(share, 0), 1);
      const text = unit === "K" && !relative && value === 0 ? "not given" : shown(value, unit, relative);
      this.slider.setAttribute("aria-valuetext", text);
      this.more.textContent =
        unit === "1" ? "" : unit === "rad/s" ? `${digits((value * 30) / Math.PI)} rpm` : text;
    }
  }

  set(value) {
    this.kept[this.about.name] = value;
    this.input.setAttribute("aria-invalid", "false");
    this.error.textContent = "";
    this.put(value);
  }
}

export const ask = (task, given, answer) => solver.ask(task, given, answer);

/** Return parameters as the kernels take them. */
export const numbersOf = (values) =>
  ABOUT.parameters.map((f) => {
    const value = values[f.name];
    return f.kind === "enumeration" ? Object.keys(f.options).indexOf(value) + 1 : Number(value);
  });

/** Say which rule some values break, by its number; `least`: the minimum number that it allows. */
export function ruleWords(number, values, least) {
  if (number < 0) return "these parameters cannot be used together";
  const own = (name, factor = 1) =>
    typeof values[name] === "number" ? digits(values[name] * factor, 6) : values[name];
  const text = ABOUT.rules[number - 1],
    words = least ? text.replace("allowed: more", `allowed: ${least} and more`) : text;
  return words
    .replace(/{(\w+)} rad/g, (_, n) => `${own(n, 180 / Math.PI)} deg`)
    .replace(/{(\w+)}/g, (_, n) => own(n));
}

/** Have the worker take the parameters and solve; tell which rule they break. Nothing is solved meanwhile. */
function setParameters() {
  setting = true;
  view.scatter?.moved(true);
  ask("set", { parameters: numbersOf(state.parameters), level: state.level }, (found, problem) => {
    if (anew) state.held = ""; // an address has no history
    setting = anew = false;
    waiting = null;
    const [number, least] = [found].flat();
    broken = problem ?? (number ? ruleWords(number, state.parameters, least) : "");
    if (broken) failed(broken);
    else solve(true);
  });
}

/** Solve; only the newest wish waits while one is being solved. */
function solve(fresh) {
  if (busy || setting) waiting = { fresh };
  if (broken || busy || setting) return;
  busy = true;
  point = ABOUT.inputs.map((s) => state.inputs[s.name]);
  // the branch that the address names, else the one where the last solution is
  const began = performance.now(),
    { asked, extra } = state,
    branch = asked || state.held,
    slow = setTimeout(() => (last || location.hash) && stale("solving"), SLOW);
  ask("solve", { point, fresh, branch, extra }, (result, problem) => {
    busy = false;
    clearTimeout(slow);
    if (fresh) state.asked = "";
    if (problem || result.code >= ABOUT.worker.first_failure)
      failed(problem ?? `No solution: ${ABOUT.worker.statuses[result.code]}`);
    else received(result, fresh, performance.now() - began, result.missing ? asked : "");
    const wish = waiting;
    waiting = null;
    if (wish) solve(wish.fresh);
  });
}

function say(text, look = "") {
  const place = byId("state");
  place.className = look;
  if (place.textContent !== text) place.textContent = text;
}

/** Say that the figures are not those of the inputs: other ones, greyed, or none yet. */
function stale(words, look = "") {
  const at = ABOUT.inputs
    .map((s, i) => `${s.name} ${shown(last?.point[i], s.unit, s.relative, 6)}`)
    .join(", ");
  byId("results").classList.add("stale");
  byId("views").classList.toggle("empty", !last);
  reveal(".live");
  fillBoxes();
  for (const place of last ? [] : every("dl data")) [place.textContent, place.value] = ["–", ""];
  say(
    `${state.strange}${words}${last ? `; the figures are those of ${at}` : "; there are no figures yet"}`,
    look,
  );
}

function failed(words) {
  stale(words, "problem");
  state.strange = "";
  settled();
}

function received(result, fresh, took, gone) {
  last = { ...result, point: point.slice() };
  state.held = result.outputs.branch ?? "";
  reveal(".live");
  if (!fresh && byId("results").classList.contains("stale")) say("solving");
  byId("results").classList.remove("stale");
  byId("views").classList.remove("empty");
  const [error_estimate, known] = verified();
  for (const [name, value] of Object.entries({ ...result.outputs, error_estimate })) show(name, value);
  const missing = gone
    ? `The ${gone} branch has no solution here; this is the ${result.outputs.branch} branch. `
    : "";
  const advice =
    (view.warning?.(result.outputs) ?? "") + (result.code ? `${ABOUT.worker.statuses[result.code]}; ` : "");
  if (fresh) {
    const look = state.strange || missing || advice || String(known).includes("outside") ? "problem" : "";
    say(
      `${state.strange}${missing}${advice}solved in ${digits(took, 2)} ms; fidelity level ${state.level} (${ABOUT.levels[state.level]}); ${known}`,
      look,
    );
    state.strange = "";
  }
  view.solved(result, fresh);
  if (fresh) {
    state.branch = result.asked ? result.outputs.branch : "";
    settled();
  }
  document.documentElement.dataset.solved = String(Number(document.documentElement.dataset.solved ?? 0) + 1);
}

const isNoise = (name, value) => Math.abs(value) < NOISE * (ABOUT.outputs[name].scale ?? USUAL);

/** Put a figure into its places; rounding noise counts as 0, what is divided by it is not there. */
function show(name, value) {
  const place = byId(name),
    about = ABOUT.outputs[name],
    over = view.over?.[name];
  if (!place || !about) return;
  const words = about.options
    ? about.options[value - 1]
    : about.kind === "boolean"
      ? value
        ? "yes"
        : "no"
      : (value ?? (name === "error_estimate" ? "not verified here" : "none"));
  place.setAttribute("value", String(about.options ? words : (value ?? "")));
  place.textContent =
    over && isNoise(over, last.outputs[over])
      ? "–"
      : typeof words === "number"
        ? shown(isNoise(name, words) ? 0 : words, about.unit, about.relative)
        : words;
  if (name === "distress") place.className = value ? "bad" : "";
}

const size = (table, name, values) => (table.envelope[name].min >= 0 ? Math.abs(values[name]) : values[name]);
const isOutside = (table, name, values) =>
  !(
    size(table, name, values) >= table.envelope[name].min &&
    size(table, name, values) <= table.envelope[name].max
  );

/** Return the largest error measured around this point, null outside the verification table's box. */
function errorOf(table, values) {
  if (Object.keys(table.envelope).some((name) => isOutside(table, name, values))) return null;
  const at = (name) => (name in table.envelope ? size(table, name, values) : values[name]);
  const here = (axes, row) => axes.every((name, k) => row[2 * k] <= at(name) && at(name) <= row[2 * k + 1]);
  const known = table.divisions.filter(({ axes }) => axes.every((name) => Number.isFinite(values[name])));
  return Math.min(
    ...known.map(({ axes, rows }) =>
      Math.max(...rows.filter((row) => here(axes, row)).map((row) => row.at(-1))),
    ),
  );
}

/** Return the verified error of the last torque, null where no verification table knows it, and the message on it. */
function verified() {
  const at = Object.fromEntries(ABOUT.inputs.map((s, i) => [s.name, last.point[i]])),
    { branch, film_ratio } = last.outputs;
  const values = { film_ratio, ...(view.values?.(at) ?? at) },
    chart = view.chart ?? branch;
  const tables = ABOUT.error_tables.filter(
    (c) => c.fidelity === state.level && (!c.chart || !chart || c.chart === chart),
  );
  if (!ABOUT.error_tables.length || changes(ABOUT.given).length)
    return [null, "no error is verified for these parameters"];
  if (!tables.length) return [null, "no error is verified at this fidelity level"];
  const found = tables.map((c) => errorOf(c, values)).filter((e) => e !== null),
    error = ABOUT.safety * Math.max(...found);
  if (found.length)
    return [
      error,
      `verified error of the torque ${view.where ?? "here"}: ${error < 1e-5 ? "below 0.001" : `at most ${digits(100 * error, 2)}`} %`,
    ];
  const out = Object.entries(tables[0].envelope).filter(([name]) =>
    tables.every((c) => isOutside(c, name, values)),
  );
  const range = ([name, a]) =>
    `${name} ${shown(values[name], a.unit)} (${shown(a.min, a.unit)} .. ${shown(a.max, a.unit)})`;
  return [
    null,
    `no error is verified at this point${out.length ? `; outside the verified range: ${out.map(range).join(", ")}` : ""}`,
  ];
}

/** Return the parameters that differ from some values. */
const changes = (from) =>
  ABOUT.parameters
    .filter((f) => state.parameters[f.name] !== from[f.name])
    .map((f) => [f.name, state.parameters[f.name]]);

export function settled() {
  byId("oil").value =
    Object.keys(ABOUT.oils).find((name) =>
      Object.entries(ABOUT.oils[name]).every(([n, v]) => state.parameters[n] === v),
    ) ?? "";
  const pairs = [...Object.entries(state.inputs), ...changes(ABOUT.given)];
  if (state.level !== ABOUT.level) pairs.push(["fidelity", state.level]);
  if (state.branch) pairs.push(["branch", state.branch]);
  if (view.scatter?.on) pairs.push(["scatter", "true"]);
  if (Units.mode !== "mixed") pairs.push(["units", Units.mode]);
  for (const [name, value] of Object.entries(state.extra)) pairs.push([name, JSON.stringify(value)]);
  const text = `#${pairs.map(([n, v]) => `${n}=${encodeURIComponent(v)}`).join("&")}`;
  if (text !== location.hash) history.replaceState(null, "", text);
  fillBoxes();
  document.documentElement.dataset.settled = text;
}

const fillBoxes = () =>
  Object.entries(reproduced()).forEach(([name, text]) => (byId(`as-${name}`).textContent = text));

/** Return the command, the Python lines and the part file that give the same figures. */
function reproduced() {
  const changed = changes(ABOUT.defaults),
    { key, name, python } = ABOUT,
    level = state.level;
  const inputs = Object.entries(state.inputs),
    { solve: solved, params } = python;
  const literal = (v) => (typeof v === "string" ? `"${v}"` : v === true ? "True" : v === false ? "False" : v);
  const more = [];
  if (level !== ABOUT.usual_level) more.push(["fidelity", level]);
  if (state.branch) more.push(["branch", state.branch]);
  const options = [...inputs, ...more].map(([n, v]) => `--${n.replaceAll("_", "-")} ${v}`);
  const sets = changed.map(([n, v]) => `--set ${n}=${v}`),
    given = changed.map(([n, v]) => `${n}=${literal(v)}`).join(", ");
  const values = [...inputs, ...more].map(([n, v]) => `${n}=${literal(v)}`).join(", ");
  const own = view.reproduced?.(given, state.inputs, sets.join(" ")) ?? {};
  return {
    command: `thrustwasher ${key} ${[...options, ...sets].join(" ")}`,
    python: `from thrustwasher import ${params}, ${solved}\n\nparams = ${params}(${given})\nresult = ${solved}(params, ${values})\nprint(result.${Object.keys(ABOUT.outputs)[0]})`,
    part: `model = "${key}"\nname = "${name}"\nfidelity = "${level}"\n\n[parameters]\n${changed.map(([n, v]) => `${n} = ${JSON.stringify(v)}`).join("\n")}`,
    ...own,
  };
}

/** Take what the address names and solve; what cannot be taken is in a message, all else stays as it is. */
function readAddress() {
  const decoded = (text) => {
    try {
      return decodeURIComponent(text);
    } catch {
      return text;
    }
  };
  const words = new Map(
    location.hash
      .slice(1)
      .split("&")
      .filter(Boolean)
      .map((w) => [w.split("=")[0], decoded(w.split("=").slice(1).join("="))]),
  );
  for (const f of ABOUT.parameters) if (!words.has(f.name)) fields[f.name].set(ABOUT.given[f.name]);
  for (const s of ABOUT.inputs)
    if (!words.has(s.name)) fields[s.name].set(words.size ? state.inputs[s.name] : s.value);
  if (words.size === 0) view.reset?.();
  const strange = [];
  quiet = true;
  for (const [name, text] of words) {
    if (Object.hasOwn(fields, name)) {
      if (!fields[name].take(text, null)) strange.push(fields[name].error.textContent);
    } else if (name === "branch" && "branch" in ABOUT.outputs) {
      if (!BRANCHES_ASKED.includes(text)) strange.push(`branch = ${text}, allowed: film or contact`);
    } else if (name === "fidelity") {
      if (!Object.hasOwn(ABOUT.worker.levels, text))
        strange.push(`fidelity = ${text}, allowed: ${Object.keys(ABOUT.worker.levels).join(" or ")}`);
    } else if (name === "units") {
      if (Units.wrong) strange.push(Units.wrong);
    } else if (name === "scatter" && view.scatter) {
      if (![...TRUE, ...FALSE].includes(text)) strange.push(`scatter = ${text}, allowed: true or false`);
      else if (TRUE.includes(text) && !DRAWS)
        strange.push(`scatter = ${text}, allowed: false, since this part has no [scatter]`);
    } else if (Object.hasOwn(state.extra, name)) {
      try {
        state.extra[name] = view.checked(name, JSON.parse(text));
      } catch {
        strange.push(`${name}, allowed: ${view.allows}`);
      }
    } else strange.push(`${name} is nothing that this page knows`);
  }
  quiet = false;
  const branch = words.get("branch") ?? "",
    level = words.get("fidelity") ?? ABOUT.level;
  state.asked = BRANCHES_ASKED.includes(branch) ? branch : "";
  if (Object.hasOwn(ABOUT.worker.levels, level)) state.level = byId("fidelity").value = level;
  view.scatter?.set(TRUE.includes(words.get("scatter")));
  state.strange = strange.length ? `The address: ${strange.join("; ")}. ` : "";
  anew = true;
  setParameters();
}

export function inputChanged() {
  if (quiet) return;
  view.scatter?.moved();
  solve(false);
  clearTimeout(timer);
  timer = setTimeout(() => solve(true), SETTLE);
}

const parametersChanged = () => quiet || setParameters();

function builtControls() {
  const inputs = byId("inputs"),
    main = byId("main-parameters"),
    all = byId("all-parameters");
  for (const s of ABOUT.inputs) {
    state.inputs[s.name] = s.value;
    fields[s.name] = new Field(s, state.inputs, inputChanged, true);
    inputs.append(fields[s.name].box);
  }
  for (const f of ABOUT.parameters) {
    state.parameters[f.name] = ABOUT.given[f.name];
    const isMain = ABOUT.main.includes(f.name),
      slides = isMain
        ? f.kind !== "enumeration" && f.kind !== "boolean"
        : ABOUT.group.includes(f.name) && (f.from !== f.min || f.to !== f.max);
    fields[f.name] = new Field(f, state.parameters, parametersChanged, slides);
    (isMain ? main : all).append(fields[f.name].box);
  }
  if (ABOUT.group.length) {
    const group = byId("group-parameters");
    group.append(...ABOUT.group.map((name) => fields[name].box)); // in their own order
    group.parentNode.open = innerWidth > 760; // above the results where it is narrower
  }
  const levels = el(
    "select",
    { id: "fidelity" },
    ...Object.keys(ABOUT.worker.levels).map((r) => el("option", { value: r, title: ABOUT.levels[r] }, r)),
  );
  levels.value = state.level;
  levels.addEventListener("change", () => {
    state.level = levels.value;
    parametersChanged();
  });
  main.prepend(
    el(
      "div",
      { class: "field" },
      el("label", { for: "fidelity" }, "fidelity level: mesh and laws", el("code", {}, "fidelity")),
      levels,
    ),
  );
  const oils = el(
    "select",
    { id: "oil" },
    el("option", { value: "" }, "its own parameters"),
    ...Object.keys(ABOUT.oils).map((name) => el("option", {}, name)),
  );
  oils.addEventListener("change", () => {
    for (const name of Object.keys(Object.values(ABOUT.oils)[0]))
      fields[name].set((ABOUT.oils[oils.value] ?? ABOUT.given)[name]);
    setParameters(); // `set` itself tells nobody
  });
  main.append(
    el(
      "div",
      { class: "field" },
      el("label", { for: "oil" }, "oil: typical viscosity and density of its class", el("code", {}, "oil")),
      oils,
    ),
  );
  byId("reset").after(Units.choice());
  byId("reset").addEventListener("click", () => {
    location.hash = Units.mode === "mixed" ? "" : `units=${Units.mode}`;
  });
  for (const button of every("button[data-copy]")) {
    button.addEventListener("click", () => {
      getSelection()?.selectAllChildren(byId(button.dataset.copy));
      navigator.clipboard?.writeText(byId(button.dataset.copy).textContent).catch(() => {});
    });
  }
}

/** Show the live part. */
function reveal(which) {
  for (const part of every(which)) part.hidden = false;
}

function begin() {
  const still = byId("state").textContent;
  solver = new Solver((problem) =>
    say(
      `The computation stopped: ${problem.message}. ${last ? "The figures are the last ones found." : still}`,
      "problem",
    ),
  );
  solver.begin((problem) => {
    if (problem) {
      say(`This browser cannot run the kernels: ${problem}. ${still}`, "problem");
      return;
    }
    builtControls();
    view.build(byId("views"));
    reveal("#controls");
    readAddress();
    addEventListener("hashchange", () => {
      if (location.hash !== document.documentElement.dataset.settled) readAddress();
    });
  });
}

/** Show a model's page, by its own part of it. */
export function start(own) {
  view = own;
  if (typeof WebAssembly === "object" && typeof Worker === "function") begin();
  else say(`This browser has no WebAssembly. ${byId("state").textContent}`, "problem");
}

export { solver, last, busy, setting, waiting };
