"use strict";
/* The gear mesh along its path of contact. */

/** Return what a path has at a position, linear between its places; beyond its ends nothing. */
function between(path, key, x) {
  const points = path ? path.position.map((s, k) => [s, path[key][k]]).sort((a, b) => a[0] - b[0]) : [];
  const i = points.findIndex(([s]) => s >= x - 1e-9);
  if (i < 0 || (i === 0 && points[0][0] > x + 1e-9)) return NaN;
  if (i === 0) return points[0][1];
  const [[a, u], [b, v]] = [points[i - 1], points[i]];
  return u + ((v - u) * (x - a)) / (b - a);
}

const VIEW = {
  build(host) {
    const panel = (wide) => host.appendChild(el("section", { class: wide ? "panel wide" : "panel" }));
    const x = { label: "position from the pitch point, in base pitches", unit: "1" }, temperatures = panel(true);
    this.none = temperatures.appendChild(el("p", { class: "folds" }));
    this.warm = new Plot(temperatures, { title: "Temperatures along the path of contact", part: "Heat", x, y: { label: "temperature", unit: "K" }, height: 320 });
    this.scatter = new Scatter(temperatures, {
      of: "The band of flank and scuffing safety along the path", depends: () => [state.inputs, state.parameters, state.rung], show: () => this.draw(),
      given: (values) => [numbersOf(values), state.rung, ABOUT.inputs.map((s) => values[s.name])],
      told: () => bandWords(["surface_temperature", "scuffing_safety", "friction_torque"], this.scatter.sound),
    });
    this.safe = new Plot(panel(), { title: "Safety along the path", part: "Safety", x, y: { label: "safety factor", unit: "1", log: true } });
    this.film = new Plot(panel(), { title: "Film along the path", part: "Geometry and load", x, y: { label: "film thickness", unit: "m", zero: true } });
    this.press = new Plot(panel(), { title: "Hertz pressure along the path", part: "Geometry and load", x, y: { label: "pressure", unit: "Pa", zero: true } });
    this.rub = new Plot(panel(), { title: "Friction along the path", part: "Heat", x, y: { label: "coefficient of friction", unit: "1", zero: true } });
  },

  /** The inputs that the cards know: a torque in place of the power. */
  values({ power, ...rest }) {
    return { ...rest, load: power === 0 ? 0 : Math.abs(power / rest.speed) };
  },

  solved(result, fresh) {
    this.result = result;
    this.draw();
    if (fresh) this.scatter.follow();
  },

  draw() {
    const { path, outputs } = this.result;
    this.none.textContent = path ? `The contact scuffs at ${shown(path.scuffing, "K")}, ${shown(outputs.scuffing_margin, "K", true)} above its hottest place.` : "With film_heat = atan the paper's heat is taken where contact starts: there is nothing along the path.";
    if (!path) return;
    const line = (name, values, look) => ({ name, look, points: path.position.map((s, k) => [s, values[k]]).sort((a, b) => a[0] - b[0]) });
    const level = (name, value, look) => line(name, path.position.map(() => value), look);
    const s = path.position[path.hot], x = path.position.toSorted((a, b) => a - b);
    const band = (name, key) => bandOver(x, this.scatter, name, "scatter-two", (r, i) => between(r.path, key, x[i]));
    const warm = band("flank", "flank"), safe = band("scuffing", "safety");
    this.warm.show({
      bands: warm.bands,
      series: [...warm.medians, line("flank", path.flank, "second"), level("bodies", path.bulk, ""), level("oil", state.inputs.oil_temperature, "fourth")],
      marks: [{ x: s, y: path.flank[path.hot], text: `hottest: ${shown(path.flank[path.hot], "K")}`, look: "here" }],
    });
    this.safe.show({
      bands: safe.bands,
      series: [...safe.medians, line("scuffing", path.safety, "second"), ...(path.micropitting ? [line("micropitting", path.micropitting, "")] : []), level("pitting", outputs.pitting_safety, "fourth"), level("1: at the limit", 1, "third")],
    });
    this.film.show({ series: [line("", path.film, "")] });
    this.press.show({ series: [line("", path.pressure, "")] });
    this.rub.show({ series: [line("", path.friction, "")] });
  },
};
