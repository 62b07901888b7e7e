/* The gear mesh: its teeth in the transverse section, and what there is along the path of contact. */

import { el } from "../../draw.js";
import { ABOUT, digits, shown } from "../dom.js";
import { numbersOf, state } from "../page.js";
import { Plot, headed } from "../plot.js";
import { Scatter, bandOver, bandWords } from "../scatter.js";

/** Return what a path has at a position, linear between its places; beyond its ends nothing. */
function between(path, key, x) {
  const points = path ? path.position.map((s, k) => [s, path[key][k]]).sort((a, b) => a[0] - b[0]) : [];
  const i = points.findIndex(([s]) => s >= x - 1e-9);
  if (i < 0 || (i === 0 && points[0][0] > x + 1e-9)) return NaN;
  if (i === 0) return points[0][1];
  const [[a, u], [b, v]] = [points[i - 1], points[i]];
  return u + ((v - u) * (x - a)) / (b - a);
}

const FLANK = 14,
  NEAR = 0.12; // points on a flank; base pitches within which two letters share a place
const NODES = 5, // of a piece of the path
  FINE = 6; // steps of a curve between two of them

/** Return the slope at the first of three points, of the sign of the first interval. */
function endSlope(h, g, d, e) {
  const m = ((2 * h + g) * d - h * e) / (h + g);
  if (m * d <= 0) return 0;
  return d * e <= 0 && Math.abs(m) > Math.abs(3 * d) ? 3 * d : m;
}

/** Return points of the monotone cubic through some points, which rise in x. */
function smooth(points) {
  const h = points.slice(1).map(([x], k) => x - points[k][0]),
    d = h.map((step, k) => (points[k + 1][1] - points[k][1]) / step),
    n = h.length - 1;
  if (!h.every((step) => step > 0) || !d.every(Number.isFinite)) return points;
  const inner = (k) => {
    const [one, two] = [h[k] + 2 * h[k - 1], 2 * h[k] + h[k - 1]];
    return d[k - 1] * d[k] > 0 ? (one + two) / (two / d[k - 1] + one / d[k]) : 0;
  };
  const slopes = [
    endSlope(h[0], h[1], d[0], d[1]),
    ...d.slice(1).map((_, k) => inner(k + 1)),
    endSlope(h[n], h[n - 1], d[n], d[n - 1]),
  ];
  const along = h.flatMap((step, k) =>
    Array.from({ length: FINE }, (_, i) => {
      const s = i / FINE,
        [[x, y], m, w] = [points[k], slopes[k], slopes[k + 1]],
        cubic = m + w - 2 * d[k],
        square = 3 * d[k] - 2 * m - w;
      return [x + s * step, y + step * s * (m + s * (square + s * cubic))];
    }),
  );
  return [...along, points[points.length - 1]];
}

/** Return a curve along the path: through the nodes of each piece, with jumps between pieces. */
function curve(path, values) {
  const pieces = [];
  for (let k = 0; k < path.position.length; k += NODES)
    pieces.push(
      path.position
        .slice(k, k + NODES)
        .map((s, i) => [s, values[k + i]])
        .sort((a, b) => a[0] - b[0]),
    );
  return pieces.sort((a, b) => a[0][0] - b[0][0]).flatMap(smooth);
}

/** Two gears in the transverse section, the pinion below; the pitch point is the origin, lengths in m. */
class Teeth {
  /** @type {number} */
  rolled;
  /** @type {any} */
  svg;
  /** @type {any} */
  told;
  /** @type {any} */
  teeth;
  /** @type {any} */
  path;
  /** @type {any} */
  overlap;

  constructor(host) {
    Object.assign(this, {
      rolled: 0.2,
      svg: el("svg", { role: "img", class: "teeth", "aria-label": "Teeth and path of contact" }),
      told: el("p", { class: "pairs" }),
    });
    const roll = el("input", {
      id: "roll",
      type: "range",
      min: 0,
      max: 1,
      step: "any",
      value: this.rolled,
      "aria-label": "position of a pair of teeth along the path, slider",
    });
    roll.addEventListener("input", () => {
      this.rolled = Number(roll.value);
      this.render();
    });
    const keys = Object.entries({
      pinion: "pinion, it drives clockwise",
      gear: "gear",
      third: "working pitch circles",
      fifth: "line of action",
      path: "path of contact A to E",
      touch: "pairs in contact",
    });
    host.append(
      headed("Teeth and path of contact", "Geometry and load"),
      el(
        "div",
        { class: "legend" },
        ...keys.map(([look, name]) => el("span", { class: `key ${look}` }, name)),
      ),
      el("div", { class: "plot" }, this.svg),
      el("label", { for: "roll" }, "Roll the gears along the path"),
      roll,
      this.told,
      el(
        "p",
        { class: "folds" },
        "Transverse section, to scale. Flanks are involutes; each root is a plain circle at the rack's addendum, without its fillet, below the base circle a radius. Tip relief is too small to be seen. B and D lie one base pitch before E and after A.",
      ),
    );
    new ResizeObserver(() => this.render()).observe(this.svg.parentNode);
  }

  show(teeth, path, overlap) {
    Object.assign(this, { teeth, path, overlap });
    this.render();
  }

  /** Return the place of the pair to show: where the kernel has a share within a piece of the path. */
  position() {
    const { approach, recess } = this.teeth,
      s = -approach + this.rolled * (approach + recess);
    if (!this.path) return s;
    const inner = this.path.position.filter((_, k) => k % 5 > 0 && k % 5 < 4); // five nodes a piece, its ends left out
    return inner.reduce((best, one) => (Math.abs(one - s) < Math.abs(best - s) ? one : best));
  }

  /**
   * Return the place of a position along the path of contact.
   * @param {number} s
   * @returns {[number, number]}
   */
  at(s) {
    const { pitch, angle } = this.teeth;
    return [s * pitch * Math.cos(angle), s * pitch * Math.sin(angle)];
  }

  /**
   * Return the outline of a wheel near the pitch point, closed within its body; its flank touches at `s`.
   * @returns {[number[][], number[][]]}
   */
  outline(wheel, out, centre, upwards, s, reach) {
    const { angle, pitch, module } = this.teeth,
      { teeth, base, tip, root, working, tipThickness } = wheel,
      isPinion = wheel === this.teeth.pinion;
    const inv = (r) => {
      const a = Math.acos(Math.min(1, base / r));
      return Math.tan(a) - a;
    };
    const string = working * Math.sin(angle) + (isPinion ? 1 : -this.teeth.side) * s * pitch; // from base circle to contact
    const middle =
      upwards * (Math.PI / 2) + angle - string / base + inv(tip) + (out * tipThickness) / 2 / tip;
    const half = (r) =>
      Math.min(Math.max(tipThickness / 2 / tip + out * (inv(tip) - inv(r)), 0), Math.PI / teeth);
    const polar = (r, a) => [r * Math.cos(a), centre + r * Math.sin(a)],
      found = [];
    const radii = Array.from({ length: FLANK }, (_, k) => {
      const from = Math.max(root * out, base * out) * out,
        share = k / (FLANK - 1);
      return from + (tip - from) * share;
    });
    if (out < 0) radii.forEach((_, k) => (radii[k] = root + ((tip - root) * k) / (FLANK - 1)));
    const flank = [root, ...radii],
      step = (2 * Math.PI) / teeth,
      looks = upwards * (Math.PI / 2);
    const near = middle + step * Math.round((looks - middle) / step),
      n = Math.min(Math.ceil(reach / working / step) + 1, Math.floor((teeth - 1) / 2));
    const arc = (r, from, to) => Array.from({ length: 7 }, (_, k) => polar(r, from + ((to - from) * k) / 6));
    for (let k = -n; k <= n; k += 1) {
      const g = near + k * step;
      found.push(
        ...flank.map((r) => polar(r, g - half(r))),
        ...arc(tip, g - half(tip), g + half(tip)),
        ...flank.toReversed().map((r) => polar(r, g + half(r))),
        ...arc(root, g + half(root), g + step - half(root)),
      );
    }
    const inside = root - out * Math.min(6 * module, root / 2),
      [first, final] = [near - n * step, near + (n + 1) * step];
    return [found, Array.from({ length: 41 }, (_, k) => polar(inside, final + ((first - final) * k) / 40))];
  }

  render() {
    if (!this.teeth) return;
    const { side, module, pitch, angle, approach, recess, pinion, gear } = this.teeth,
      width = this.svg.parentNode.clientWidth || 600;
    const [[left], [right]] = [this.at(-approach), this.at(recess)],
      middle = (left + right) / 2,
      cover = (right - left) / 2 + module;
    const reach = width > 560 ? Math.max(cover, (1.6 * pitch) / Math.cos(angle)) : cover,
      scale = width / 2 / reach;
    const low = -(pinion.working - pinion.root) - 0.9 * module,
      high = side * (gear.working - gear.root) + 0.9 * module,
      height = (high - low) * scale;
    const pixel = ([x, y]) => [(x - middle + reach) * scale, (high - y) * scale],
      text = (points) =>
        points
          .map((p) =>
            pixel(p)
              .map((v) => v.toFixed(1))
              .join(","),
          )
          .join("L");
    const s = this.position(),
      parts = [],
      above = side * gear.working;
    const body = (look, [edge, closing]) =>
      parts.push(
        `<path class="body ${look}" d="M${text([...edge, ...closing])}Z"/><path class="flank ${look}" d="M${text(edge)}"/>`,
      );
    body("gear", this.outline(gear, side, above, -side, s, 2 * reach));
    body("pinion", this.outline(pinion, 1, -pinion.working, 1, s, 2 * reach));
    for (const [y, r] of [
      [-pinion.working, pinion.working],
      [above, gear.working],
    ]) {
      const [cx, cy] = pixel([0, y]);
      parts.push(`<circle class="line third" cx="${cx}" cy="${cy}" r="${r * scale}"/>`);
    }
    const beyond = (2 * reach) / pitch,
      letters = [
        ["A", -approach],
        ["B", recess - 1],
        ["C", 0],
        ["D", 1 - approach],
        ["E", recess],
      ];
    parts.push(
      `<path class="line fifth" d="M${text([this.at(-beyond), this.at(beyond)])}"/><path class="line path" d="M${text([this.at(-approach), this.at(recess)])}"/>`,
    );
    const pairs = [];
    for (let k = Math.ceil(-approach - s - 1e-9); s + k <= recess + 1e-9; k += 1) pairs.push(s + k);
    for (const place of pairs) {
      const [cx, cy] = pixel(this.at(place));
      parts.push(`<circle class="touch" cx="${cx}" cy="${cy}" r="7"/>`);
    }
    letters
      .sort((a, b) => a[1] - b[1])
      .forEach(([letter, place], k) => {
        const [x, y] = this.at(place),
          [px, py] = pixel([x, y]),
          way = k % 2 ? 1 : -1; // letters stand on both sides of the path in turn
        parts.push(
          `<circle class="mark" data-point="${letter}" data-x="${x}" data-y="${y}" cx="${px}" cy="${py}" r="3.5"/>`,
          `<text class="letter" x="${px + way * 18 * Math.sin(angle)}" y="${py + way * 18 * Math.cos(angle) + 5}" text-anchor="middle">${letter}</text>`,
        );
      });
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height.toFixed(0)}`);
    this.svg.innerHTML = parts.join("");
    this.tell(pairs);
  }

  tell(pairs) {
    const shares = this.path ? pairs.map((s) => between(this.path, "share", s)) : [];
    const each = (s, k) => [
      k ? ", " : "",
      el("data", { value: shares[k] }, digits(shares[k], 4)),
      ` at ${digits(s, 3)}`,
    ];
    const sum = `; together ${digits(
      shares.reduce((a, b) => a + b, 0),
      4,
    )}${this.overlap > 0 ? " in this section, 1 over the teeth's width and a pitch" : ""}.`;
    this.told.replaceChildren(
      ...(this.path
        ? ["Load share of the pairs (position in base pitches from C): ", ...pairs.flatMap(each), sum]
        : [
            "With film_heat = atan the paper's heat is taken where contact starts: there is nothing along the path.",
          ]),
    );
    const { side, pinion, gear } = this.teeth,
      deep = Math.min(
        side * (gear.working - gear.root) - pinion.tip + pinion.working,
        pinion.working - pinion.root - side * (gear.tip - gear.working),
      );
    if (deep < 0)
      this.told.append(
        ` Tips reach ${shown(-deep, "m")} below the other gear's root circle: a tool with more tool_addendum cuts deeper.`,
      );
  }
}

export const VIEW = {
  build(host) {
    const panel = (wide) => host.appendChild(el("section", { class: wide ? "panel wide" : "panel" }));
    const x = { label: "position from the pitch point, in base pitches", unit: "1" };
    this.teeth = new Teeth(panel(true));
    this.along = () => [...host.querySelectorAll(".panel")].slice(1);
    this.share = new Plot(panel(), {
      title: "Load share of a pair along the path",
      part: "Geometry and load",
      x,
      y: { label: "share of the load", unit: "1", zero: true },
    });
    this.slide = new Plot(panel(), {
      title: "Sliding along the path",
      part: "Geometry and load",
      x,
      y: { label: "sliding, pinion's flank over the gear's", unit: "m/s" },
    });
    const temperatures = panel(true);
    this.scuffs = temperatures.appendChild(el("p", { class: "folds" }));
    this.warm = new Plot(temperatures, {
      title: "Temperatures along the path of contact",
      part: "Heat",
      x,
      y: { label: "temperature", unit: "K" },
      height: 320,
    });
    this.scatter = new Scatter(temperatures, {
      of: "The band of flank and scuffing safety along the path",
      depends: () => [state.inputs, state.parameters, state.level],
      show: () => this.draw(),
      given: (values) => [numbersOf(values), state.level, ABOUT.inputs.map((s) => values[s.name])],
      told: () =>
        bandWords(["surface_temperature", "scuffing_safety", "friction_torque"], this.scatter.sound),
    });
    this.safe = new Plot(panel(), {
      title: "Safety along the path",
      part: "Safety",
      x,
      y: { label: "safety factor", unit: "1", log: true },
    });
    this.film = new Plot(panel(), {
      title: "Film along the path",
      part: "Geometry and load",
      x,
      y: { label: "film thickness", unit: "m", zero: true },
    });
    this.press = new Plot(panel(), {
      title: "Hertz pressure along the path",
      part: "Geometry and load",
      x,
      y: { label: "pressure", unit: "Pa", zero: true },
    });
    this.rub = new Plot(panel(), {
      title: "Friction along the path",
      part: "Heat",
      x,
      y: { label: "coefficient of friction", unit: "1", zero: true },
    });
  },

  /** The inputs that the verification tables know: a torque in place of the power. */
  values({ power, ...rest }) {
    return { ...rest, load: power === 0 ? 0 : Math.abs(power / rest.speed) };
  },

  solved(result, fresh) {
    this.result = result;
    this.draw();
    if (fresh) this.scatter.follow();
  },

  draw() {
    const { path, outputs, teeth } = this.result;
    this.teeth.show(teeth, path, outputs.overlap_ratio);
    for (const panel of this.along()) panel.hidden = !path;
    if (!path) return;
    this.scuffs.textContent = `The contact scuffs at ${shown(path.scuffing, "K")}, ${shown(outputs.scuffing_margin, "K", true)} above its hottest place.`;
    const line = (name, values, look) => ({
      name,
      look,
      points: curve(path, values),
    });
    const level = (name, value, look) =>
      line(
        name,
        path.position.map(() => value),
        look,
      );
    const [b, d] = [teeth.recess - 1, 1 - teeth.approach],
      inside =
        Math.abs(b - d) < NEAR
          ? [["B, D", b]]
          : [
              ["B", b],
              ["D", d],
            ];
    const ends = [["A", -teeth.approach], ...inside, ["E", teeth.recess]].map(([words, at]) => ({
      x: at,
      y: 0,
      text: words,
    }));
    this.share.show({ series: [line("", path.share, "")], marks: ends });
    this.slide.show({ series: [line("", path.sliding, "")], marks: ends });
    const s = path.position[path.hot],
      x = path.position.toSorted((one, other) => one - other);
    const band = (name, key) =>
      bandOver(x, this.scatter, name, "scatter-two", (r, i) => between(r.path, key, x[i]));
    const warm = band("flank", "flank"),
      safe = band("scuffing", "safety");
    this.warm.show({
      bands: warm.bands,
      series: [
        ...warm.medians,
        line("flank", path.flank, "second"),
        level("bodies", path.bulk, ""),
        level("oil", state.inputs.oil_temperature, "fourth"),
      ],
      marks: [
        { x: s, y: path.flank[path.hot], text: `hottest: ${shown(path.flank[path.hot], "K")}`, look: "here" },
      ],
    });
    this.safe.show({
      bands: safe.bands,
      series: [
        ...safe.medians,
        line("scuffing", path.safety, "second"),
        ...(path.micropitting ? [line("micropitting", path.micropitting, "")] : []),
        level("pitting", outputs.pitting_safety, "fourth"),
        level("1: at the limit", 1, "third"),
      ],
    });
    this.film.show({ series: [line("", path.film, "")] });
    this.press.show({ series: [line("", path.pressure, "")] });
    this.rub.show({ series: [line("", path.friction, "")] });
  },
};
