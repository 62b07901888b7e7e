/* The driveline losses over the speeds, which change together, and over the oil's temperature. */

import { el } from "../../draw.js";
import { ABOUT, shown } from "../dom.js";
import { numbersOf, state } from "../page.js";
import { Plot } from "../plot.js";
import { Scatter, bandOver, bandWords } from "../scatter.js";

const HEATS = [
  ["all", "oil_heat", "second"],
  ["pump", "pump_power", ""],
  ["churning", "churning_power", "third"],
  ["bearings", "bearing_power", "fourth"],
  ["seals", "seal_power", "fifth"],
];
const TORQUES = [
  ["input", "input_torque", ""],
  ["output", "output_torque", "second"],
  ["drum", "drum_torque", "third"],
  ["one planet", "planet_torque", "fourth"],
];

export const VIEW = {
  build(host) {
    const panel = (wide) => host.appendChild(el("section", { class: wide ? "panel wide" : "panel" }));
    const part = "Formulas",
      x = { label: "all speeds over those given", unit: "1" },
      y = { label: "heat", unit: "W", zero: true },
      wide = panel(true);
    this.heat = new Plot(wide, {
      title: "Heat by source when all speeds change together",
      part,
      x,
      y,
      height: 320,
    });
    this.scatter = new Scatter(wide, {
      of: "The band of the heat",
      depends: () => [state.inputs, state.parameters, state.level],
      show: () => this.draw(),
      given: (values) => [numbersOf(values), state.level, ABOUT.inputs.map((s) => values[s.name])],
      told: () => bandWords(["oil_heat", "input_torque"], this.scatter.sound),
    });
    this.warm = new Plot(panel(), {
      title: "Heat over the oil's temperature",
      part,
      x: { label: "oil temperature", unit: "K" },
      y,
    });
    this.torque = new Plot(panel(), {
      title: "Torques against the motion",
      part,
      x,
      y: { label: "torque", unit: "N.m", zero: true },
    });
  },

  solved(result, fresh) {
    this.result = result;
    this.draw();
    if (fresh) this.scatter.follow();
  },

  draw() {
    const { curve, warm, outputs } = this.result,
      band = bandOver(
        curve.map((p) => p.factor),
        this.scatter,
        "all",
        "scatter-two",
        (r, i) => r.curve[i].oil_heat,
      );
    const lines = (rows, over, kinds) =>
      kinds.map(([name, key, look]) => ({ name, look, points: rows.map((p) => [p[over], p[key]]) }));
    const here = (x) => [
      { x, y: outputs.oil_heat, text: `here: ${shown(outputs.oil_heat, "W")}`, look: "here" },
    ];
    this.heat.show({
      bands: band.bands,
      series: [...band.medians, ...lines(curve, "factor", HEATS)],
      marks: here(1),
    });
    this.warm.show({ series: lines(warm, "oil", HEATS), marks: here(state.inputs.oil_temperature) });
    this.torque.show({ series: lines(curve, "factor", TORQUES) });
  },
};
