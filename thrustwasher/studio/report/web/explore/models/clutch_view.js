/* The wet clutch: a ramp to draw, and the engagement it makes. */

import { el } from "../../draw.js";
import { ABOUT, digits, shown } from "../dom.js";
import { CHANGES, drawn } from "../draws.js";
import { inputChanged, numbersOf, state } from "../page.js";
import { Plot } from "../plot.js";
import { Scatter, bandOver, bandWords } from "../scatter.js";

export const VIEW = {
  build(host) {
    const panel = (more = "") => host.appendChild(el("section", { class: `panel ${more}` })),
      x = { label: "time", unit: "s" };
    this.reset();
    const wide = panel("wide drawn");
    this.ramp = new Plot(wide, {
      title: "Load over time: drag the points to draw the ramp",
      part: "Torque",
      x,
      y: { label: "load", unit: "N", zero: true },
      height: 260,
      drag: (_, load, i) => this.draw(load, i),
    });
    this.torque = new Plot(panel(), {
      title: "Torque",
      part: "Torque",
      x,
      y: { label: "torque", unit: "N.m", zero: true },
    });
    this.scatter = new Scatter(wide, {
      of: "The band of torque and temperature over the time",
      depends: () => [state.inputs, state.parameters, state.level, state.extra],
      show: () => this.plot(),
      given: (values, k) => [
        numbersOf(values),
        state.level,
        ABOUT.inputs.map((s) => values[s.name]),
        true,
        "",
        { ramp: state.extra.ramp.map((load) => this.drawnLoad(load, k)) },
      ],
      told: () => bandWords(["friction_torque_max", "temperature_max", "energy"], this.scatter.sound),
    });
    this.warm = new Plot(panel(), {
      title: "Interface temperature",
      part: "Heat",
      x,
      y: { label: "temperature", unit: "K" },
    });
    this.film = new Plot(panel(), {
      title: "Film ratio",
      part: "Film",
      x,
      y: { label: "film over roughness", unit: "1", zero: true },
    });
    this.heat = new Plot(panel(), {
      title: "Friction power",
      part: "Heat",
      x,
      y: { label: "power", unit: "W", zero: true },
    });
    this.drawRamp();
  },

  reset() {
    state.extra.ramp = ABOUT.ramp.slice();
    this.most = Math.max(...ABOUT.ramp) * 2 || 1e4;
  },

  get allows() {
    return `${ABOUT.ramp.length} loads in brackets, numbers 0 .. ${digits(ABOUT.largest_load, 6)} in N`;
  },

  checked(_, given) {
    const good =
      Array.isArray(given) &&
      given.length === ABOUT.ramp.length &&
      given.every((f) => typeof f === "number" && f >= 0 && f <= ABOUT.largest_load);
    if (!good) throw new Error("ramp");
    return given;
  },

  draw(load, i) {
    state.extra.ramp[i] = Number(Math.min(Math.max(load, 0), this.most).toPrecision(4));
    this.drawRamp();
    inputChanged();
  },

  drawRamp() {
    const { ramp } = state.extra,
      greatest = Math.max(...ramp),
      n = ramp.length - 1,
      at = (i) => (state.inputs.duration * i) / n;
    if (greatest > this.most) this.most = 1.25 * greatest;
    const points = ramp.map((load, i) => [at(i), load]);
    this.ramp.show({
      series: [{ name: "", look: "", points }],
      span: { y: [0, this.most] },
      handles: points.map(([t, load]) => ({
        x: t,
        y: load,
        label: `load at ${shown(t, "s")}, arrow keys move it`,
        text: shown(load, "N"),
      })),
    });
  },

  drawnLoad(load, k) {
    return CHANGES.filter((c) => c.name === "ramp").reduce(
      (found, c) => drawn(c, k, found, { kind: "real", min: 0, max: ABOUT.largest_load }),
      load,
    );
  },

  solved({ series }, fresh) {
    this.series = series;
    this.drawRamp();
    this.plot();
    if (fresh) this.scatter.follow();
  },

  plot() {
    const { series } = this,
      band = (name, key, look) => bandOver(series.time, this.scatter, name, look, (r, i) => r.series[key][i]);
    const torque = band("friction", "friction_torque", "scatter-one"),
      warm = band("interface", "temperature", "scatter-two");
    const line = (name, key, look, f = (v) => v) => ({
      name,
      look,
      points: series.time.slice(0, series[key].length).map((t, i) => [t, f(series[key][i])]),
    });
    this.torque.show({
      bands: torque.bands,
      series: [
        ...torque.medians,
        line("friction", "friction_torque", ""),
        line("of contact", "contact_torque", "second"),
        line("of the oil's shear", "viscous_torque", "third"),
        line("capacity", "torque_capacity", "fourth"),
      ],
    });
    this.warm.show({ bands: warm.bands, series: [...warm.medians, line("", "temperature", "second")] });
    this.film.show({ series: [line("", "film_ratio", "")] });
    this.heat.show({ series: [line("", "friction_power", "second")] });
  },

  // what the verification tables of this chart verify: see study/reference_clutch.py
  chart: "engagement",
  where:
    "in the engagement of the verification table to this load at this slip (load up in 0.1 s, slip down from 0.2 to 0.6 s, drum at rest; another profile may err more)",

  values({ speed, oil_temperature }) {
    return { load: Math.max(...state.extra.ramp), speed, oil_temperature };
  },

  /** Return the command's options for what was drawn, "" if that is no straight ramp to a level. */
  straight() {
    const { ramp } = state.extra,
      { duration } = state.inputs,
      level = ramp.at(-1),
      n = ramp.length - 1,
      k = ramp.indexOf(level);
    const good = ramp.every((load, i) => Math.abs(load - level * Math.min(k ? i / k : 1, 1)) <= 1e-9 * level);
    return good
      ? `--load ${level} --ramp ${(duration * k) / n} --duration ${duration} --step ${duration / ABOUT.points}`
      : "";
  },

  /** The command knows straight ramps only; the Python lines know what was drawn. */
  reproduced(params, inputs, sets) {
    const { ramp } = state.extra,
      { duration, speed, ...rest } = inputs,
      level = state.level === ABOUT.usual_level ? "" : `, fidelity="${state.level}"`;
    return {
      command: this.straight()
        ? `thrustwasher engage ${this.straight()} --speed ${speed} ${Object.entries(rest)
            .map(([n, v]) => `--${n.replaceAll("_", "-")} ${v}`)
            .join(
              " ",
            )}${state.level === ABOUT.usual_level ? "" : ` --fidelity ${state.level}`} ${sets}`.trim()
        : "The command knows straight ramps only: take the Python lines.",
      python: [
        "import numpy as np",
        "from thrustwasher import ClutchParams, engage_clutch",
        "",
        `time = np.linspace(0.0, ${duration}, ${ABOUT.points + 1})`,
        `load = np.interp(time, np.linspace(0.0, ${duration}, ${ramp.length}), [${ramp.join(", ")}])`,
        `result = engage_clutch(ClutchParams(${params}), time=time, load=load, speed=${speed} * (1 - time / ${duration}),`,
        `    ${Object.entries(rest)
          .map(([n, v]) => `${n}=${v}`)
          .join(", ")}${level})`,
        "print(abs(result.friction_torque).max(), result.temperature.max())",
      ].join("\n"),
    };
  },
};
