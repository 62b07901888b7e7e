/* The washer: load curve with a point to drag, discs, Stribeck curve. */

import { Disc, el, pixelsOf } from "../../draw.js";
import { ABOUT, SHARES, digits, pretty, quantiles, shown } from "../dom.js";
import { CHANGES, drawn } from "../draws.js";
import { ask, fields, last, numbersOf, state } from "../page.js";
import { Plot, headed } from "../plot.js";
import { Scatter } from "../scatter.js";

const SCALES = {
  film_thickness: ["film thickness", "m", "um"],
  pressure: ["film pressure", "Pa", "MPa"],
  contact_pressure: ["asperity pressure", "Pa", "MPa"],
  carrier_temperature: ["temperature of the carrier", "K", "degC"],
};
const BRANCHES = { film: "film branch", unstable: "unstable: never stays here", contact: "contact branch" };
const FOLDS = { film_lost: "film lost", film_regained: "film regained" };
const { loads: LOADS, speeds: SPEEDS } = ABOUT; // N, of the scatter and the curve; rad/s
const ENDS = [LOADS[0], LOADS.at(-1)];
const LOADS_IN_WORDS = ENDS.map((load) => shown(load, "N", false, 3)).join(" .. ");
const WAYS = { up: "load up", down: "load down" },
  LOOK = { up: "scatter-one", down: "scatter-two" };
const drawnLoad = (load, k) =>
  CHANGES.filter((c) => c.name === "load").reduce((found, c) => drawn(c, k, found, ABOUT.inputs[0]), load);

export const VIEW = {
  quantity: "friction_torque",
  curve: /** @type {any} */ (null),
  stribeck: /** @type {any} */ (null),
  trail: /** @type {any[]} */ ([]),
  known: "",
  knownLoad: "",
  over: { oil_outlet_temperature: "oil_flow" },

  warning: ({ stick_margin }) =>
    stick_margin < 1 ? `${ABOUT.slips.replace(/{.*}/, digits(stick_margin, 2))}; ` : "",

  build(host) {
    const about = (name) => ABOUT.outputs[name],
      names = [
        "friction_torque",
        "friction_coefficient",
        "temperature",
        "temperature_max",
        "film_ratio",
        "film_thickness",
      ];
    const choose = el(
      "select",
      { id: "curve-quantity", "aria-label": "quantity over the load" },
      ...names.map((n) => el("option", { value: n }, about(n).help)),
    );
    choose.addEventListener("change", () => {
      this.quantity = choose.value;
      this.drawCurve();
      this.scatter.say();
    });
    const curve = el("section", { class: "panel wide" }, el("div", { class: "choose" }, choose)),
      discs = el("section", { class: "panel" }, headed("Over the washer", "Film")),
      other = el("section", { class: "panel" });
    const all = el("div", { class: "discs" });
    discs.append(all);
    host.append(curve, discs, other);
    const drag = (load) =>
      fields.load.take(
        Number(Math.min(Math.max(load, ABOUT.inputs[0].min), ABOUT.inputs[0].max).toPrecision(5)),
        null,
      );
    this.plot = new Plot(curve, {
      title: "Load curve: drag the point over the fold",
      part: "Branches",
      drag,
      x: { label: "load", unit: "N", log: true },
      y: { label: "", unit: "N.m" },
      height: 340,
    });
    curve.append((this.folds = el("p", { class: "folds" })));
    this.scatter = new Scatter(curve, {
      of: "The band over the load",
      show: () => this.drawCurve(),
      told: () => this.scatterWords(),
      lacks: ({ up }) => up.length < LOADS.length || up.includes(null),
      depends: () => [{ ...state.inputs, load: 0 }, state.parameters, state.level],
      given: (values, k) => [
        numbersOf(values),
        state.level,
        ABOUT.inputs.map((s) => values[s.name]),
        LOADS.map((load) => drawnLoad(load, k)),
      ],
    });
    this.numbers = curve.appendChild(
      el(
        "details",
        { hidden: true, id: "scatter-numbers" },
        el("summary", {}, "the band in numbers"),
        el("div", { class: "wide-table", tabindex: 0 }),
      ),
    );
    this.discs = Object.entries(SCALES).map(([name, [title, unit, own]]) => {
      const [factor, offset] = ABOUT.scales[unit][own];
      return [
        name,
        new Disc(all, { name, title, tell: (v) => `${digits((v - offset) / factor, 3)} ${pretty(own)}` }),
      ];
    });
    this.other = new Plot(other, {
      title: "Stribeck curve at this load",
      part: "Contact",
      x: { label: "speed", unit: "rad/s", log: true },
      y: { label: "coefficient of friction", unit: "1", zero: true },
    });
    other.append((this.wait = el("p", { class: "folds", role: "status" })));
  },

  solved(result, fresh) {
    const { outputs, fields: at } = result;
    this.trail.push([last.point[0], { ...outputs }]);
    if (this.trail.length > 400) this.trail.shift();
    const mesh = `${at.radius.join()} ${at.angle.length}`;
    if (mesh !== this.mesh) [this.mesh, this.pixels] = [mesh, pixelsOf(at.radius, at.angle)];
    if (!this.drawing) {
      this.drawing = requestAnimationFrame(() => {
        this.drawing = 0;
        for (const [name, disc] of this.discs) disc.show(this.fields[name], this.pixels, last.point[1]);
        this.drawCurve();
      });
    }
    this.fields = at;
    if (!fresh) return;
    this.askCurves();
    this.scatter.follow();
    this.scatter.say();
  },

  askCurves() {
    const own = JSON.stringify([last.point.slice(1), state.parameters, state.level]);
    if (own !== this.known) {
      this.known = own;
      this.trail = [];
      const began = performance.now();
      this.folds.textContent = "Computing the load curve …";
      ask("curve", { given: [last.point, ...ENDS] }, (found, problem) => {
        this.curve = found ?? null;
        this.took = performance.now() - began;
        this.folds.replaceChildren(...this.foldWords(problem));
        this.drawCurve();
      });
    }
    const load = JSON.stringify([last.point[0], own]);
    if (load !== this.knownLoad) {
      this.knownLoad = load;
      this.wait.textContent = "Computing the Stribeck curve …";
      ask("stribeck", { given: [last.point, SPEEDS] }, (found, problem) => {
        this.wait.textContent = problem ? `The Stribeck curve is not known here: ${problem}.` : "";
        this.stribeck = found ?? null;
        this.drawStribeck();
      });
    }
  },

  foldWords(problem) {
    if (problem) return [`The load curve is not known here: ${problem}.`];
    if (!this.curve.folds.length) return [`No fold from ${LOADS_IN_WORDS}: one solution at every load.`];
    const found = [];
    for (const fold of this.curve.folds) {
      found.push(
        found.length ? "; " : "",
        `${FOLDS[fold.kind]} at `,
        el("data", { id: `${fold.kind}_load`, value: fold.load }, shown(fold.load, "N")),
      );
    }
    return [
      ...found,
      `. Load up: the film holds to the first; load down: it comes back at the second. Curve in ${digits(this.took / 1000, 2)} s.`,
    ];
  },

  drawCurve() {
    const { quantity } = this,
      about = ABOUT.outputs[quantity],
      series = [],
      marks = [];
    this.plot.y = { label: quantity.replaceAll("_", " "), unit: about.unit, log: about.unit !== "K" };
    const size = (v) => this.size(v),
      { bands, medians, strip } = this.scatterShown();
    series.push(...medians);
    if (this.curve) {
      let run = [];
      this.curve.points.forEach((p, i, all) => {
        run.push([p.load, size(p[quantity])]);
        const following = all[i + 1];
        if (!following || following.branch !== p.branch) {
          const fold =
            following &&
            this.curve.folds.find((f) => f.film_ratio <= p.film_ratio && f.film_ratio > following.film_ratio);
          if (fold) run.push([fold.load, size(fold[quantity])]);
          series.push({ name: BRANCHES[p.branch], points: run, look: `branch-${p.branch}` });
          run = fold ? [[fold.load, size(fold[quantity])]] : [];
        }
      });
      for (const f of this.curve.folds)
        marks.push({
          x: f.load,
          y: size(f[quantity]),
          text: `${FOLDS[f.kind]}, ${shown(f.load, "N")}`,
          brief: shown(f.load, "N"),
          left: f.kind === "film_regained",
          below: (about.unit !== "K") === (f.kind === "film_lost"),
        });
    }
    if (this.trail.length > 1)
      series.push({
        name: "where it has been",
        points: this.trail.map(([load, o]) => [load, size(o[quantity])]),
        look: "trail",
      });
    const y = size(last.outputs[quantity]);
    this.plot.show({
      series,
      bands,
      strip,
      marks,
      handles: [
        {
          x: last.point[0],
          y,
          label: "load, arrow keys move it",
          text: `${shown(last.point[0], "N")}, ${shown(y, about.unit)}, ${BRANCHES[last.outputs.branch]}`,
        },
      ],
    });
  },

  size(v) {
    return this.quantity === "friction_torque" ? Math.abs(v) : v;
  },

  /**
   * Return rows of the scatter by load: quantiles of the quantity and the share of draws on branch contact, as the load
   * goes up or down; down only where that is another solution in some draw, and one load to either side.
   */
  scatterRows() {
    const { sound } = this.scatter,
      differs = (i) => sound.some(({ down }) => down[i]);
    const at = (found) => ({
      quantiles: quantiles(found.map((o) => this.size(o[this.quantity]))),
      lost: found.filter((o) => o.branch === "contact").length / found.length,
    });
    if (sound.length < 2) return [];
    return this.scatter.once(this.quantity, () =>
      LOADS.map((load, i) => ({
        load,
        up: at(sound.map(({ up }) => up[i]).filter(Boolean)),
        down:
          differs(i - 1) || differs(i) || differs(i + 1)
            ? at(sound.map(({ up, down }) => down[i] ?? up[i]).filter(Boolean))
            : null,
      })),
    );
  },

  /** Return the scatter as bands, medians and a strip of the plot; the two ways of the load apart. */
  scatterShown() {
    this.numbers.hidden = !this.scatter.on || !this.scatter.complete;
    if (!this.scatter.on || !this.scatter.found.length) return { bands: [], medians: [], strip: null };
    const rows = this.scatterRows(),
      bands = [],
      medians = [],
      areas = [],
      { stale } = this.scatter;
    for (const [way, words] of Object.entries(WAYS)) {
      const there = rows.filter((row) => row[way]),
        look = `${LOOK[way]}${stale ? " stale" : ""}`;
      if (!there.length) continue;
      bands.push({
        name: `${words}: 5 to 95 % of the draws`,
        look,
        points: there.map((row) => [row.load, row[way].quantiles[0], row[way].quantiles[2]]),
      });
      medians.push({
        name: `median, ${words}`,
        look: `median ${look}`,
        points: there.map((row) => [row.load, row[way].quantiles[1]]),
      });
      areas.push({ look, points: there.map((row) => [row.load, row[way].lost]) });
    }
    return { bands, medians, strip: { label: "film lost, share of the draws", areas } };
  },

  /** Say what the band is at the load of the scatter that is nearest, and put all into a table. */
  scatterWords() {
    const about = ABOUT.outputs[this.quantity],
      rows = this.scatterRows(),
      tell = (v) => shown(v, about.unit, about.relative, 3);
    const percent = (v) => `${digits(100 * v, 2)} %`,
      cell = (v, text) => el("td", {}, el("data", { value: v }, text));
    const heads = ["load", "way", "5 %", "50 %", "95 %", "film lost"].map((text) =>
      el("th", { scope: "col" }, text),
    );
    const lines = rows.flatMap((row) =>
      Object.keys(WAYS)
        .filter((way) => row[way])
        .map((way) =>
          el(
            "tr",
            { "data-way": way },
            cell(row.load, shown(row.load, "N", false, 3)),
            el("td", {}, WAYS[way]),
            ...row[way].quantiles.map((v) => cell(v, tell(v))),
            cell(row[way].lost, percent(row[way].lost)),
          ),
        ),
    );
    this.numbers.lastChild.replaceChildren(
      el("table", {}, el("thead", {}, el("tr", {}, ...heads)), el("tbody", {}, ...lines)),
    );
    const load = last.point[0],
      i = LOADS.findIndex((f) => f >= load),
      [below, above] = [rows[i - 1], rows[i]];
    if (!above || !(below ?? LOADS[0] === load)) return `The band goes over ${LOADS_IN_WORDS}.`;
    const t = below ? Math.log(load / below.load) / Math.log(above.load / below.load) : 1,
      between = (way, f) => (below ? (1 - t) * f(below[way]) : 0) + t * f(above[way]);
    const one = (way) => {
      const [low, middle, high] = SHARES.map((_, n) => tell(between(way, (at) => at.quantiles[n])));
      return `${WAYS[way]}: ${low} .. ${high} (5 to 95 % of the draws), median ${middle}, film lost in ${percent(between(way, (at) => at.lost))}`;
    };
    return `At ${shown(load, "N")}, ${Object.keys(WAYS)
      .filter((way) => above[way] && (!below || below[way]))
      .map(one)
      .join("; ")}.`;
  },

  drawStribeck() {
    if (!this.stribeck) return;
    const { rows } = this.stribeck,
      line = (up) => rows.filter((r) => r.up === up).map((r) => [r.speed, r.friction_coefficient]);
    const here = Math.abs(last.point[1]),
      marks = here >= SPEEDS[0] ? [{ x: here, y: last.outputs.friction_coefficient, look: "here" }] : [];
    this.other.show({
      series: [
        { name: "slowing down", points: line(false), look: "branch-film" },
        { name: "speeding up", points: line(true), look: "trail" },
      ],
      marks,
    });
  },
};
