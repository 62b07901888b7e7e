"use strict";
/* The page: controls, figures, address; what is solved comes from the worker. */

const SETTLE = 180; // ms without a change until the numbers are those of a fresh solve
const byId = (id) => document.getElementById(id);
const state = { inputs: {}, parameters: {}, rung: ABOUT.rung, branch: "", asked: "", extra: {}, strange: "" };
const BRANCHES_ASKED = ["", "film", "contact"], TRUE = ["true", "1"], FALSE = ["false", "0"];
const fields = {}, heard = {};
const view = VIEW;
let worker, quiet = false, busy = false, waiting = null, timer = 0, broken = "", point = null, last = null, count = 0;

/** A number field with its unit, its range, what is wrong with it, and a slider if wanted. */
class Field {
  constructor(about, kept, changed, withSlider) {
    Object.assign(this, { about, kept, changed });
    const { name, unit, help, kind, options } = about, id = `in-${name}`;
    this.error = el("p", { class: "error", id: `${id}-error`, role: "alert" });
    this.more = el("span", { class: "more" });
    const common = { id, name, "aria-describedby": `${id}-error` };
    if (kind === "enumeration") {
      this.input = el("select", common, ...Object.entries(options).map(([key, text]) => el("option", { value: key, title: text }, key)));
    } else if (kind === "boolean") this.input = el("input", { ...common, type: "checkbox" });
    else this.input = el("input", { ...common, inputmode: "decimal", autocomplete: "off", spellcheck: "false" });
    this.input.addEventListener("input", () => this.take(kind === "boolean" ? this.input.checked : this.input.value));
    const line = el("div", { class: "line" }, this.input, el("span", { class: "unit" }, unit === "1" ? "" : pretty(unit)), this.more);
    this.box = el("div", { class: "field" }, el("label", { for: id }, help, el("code", {}, name)), line, this.error);
    if (withSlider) {
      this.slider = el("input", { type: "range", min: 0, max: 1000, step: "any", "aria-label": `${help}, slider`, id: `${id}-slider` });
      this.slider.addEventListener("input", () => this.take(this.valueAt(Number(this.slider.value) / 1000), this.slider));
      line.after(this.slider);
    }
    this.put(kept[name]);
  }

  get log() { return this.about.from > 0 && this.about.to / this.about.from > 50; }

  valueAt(share) {
    const { from, to, kind } = this.about;
    const value = this.log ? from * (to / from) ** share : from + (to - from) * share;
    return kind === "integer" ? Math.round(value) : Number(value.toPrecision(4));
  }

  /** Take what was given if it is allowed; else mark it, the last good value stays. */
  take(given, from = this.input) {
    const { name, unit, kind, min, max, options } = this.about;
    let value = given, good = true;
    if (kind === "enumeration") good = Object.hasOwn(options, given);
    else if (kind === "boolean") [value, good] = [TRUE.includes(String(given)), [...TRUE, ...FALSE].includes(String(given))];
    else {
      value = String(given).trim() === "" ? NaN : Number(given);
      good = value >= min && value <= max && (kind !== "integer" || Number.isInteger(value));
    }
    this.input.setAttribute("aria-invalid", String(!good));
    const words = kind === "enumeration" ? Object.keys(options).join(" or ") : kind === "boolean" ? "true or false" : allowed(this.about);
    this.error.textContent = good ? "" : `${name} = ${given}${unit === "1" ? "" : ` ${pretty(unit)}`}, allowed: ${words}`;
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
      this.slider.setAttribute("aria-valuetext", shown(value, unit, relative));
      const text = unit === "1" ? "" : unit === "rad/s" ? `${digits((value * 30) / Math.PI)} rpm` : shown(value, unit, relative);
      this.more.textContent = text;
    }
  }

  set(value) {
    this.kept[this.about.name] = value;
    this.input.setAttribute("aria-invalid", "false");
    this.error.textContent = "";
    this.put(value);
  }
}

// The worker

function ask(task, given, answer) {
  heard[task] = { id: (count += 1), answer };
  worker.postMessage({ id: count, task, ...given });
}

function answered({ data }) {
  const about = heard[data.task];
  if (!about || about.id !== data.id) return;
  about.answer(data.result, data.problem);
}

/** Have the worker take the parameters; tell which rule they break. */
function setParameters(then) {
  const numbers = ABOUT.parameters.map((f) => {
    const value = state.parameters[f.name];
    return f.kind === "enumeration" ? Object.keys(f.options).indexOf(value) + 1 : Number(value);
  });
  ask("set", { parameters: numbers, rung: state.rung }, (number, problem) => {
    broken = problem ?? (number > 0 ? ABOUT.rules[number - 1].replace(/{(\w+)}/g, (_, n) => state.parameters[n])
      : number < 0 ? "these parameters cannot be used together" : "");
    if (broken) say(broken, "problem"); else then();
  });
}

/** Solve; only the newest wish waits while one is being solved. */
function solve(fresh) {
  if (broken) return;
  if (busy) {
    waiting = { fresh };
    return;
  }
  busy = true;
  point = ABOUT.inputs.map((s) => state.inputs[s.name]);
  // the branch that the address names, else the one where the last solution is
  const began = performance.now(), { asked, extra } = state, branch = asked || (last?.outputs.branch ?? "");
  ask("solve", { point, fresh, branch, extra }, (result, problem) => {
    busy = false;
    if (fresh) state.asked = "";
    if (problem) say(problem, "problem");
    else received(result, fresh, performance.now() - began, result.missing ? asked : "");
    if (waiting) {
      const wish = waiting;
      waiting = null;
      solve(wish.fresh);
    }
  });
}

function say(text, look = "") {
  const place = byId("state");
  if (place.textContent !== text || place.className !== look) {
    place.textContent = text;
    place.className = look;
  }
}

function received(result, fresh, took, gone) {
  const failed = result.code >= ABOUT.worker.first_failure;
  if (failed) {
    say(`No solution: ${ABOUT.worker.statuses[result.code]}. The figures are ${last ? "the last ones found" : "those of the start"}.`, "problem");
    return;
  }
  last = { ...result, point: point.slice() };
  reveal(".live");
  for (const [name, value] of Object.entries(result.outputs)) show(name, value);
  const missing = gone ? `The ${gone} branch has no solution here; this is the ${result.outputs.branch} branch. ` : "";
  const advice = result.code ? `${ABOUT.worker.statuses[result.code]}; ` : "";
  if (fresh) {
    say(`${state.strange}${missing}${advice}solved in ${digits(took, 2)} ms; ${told()}`, state.strange || missing || result.code ? "problem" : "");
    state.strange = "";
  }
  view.solved(result, fresh);
  if (fresh) {
    state.branch = result.asked ? result.outputs.branch : "";
    settled();
  }
  document.documentElement.dataset.solved = String(Number(document.documentElement.dataset.solved ?? 0) + 1);
}

/** Put a figure into its places. */
function show(name, value) {
  const place = byId(name), about = ABOUT.outputs[name];
  if (!place || !about) return;
  place.setAttribute("value", String(value));
  const words = about.options ? about.options[value - 1] : about.kind === "boolean" ? (value ? "yes" : "no") : value;
  place.textContent = typeof words === "number" ? shown(words, about.unit, about.relative) : words;
  if (name === "distress") place.className = value ? "bad" : "";
}

// What is known of the error

function cellOf(edges, value) {
  if (!(value >= edges[0] && value <= edges.at(-1))) return -1;
  return Math.min(edges.filter((e) => value >= e).length - 1, edges.length - 2);
}

/** Return the error that a card promises here, null outside its box; as Python's error_estimate. */
function errorOf(card, values, ratio) {
  const size = (name) => (card.envelope[name].min >= 0 ? Math.abs(values[name]) : values[name]);
  const inside = Object.entries(card.envelope).every(([n, a]) => n in values && size(n) >= a.min && size(n) <= a.max);
  if (!inside) return null;
  const [i, j] = card.axes.map((name, k) => cellOf(card.edges[k], size(name))), near = [];
  if (i < 0 || j < 0) return null;
  const reach = card.n[i][j] >= ABOUT.few ? 0 : 1;
  for (let a = i - reach; a <= i + reach; a += 1) {
    for (let b = j - reach; b <= j + reach; b += 1) if (Number.isFinite(card.worst[a]?.[b])) near.push(card.worst[a][b]);
  }
  if (!near.length) return null;
  let found = Math.max(...near);
  if (card.by && ratio !== undefined) found = Math.min(found, card.by.worst[card.by.edges.filter((e) => ratio >= e).length]);
  return Math.max(found, card.uncertainty);
}

/** Say rung and verified error. */
function told() {
  const { rung } = state, values = view.values?.(state.inputs) ?? state.inputs, out = last.outputs;
  const cards = ABOUT.cards.filter((c) => c.fidelity === rung && (!c.branch || c.branch === out.branch) && (!view.chart || c.chart === view.chart));
  const same = changes(ABOUT.given).length === 0, found = cards.map((c) => errorOf(c, values, out.film_ratio)).filter((e) => e !== null);
  const words = `rung ${rung} (${ABOUT.rungs[rung]})`;
  if (!same) return `${words}; no error is verified for changed parameters`;
  if (!found.length) return `${words}; no error is verified at this point`;
  const percent = 100 * ABOUT.safety * Math.max(...found);
  return `${words}; verified error of the torque ${view.where ?? "here"}: ${percent < 1e-3 ? "below 0.001" : `at most ${digits(percent, 2)}`} %`;
}

// Address and how to reproduce

/** Return the parameters that differ from some values. */
function changes(from) {
  return ABOUT.parameters.filter((f) => state.parameters[f.name] !== from[f.name]).map((f) => [f.name, state.parameters[f.name]]);
}

function settled() {
  const pairs = [...Object.entries(state.inputs), ...changes(ABOUT.given)];
  if (state.rung !== ABOUT.rung) pairs.push(["fidelity", state.rung]);
  if (state.branch) pairs.push(["branch", state.branch]);
  for (const [name, value] of Object.entries(state.extra)) pairs.push([name, JSON.stringify(value)]);
  const text = `#${pairs.map(([n, v]) => `${n}=${encodeURIComponent(v)}`).join("&")}`;
  if (text !== location.hash) history.replaceState(null, "", text);
  const { command, python, part } = reproduced();
  byId("as-command").textContent = command;
  byId("as-python").textContent = python;
  byId("as-part").textContent = part;
  document.documentElement.dataset.settled = text;
}

/** Return the command, the Python lines and the part file that give the same figures. */
function reproduced() {
  const changed = changes(ABOUT.defaults), { key, name, python } = ABOUT, rung = state.rung;
  const inputs = Object.entries(state.inputs), { solve, params } = python;
  const literal = (v) => (typeof v === "string" ? `"${v}"` : v === true ? "True" : v === false ? "False" : v);
  const more = [];
  if (rung !== ABOUT.usual_rung) more.push(["fidelity", rung]);
  if (state.branch) more.push(["branch", state.branch]);
  const options = [...inputs, ...more].map(([n, v]) => `--${n.replaceAll("_", "-")} ${v}`);
  const sets = changed.map(([n, v]) => `--set ${n}=${v}`), given = changed.map(([n, v]) => `${n}=${literal(v)}`).join(", ");
  const values = [...inputs, ...more].map(([n, v]) => `${n}=${literal(v)}`).join(", ");
  const own = view.reproduced?.(given, state.inputs, sets.join(" ")) ?? {};
  return {
    command: `thrustwasher ${key} ${[...options, ...sets].join(" ")}`,
    python: `from thrustwasher import ${params}, ${solve}\n\nparams = ${params}(${given})\nresult = ${solve}(params, ${values})\nprint(result.friction_torque)`,
    part: `model = "${key}"\nname = "${name}"\nfidelity = "${rung}"\n\n[parameters]\n${changed.map(([n, v]) => `${n} = ${JSON.stringify(v)}`).join("\n")}`,
    ...own,
  };
}

/** Take what the address names; what cannot be taken is told, all else stays as it is. */
function readAddress() {
  const words = new Map(location.hash.slice(1).split("&").filter(Boolean).map((w) => {
    const [name, ...rest] = w.split("=");
    try {
      return [name, decodeURIComponent(rest.join("="))];
    } catch {
      return [name, rest.join("=")];
    }
  }));
  for (const f of ABOUT.parameters) if (!words.has(f.name)) fields[f.name].set(ABOUT.given[f.name]);
  for (const s of ABOUT.inputs) if (!words.has(s.name)) fields[s.name].set(words.size ? state.inputs[s.name] : s.value);
  if (words.size === 0) view.reset?.();
  const strange = [];
  quiet = true;
  for (const [name, text] of words) {
    if (Object.hasOwn(fields, name)) {
      if (!fields[name].take(text, null)) strange.push(fields[name].error.textContent);
    } else if (name === "branch") {
      if (!BRANCHES_ASKED.includes(text)) strange.push(`branch = ${text}, allowed: film or contact`);
    } else if (name === "fidelity") {
      if (!Object.hasOwn(ABOUT.worker.rungs, text)) strange.push(`fidelity = ${text}, allowed: ${Object.keys(ABOUT.worker.rungs).join(" or ")}`);
    } else if (Object.hasOwn(state.extra, name)) {
      try {
        state.extra[name] = view.checked(name, JSON.parse(text));
      } catch {
        strange.push(`${name}, allowed: ${view.allows}`);
      }
    } else strange.push(`${name} is nothing that this page knows`);
  }
  quiet = false;
  const branch = words.get("branch") ?? "", rung = words.get("fidelity") ?? ABOUT.rung;
  state.asked = BRANCHES_ASKED.includes(branch) ? branch : "";
  if (Object.hasOwn(ABOUT.worker.rungs, rung)) state.rung = byId("fidelity").value = rung;
  state.strange = strange.length ? `The address: ${strange.join("; ")}. ` : "";
}

// From a change to numbers

function later() {
  clearTimeout(timer);
  timer = setTimeout(() => solve(true), SETTLE);
}

function inputChanged() {
  if (quiet) return;
  if (view.live !== false) solve(false);
  later();
}

function parametersChanged() {
  if (quiet) return;
  setParameters(() => solve(true));
}

function builtControls() {
  const inputs = byId("inputs"), main = byId("main-parameters"), all = byId("all-parameters");
  for (const s of ABOUT.inputs) {
    state.inputs[s.name] = s.value;
    fields[s.name] = new Field(s, state.inputs, inputChanged, true);
    inputs.append(fields[s.name].box);
  }
  for (const f of ABOUT.parameters) {
    state.parameters[f.name] = ABOUT.given[f.name];
    const isMain = ABOUT.main.includes(f.name);
    fields[f.name] = new Field(f, state.parameters, parametersChanged, isMain && f.kind !== "enumeration" && f.kind !== "boolean");
    (isMain ? main : all).append(fields[f.name].box);
  }
  const rungs = el("select", { id: "fidelity" }, ...Object.keys(ABOUT.worker.rungs).map((r) => el("option", { value: r, title: ABOUT.rungs[r] }, r)));
  rungs.value = state.rung;
  rungs.addEventListener("change", () => { state.rung = rungs.value; parametersChanged(); });
  main.prepend(el("div", { class: "field" }, el("label", { for: "fidelity" }, "rung: mesh and laws", el("code", {}, "fidelity")), rungs));
  byId("reset").addEventListener("click", () => { location.hash = ""; });
  for (const button of document.querySelectorAll("button[data-copy]")) {
    button.addEventListener("click", () => copyText(byId(button.dataset.copy)));
  }
}

function copyText(place) {
  getSelection().selectAllChildren(place);
  navigator.clipboard?.writeText(place.textContent).catch(() => {});
}

function restart() {
  readAddress();
  setParameters(() => solve(true));
}

/** Show the live part; with the first solution the still one goes. */
function reveal(which) {
  for (const part of document.querySelectorAll(which)) part.hidden = false;
  byId("still").hidden = last !== null;
}

function begin() {
  const source = byId("worker").textContent, bytes = Uint8Array.from(atob(byId("module").textContent.trim()), (c) => c.charCodeAt(0));
  const still = byId("state").textContent;
  worker = new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
  worker.onmessage = answered;
  worker.onerror = (problem) => say(`The computation stopped: ${problem.message}. ${last ? "The figures are the last ones found." : still}`, "problem");
  ask("begin", { about: ABOUT.worker, bytes }, (_, problem) => {
    if (problem) {
      say(`This browser cannot run the kernels: ${problem}. ${still}`, "problem");
      return;
    }
    builtControls();
    view.build(byId("views"));
    reveal("#controls");
    restart();
    addEventListener("hashchange", () => {
      if (location.hash !== document.documentElement.dataset.settled) restart();
    });
  });
}

if (typeof WebAssembly === "object" && typeof Worker === "function") begin();
else say(`This browser has no WebAssembly. ${byId("state").textContent}`, "problem");
