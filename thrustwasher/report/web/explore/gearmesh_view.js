"use strict";
/* The gear mesh along its path of contact. */

const VIEW = {
  build(host) {
    const panel = (wide) => host.appendChild(el("section", { class: wide ? "panel wide" : "panel" }));
    const x = { label: "position from the pitch point, in base pitches", unit: "1" }, temperatures = panel(true);
    this.none = temperatures.appendChild(el("p", { class: "folds" }));
    this.warm = new Plot(temperatures, { title: "Temperatures along the path of contact", part: "Heat", x, y: { label: "temperature", unit: "K" }, height: 320 });
    this.safe = new Plot(panel(), { title: "Safety along the path", part: "Safety", x, y: { label: "safety factor", unit: "1", log: true } });
    this.film = new Plot(panel(), { title: "Film along the path", part: "Geometry and load", x, y: { label: "film thickness", unit: "m", zero: true } });
    this.press = new Plot(panel(), { title: "Hertz pressure along the path", part: "Geometry and load", x, y: { label: "pressure", unit: "Pa", zero: true } });
    this.rub = new Plot(panel(), { title: "Friction along the path", part: "Heat", x, y: { label: "coefficient of friction", unit: "1", zero: true } });
  },

  /** The inputs that the cards know: a torque in place of the power. */
  values({ power, ...rest }) {
    return { ...rest, load: power === 0 ? 0 : Math.abs(power / rest.speed) };
  },

  solved({ path, outputs }) {
    this.none.textContent = path ? `The contact scuffs at ${shown(path.scuffing, "K")}, ${shown(outputs.scuffing_margin, "K", true)} above its hottest place.` : "With film_heat = atan the paper's heat is taken where contact starts: there is nothing along the path.";
    if (!path) return;
    const line = (name, values, look) => ({ name, look, points: path.position.map((s, k) => [s, values[k]]).sort((a, b) => a[0] - b[0]) });
    const level = (name, value, look) => line(name, path.position.map(() => value), look);
    const s = path.position[path.hot];
    this.warm.show({
      series: [line("flank", path.flank, "second"), level("bodies", path.bulk, ""), level("oil", state.inputs.oil_temperature, "fourth")],
      marks: [{ x: s, y: path.flank[path.hot], text: `hottest: ${shown(path.flank[path.hot], "K")}`, look: "here" }],
    });
    this.safe.show({
      series: [line("scuffing", path.safety, "second"), ...(path.micropitting ? [line("micropitting", path.micropitting, "")] : []), level("pitting", outputs.pitting_safety, "fourth"), level("1: at the limit", 1, "third")],
    });
    this.film.show({ series: [line("", path.film, "")] });
    this.press.show({ series: [line("", path.pressure, "")] });
    this.rub.show({ series: [line("", path.friction, "")] });
  },
};
