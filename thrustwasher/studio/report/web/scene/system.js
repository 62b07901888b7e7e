/* A scene as connected kernels: the same parts, connections and steps as Python's loop. */

import { commandAt, shiftOf } from "./profile.js";
import { changesOf, figuresOf, wantedUntil } from "./figures.js";
import { number, textOf, writer } from "./quantity.js";
import { failedBecause, ofScene, warningsOf } from "./warnings.js";

const SLICES = 25; // steps between two looks for messages

/** Return what copies numbers of some arrays to places in others: {to, slot, from, place}. */
function copying(links) {
  return () => {
    for (let k = 0; k < links.length; k += 1) {
      const { to, slot, from, place } = links[k];
      to[slot] = from[place];
    }
  };
}

/** One part: its arrays in the kernels' memory, its inputs and outputs. */
class Part {
  /** @type {string} */
  name;
  /** @type {any} */
  given;
  /** @type {any} */
  about;
  /** @type {any} */
  spec;
  /** @type {import("../explore/kernel.js").Kernel} */
  kernel;
  /** @type {Float64Array} */
  par;
  /** @type {Float64Array} */
  inp;
  /** @type {Float64Array} */
  state;
  /** @type {Float64Array} */
  work;
  /** @type {Float64Array} */
  out;
  /** @type {Int32Array} */
  iout;
  /** @type {() => void} */
  give;

  constructor(name, given, kernel, about) {
    Object.assign(this, { name, given, kernel, about, spec: about.models[given.model] });
    const array = (key) => kernel.array(given.sizes[key], key === "iout" ? Int32Array : Float64Array);
    this.arrays = Object.fromEntries(
      ["par", "inp", "state", "work", "out", "iout"].map((key) => [key, array(key)]),
    );
    this.step = kernel.bound("step", ...Object.values(this.arrays));
    this.inputs = new Float64Array(given.inputs.length);
    this.outputs = new Float64Array(given.outputs.length);
    this.allowed = given.inputs.map(([key, slot, low, high, unit]) => ({ key, slot, low, high, unit }));
    this.prepared = null;
    this.give = () => {};
  }

  /** Take the arrays as views, once nothing grows any more. */
  settle() {
    for (const [key, array] of Object.entries(this.arrays)) this[key] = array.view;
    const { out, iout, outputs: to } = this;
    this.give = copying(
      this.given.outputs.map(([, real, place], slot) => ({ to, slot, from: real ? out : iout, place })),
    );
  }

  /** Forget all, take parameters [numbers]; `table`: [place, numbers] that the level looks up in. */
  reset(numbers, table = null) {
    const { given, kernel, arrays } = this;
    if (this.prepared !== numbers) {
      this.par.fill(0);
      this.par.set(numbers);
      const broken =
        this.kernel.functions.broken_rule && this.spec.rules.length
          ? kernel.call("broken_rule", arrays.par)
          : 0;
      if (broken) throw new Error(`${this.name}: ${this.ruleWords(this.spec.rules[broken - 1], numbers)}`);
      const rc = kernel.call("derive", arrays.par);
      if (rc >= this.about.first_failure)
        throw new Error(`${this.name}: the parameters cannot be used: ${this.about.statuses[rc]}`);
      this.prepared = numbers;
    }
    this.state.fill(0);
    this.out.fill(0);
    this.iout.fill(0);
    this.work.fill(0, 0, table ? table[0] : undefined);
    if (table && this.table !== table) this.work.set(table[1], table[0]);
    this.table = table;
    this.inp.set(given.inp);
    given.inputs.forEach(([, slot], i) => (this.inputs[i] = this.inp[slot]));
    this.dirty = true;
  }

  ruleWords(text, numbers) {
    return text.replace(/{(\w+)}/g, (_, name) => String(numbers[this.given.names.indexOf(name)]));
  }

  put(t) {
    const { allowed } = this;
    for (let i = 0; i < allowed.length; i += 1) {
      const { key, slot, low, high, unit } = allowed[i],
        value = this.inputs[i];
      if (!(value >= low && value <= high))
        throw new Error(
          `${this.name} at t = ${number(t, ".9g")} s: ${key} = ${number(value, "g")} ${unit} is outside ${low} .. ${high} ${unit}; the value is not taken over`,
        );
      if (this.inp[slot] !== value) {
        this.inp[slot] = value;
        this.dirty = true;
      }
    }
  }

  solve(t, h) {
    const rc = this.step(t, h);
    let sound = 0;
    for (let i = 0; i < this.out.length; i += 1) sound += 0 * this.out[i];
    if (rc >= this.about.first_failure || sound !== 0)
      throw new Error(
        `${this.name} at t = ${Number(t.toPrecision(9))} s: ${this.about.statuses[rc] ?? "a result is not finite"}`,
      );
    this.dirty = false;
    this.give();
  }

  refresh(t) {
    this.put(t);
    if (this.dirty) this.solve(t, 0);
  }

  advance(t, h) {
    this.put(t);
    this.solve(t, h);
  }
}

/** A part that gives what another run recorded: what belongs to the inputs at a step's start. */
class Recorded {
  /** @type {Float64Array} */
  rows;
  /** @type {number} */
  width;
  /** @type {number[]} */
  last;
  /** @type {number} */
  k;
  /** @type {Float64Array} */
  inputs;
  /** @type {Float64Array} */
  outputs;
  /** @type {string} */
  name;
  /** @type {any} */
  given;

  constructor(part, { rows, moving }) {
    const width = part.outputs.length,
      last = [];
    moving.forEach((is, i) => last.push(i < 2 || is ? i : last[i - 1]));
    Object.assign(this, {
      name: part.name,
      inputs: part.inputs,
      outputs: part.outputs,
      given: part.given,
      rows,
      width,
      last,
      k: 1,
    });
  }

  take(k) {
    this.outputs.set(this.rows.subarray(this.width * this.last[k], this.width * (this.last[k] + 1)));
  }
  refresh() {
    this.take(0);
  }
  advance() {
    this.take(this.k++);
  }
}

/** All parts, connected. */
export class Model {
  /** @type {any} */
  about;
  /** @type {Record<string, any>} */
  changed;

  constructor(kernels, about) {
    Object.assign(this, { about, recorded: about.recorded, changed: {} });
    this.parts = Object.fromEntries(
      Object.entries(about.parts).map(([name, given]) => [
        name,
        new Part(name, given, kernels[given.model], about),
      ]),
    );
    this.hub = this.parts.transmission;
    this.hub.kernel.lent = Array.from({ length: 5 }, () => this.hub.kernel.array(about.time.points));
    for (const part of Object.values(this.parts)) part.settle();
    const { outputs } = this.hub.given,
      place = (name) => outputs.findIndex(([own]) => own === name);
    this.kept = about.signals.map((name) => [`transmission.${name}`, "transmission", place(name)]);
    for (const pack of ["clutch", "brake"]) {
      for (const name of ["temperature", "friction_power"]) {
        this.kept.push([
          `${pack}.${name}`,
          pack,
          about.parts[pack].outputs.findIndex(([own]) => own === name),
        ]);
      }
    }
    const kept = new Set(this.kept.map(([name]) => name));
    this.taken = []; // inputs
    for (const name of about.warnings.watched.filter((own) => !kept.has(own))) {
      const [part, key] = name.split("."),
        find = (list) => list.findIndex(([own]) => own === key),
        output = find(about.parts[part].outputs);
      if (output >= 0) this.kept.push([name, part, output]);
      else this.taken.push([name, part, find(about.parts[part].inputs)]);
    }
  }

  /** Return the parameters of a part in a draw, those of its profiles with them; the same array for the same values. */
  numbers(name, level, profiles, draw) {
    const { about } = this,
      washer = about.washers[name],
      own = level === "map" ? washer.map.numbers : about.parts[name].numbers;
    const changes = [...(draw?.parts[name] ?? [])];
    if (name === "transmission") {
      for (const [profile, { at, factor }] of Object.entries(about.profiles)) {
        const scatter = draw?.profiles[profile],
          points = profiles[profile];
        changes.push([at.count, points.length]);
        for (let i = 0; i < at.times.length; i += 1) {
          const [t, x] = points[i] ?? [0, 0],
            there = i < points.length;
          changes.push([at.times[i], there ? t + (scatter?.times[i] ?? 0) : 0]);
          changes.push([
            at.values[i],
            there ? factor * (scatter?.factor ?? 1) * (x + (scatter?.points[i] ?? 0)) : 0,
          ]);
        }
      }
    }
    if (!changes.length) return own;
    const key = JSON.stringify(changes),
      known = this.changed[name];
    if (known?.key === key) return known.made;
    const made = own.slice();
    for (const [i, x] of changes) made[i] = x;
    this.changed[name] = { key, made };
    return made;
  }

  /** Return what failed and what may have made it fail, as Python's message has it. */
  whyFailed(problem, profiles, run, n) {
    const { about } = this,
      text = ({ pieces }) => textOf(pieces, writer(about.units)),
      reasons = [...failedBecause(run, n).map(text), ...about.warnings.of_scene];
    reasons.push(...ofScene(about, profiles).map(text));
    return [problem.message.replace(/\.$/, ""), ...reasons].join("; ");
  }

  /**
   * Run the scene with profiles {name: points}; `washers`: "map", "recorded", else their own level; `recorded`: of
   * another run, by part, from now on. Return signals, and of washers solved here what they gave.
   */
  *run({ profiles, washers, draw = null, recorded = null }) {
    const { about, hub } = this,
      began = performance.now(),
      { points: n, step: h } = about.time;
    if (recorded) this.recorded = recorded;
    const shift = shiftOf(about, profiles);
    /** @type {Record<string, any>} */
    const parts = { ...this.parts };
    for (const [name, part] of Object.entries(this.parts)) {
      const level = name in about.washers ? washers : "";
      if (level === "recorded") {
        parts[name] = new Recorded(part, this.recorded[name]);
        continue;
      }
      const known = level === "map" ? about.tables[name] : null;
      part.reset(this.numbers(name, level, profiles, draw), known);
    }
    const pulls = Object.fromEntries(
      Object.entries(parts).map(([name, { given, inputs: to }]) => [
        name,
        copying(
          given.sources.map(([slot, source, place]) => ({ to, slot, from: parts[source].outputs, place })),
        ),
      ]),
    );
    const others = Object.keys(parts).filter((name) => name !== "transmission"),
      t0 = about.start_time;
    hub.inputs[about.command] = commandAt(t0, shift);
    hub.refresh(t0);
    for (const name of others) {
      pulls[name]();
      parts[name].refresh(t0);
    }
    for (let sweep = 0; sweep < 4; sweep += 1) {
      pulls.transmission();
      hub.refresh(t0);
      for (const name of others) {
        pulls[name]();
        parts[name].refresh(t0);
      }
    }
    const time = new Float64Array(n),
      signals = Object.fromEntries(
        [...this.kept, ...this.taken].map(([name]) => [name, new Float64Array(n)]),
      );
    const rows = Object.keys(about.washers)
      .filter(() => washers === "")
      .map((name) => {
        const part = parts[name];
        return {
          part,
          rows: new Float64Array(n * part.outputs.length),
          moving: new Uint8Array(n),
          speed: part.given.inputs.findIndex(([own]) => own === "speed"),
        };
      });
    const columns = [
      ...this.kept.map(([name, part, place]) => ({ to: signals[name], from: parts[part].outputs, place })),
      ...this.taken.map(([name, part, place]) => ({ to: signals[name], from: parts[part].inputs, place })),
    ];
    const keep = (i) => {
      for (let k = 0; k < columns.length; k += 1) {
        const { to, from, place } = columns[k];
        to[i] = from[place];
      }
      for (const { part, rows: own, moving, speed } of rows) {
        own.set(part.outputs, i * part.outputs.length);
        moving[i] = Number(part.inputs[speed] !== 0);
      }
    };
    const calls = about.schedule.map(([what, name]) => ({
      pull: what === "pull" ? pulls[name] : null,
      part: parts[name],
    }));
    time[0] = t0;
    keep(0);
    for (let i = 0; i + 1 < n; i += 1) {
      time[i + 1] = t0 + h * (i + 1);
      hub.inputs[about.command] = commandAt(time[i + 1], shift);
      try {
        for (const { pull, part } of calls) {
          if (pull) pull();
          else part.advance(time[i], h);
        }
      } catch (problem) {
        const until = wantedUntil(about, profiles, shift),
          reached = { about, shift, time, signals, until };
        throw new Error(this.whyFailed(/** @type {Error} */ (problem), profiles, reached, i + 1));
      }
      keep(i + 1);
      if (i % SLICES === 0) yield;
    }
    const found = Object.fromEntries(
      rows.map(({ part, rows: own, moving }) => [part.name, { rows: own, moving }]),
    );
    const own = (name) => signals[`transmission.${name}`],
      changes = changesOf(hub.kernel, time, own),
      { flare_time: flareTime, ...figures } = figuresOf(
        hub.kernel,
        about,
        profiles,
        shift,
        time,
        signals,
        changes,
      );
    const until = wantedUntil(about, profiles, shift),
      locks = changes
        .filter(({ kind, time: t }) => kind === `${shift.engaging}_locked` && shift.start <= t && t <= until)
        .map(({ time: t }) => t),
      solved = (name) => washers !== "recorded" || !(name in about.washers),
      maps = Object.values(about.washers).flatMap(({ map }) => map?.boxes ?? []);
    const warnings = draw
      ? []
      : warningsOf({
          ...{ about, profiles, shift, time, signals, changes, locks, until, solved },
          held: figures.lock_time,
          flare: [figures.flare ?? null, flareTime ?? null],
          maps: washers === "map" ? maps : about.warnings.values.maps,
        });
    return {
      warnings,
      time,
      signals,
      shift,
      figures,
      recorded: rows.length ? found : null,
      took: performance.now() - began,
    };
  }
}
