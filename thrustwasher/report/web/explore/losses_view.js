"use strict";
/* The driveline losses over the speeds, which change together. */

const VIEW = {
  build(host) {
    const panel = host.appendChild(el("section", { class: "panel wide" })), x = { label: "all speeds over those given", unit: "1" };
    this.heat = new Plot(panel, { title: "Heat by source when all speeds change together", part: "Formulas", x, y: { label: "heat", unit: "W", zero: true }, height: 320 });
    this.scatter = new Scatter(panel, {
      of: "The band of the heat", depends: () => [state.inputs, state.parameters, state.rung], show: () => this.draw(),
      given: (values) => [numbersOf(values), state.rung, ABOUT.inputs.map((s) => values[s.name])],
      told: () => bandWords(["oil_heat", "input_torque"], this.scatter.sound),
    });
  },

  solved(result, fresh) {
    this.result = result;
    this.draw();
    if (fresh) this.scatter.follow();
  },

  draw() {
    const { curve, outputs } = this.result, band = bandOver(curve.map((p) => p.factor), this.scatter, "all", "scatter-two", (r, i) => r.curve[i].oil_heat);
    const line = (name, key, look) => ({ name, look, points: curve.map((p) => [p.factor, p[key]]) });
    this.heat.show({
      bands: band.bands,
      series: [...band.medians, line("all", "oil_heat", "second"), line("pump", "pump_power", ""), line("churning", "churning_power", "third"), line("bearings", "bearing_power", "fourth"), line("seals", "seal_power", "fifth")],
      marks: [{ x: 1, y: outputs.oil_heat, text: `here: ${shown(outputs.oil_heat, "W")}`, look: "here" }],
    });
  },
};
