/* The gear train: losses by source as bars, over torque, speed and oil; forces and lives of the bearings. */

import { el } from "../../draw.js";
import { ABOUT, shown } from "../dom.js";
import { numbersOf, state } from "../page.js";
import { Plot, headed } from "../plot.js";
import { Scatter, bandOver, bandWords } from "../scatter.js";

const LOSSES = [
  ["all", "loss", "second"],
  ["meshes", "mesh", ""],
  ["churning", "churning", "third"],
  ["bearings", "bearing", "fourth"],
  ["seals", "seal", "fifth"],
];
const FIRST = { mesh: "loss", shaft: "bearing_1_loss" }; // what each of them has that is there
const SAFETIES = ["pitting_safety", "root_safety", "scuffing_safety"];
const COLUMNS = { radial_force: "radial force", axial_force: "axial force", load: "load P", loss: "loss" };
const ROW = 26, // pixels of a bar with its gap
  NAMES = 160, // in front of it
  VALUES = 80; // behind it

/** Return what is lost where [name, W]: each mesh, the bearings of each shaft, seals, churning. */
function sources(outputs) {
  const all = (kind) => [1, 2, 3, 4].filter((i) => Number.isFinite(outputs[`${kind}_${i}_${FIRST[kind]}`]));
  const meshes = all("mesh").map((i) => [`mesh ${i}`, outputs[`mesh_${i}_loss`]]);
  const shafts = all("shaft").map((i) => [
    `bearings of shaft ${i}`,
    [1, 2].reduce((sum, k) => sum + outputs[`shaft_${i}_bearing_${k}_loss`], 0),
  ]);
  return [...meshes, ...shafts, ["seals", outputs.seal_loss], ["churning gears", outputs.churning_loss]];
}
/** Losses as bars: the longest is as wide as there is room. */
class Bars {
  constructor(host) {
    this.svg = el("svg", { role: "img", class: "bars" });
    host.append(headed("Losses by source here", "Formulas"), el("div", { class: "plot" }, this.svg));
    this.rows = [];
    new ResizeObserver(() => this.render()).observe(this.svg.parentNode);
  }

  show(rows) {
    this.rows = rows;
    this.render();
  }

  render() {
    const width = this.svg.parentNode.clientWidth || 600,
      most = Math.max(...this.rows.map(([, value]) => value), 1e-9),
      said = this.rows.map(([name, value]) => `${name} ${shown(value, "W")}`).join(", "),
      room = Math.max(width - NAMES - VALUES, 20);
    this.svg.setAttribute("aria-label", `Losses by source: ${said}`);
    this.svg.setAttribute("viewBox", `0 0 ${width} ${ROW * this.rows.length}`);
    this.svg.replaceChildren(
      ...this.rows.flatMap(([name, value], i) => {
        const long = (Math.max(value, 0) / most) * room,
          y = ROW * i;
        return [
          el("text", { class: "tick", x: NAMES - 8, y: y + 16, "text-anchor": "end" }, name),
          el("rect", { x: NAMES, y: y + 3, width: long, height: ROW - 8, "data-source": name }),
          el("text", { class: "tick", x: NAMES + long + 6, y: y + 16 }, shown(value, "W")),
        ];
      }),
    );
  }
}

export const VIEW = {
  build(host) {
    const panel = (wide) => host.appendChild(el("section", { class: wide ? "panel wide" : "panel" }));
    const part = "Formulas",
      y = { label: "loss", unit: "W", zero: true },
      torque = { label: "torque on the input shaft", unit: "N.m" };
    this.bars = new Bars(panel(true));
    const wide = panel(true);
    this.over = new Plot(wide, { title: "Losses over the torque", part, x: torque, y, height: 320 });
    this.scatter = new Scatter(wide, {
      of: "The band of the loss",
      depends: () => [state.inputs, state.parameters, state.level],
      show: () => this.draw(),
      given: (values) => [numbersOf(values), state.level, ABOUT.inputs.map((s) => values[s.name])],
      told: () => bandWords(["loss", "efficiency", "bearing_life"], this.scatter.sound),
    });
    this.efficiency = new Plot(panel(), {
      title: "Efficiency over the torque",
      part,
      x: torque,
      y: { label: "efficiency", unit: "1" },
    });
    this.fast = new Plot(panel(), {
      title: "Losses over the speed",
      part,
      x: { label: "speed of the input shaft", unit: "rad/s" },
      y,
    });
    this.warm = new Plot(panel(), {
      title: "Losses over the oil's temperature",
      part,
      x: { label: "oil temperature", unit: "K" },
      y,
    });
    this.table = el("tbody");
    const heads = ["bearing", ...Object.values(COLUMNS), "life L10h"];
    panel(true).append(
      headed("Bearings", part),
      el(
        "div",
        { class: "wide-table", tabindex: 0 },
        el(
          "table",
          { id: "bearings" },
          el("thead", {}, el("tr", {}, ...heads.map((text) => el("th", { scope: "col" }, text)))),
          this.table,
        ),
      ),
    );
  },

  /** Say which limits are passed. */
  warning(outputs) {
    const low = SAFETIES.filter((name) => outputs[name] < 1).map(
        (name) => `${name} ${shown(outputs[name], "1")}, below 1`,
      ),
      wanted = state.parameters.required_life;
    if (outputs.bearing_life < wanted)
      low.push(`bearing_life ${shown(outputs.bearing_life, "s")}, below ${shown(wanted, "s")}`);
    return low.map((text) => `${text}; `).join("");
  },

  solved(result, fresh) {
    this.result = result;
    this.draw();
    if (fresh) this.scatter.follow();
  },

  draw() {
    const { torques, speeds, oils, outputs } = this.result,
      { torque, speed, oil_temperature } = state.inputs,
      centre = torques.map((p) => p.torque);
    // a draw's torques are these times what it makes of the torque: points belong together by their place
    const band = bandOver(centre, this.scatter, "all", "scatter-two", (r, i) => r.torques[i].loss);
    const lines = (rows, over) =>
      LOSSES.map(([name, key, look]) => ({ name, look, points: rows.map((p) => [p[over], p[key]]) }));
    const here = (x, value = outputs.loss, unit = "W") => [
      { x, y: value, text: `here: ${shown(value, unit)}`, look: "here" },
    ];
    const at = (kept) => torques.filter(kept).map((p) => [p.torque, p.efficiency]);
    this.bars.show(sources(outputs));
    this.over.show({
      bands: band.bands,
      series: [...band.medians, ...lines(torques, "torque")],
      marks: here(torque),
    });
    this.efficiency.show({
      series: [
        { name: "the input drives", look: "", points: at((p) => p.torque * speed > 0) },
        { name: "the output drives", look: "second", points: at((p) => p.torque * speed < 0) },
      ],
      marks: here(torque, outputs.efficiency, "1"),
    });
    this.fast.show({ series: lines(speeds, "speed"), marks: here(speed) });
    this.warm.show({ series: lines(oils, "temperature"), marks: here(oil_temperature) });
    this.table.replaceChildren(...this.bearings(outputs));
  },

  /** Return a row for each bearing that is there. */
  bearings(outputs) {
    const names = [1, 2, 3, 4].flatMap((i) => [1, 2].map((k) => `shaft_${i}_bearing_${k}`));
    const row = (name) =>
      el(
        "tr",
        {},
        el("th", { scope: "row" }, name.replace("_bearing", ", bearing").replaceAll("_", " ")),
        ...[...Object.keys(COLUMNS), "life"].map((key) =>
          el("td", {}, shown(outputs[`${name}_${key}`], ABOUT.outputs[`${name}_${key}`].unit)),
        ),
      );
    return names.filter((name) => Number.isFinite(outputs[`${name}_loss`])).map(row);
  },
};
