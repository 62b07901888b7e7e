/* A plot as SVG: lines over linear or logarithmic axes, marks, a point to drag, values under the pointer.

   Lines may go back in x (a folded load curve), points are reached from the keyboard; uPlot, of the report of a
   shift, does neither, and is seven times as long as this. */

import { byId, el, every } from "../draw.js";
import { axisUnit, digits, escaped, shown } from "./dom.js";

const LEFT = 62,
  RIGHT = 12,
  TOP = 10,
  BOTTOM = 44,
  STRIP = 48; // of a strip above the plot

function niceTicks(low, high, n) {
  const raw = (high - low) / Math.max(n, 1),
    power = 10 ** Math.floor(Math.log10(raw));
  const step = ([1, 2, 5].find((m) => m * power >= raw) ?? 10) * power,
    found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) found.push(k * step);
  return found;
}

/** Return at least three ticks, about `n`. */
function ticksOf(low, high, n) {
  for (let more = n; more < n + 12; more += 1) {
    const found = niceTicks(low, high, more);
    if (found.length > 2) return found;
  }
  return niceTicks(low, high, n);
}

/** Return a tick's number with so many digits that neighbours differ. */
function tickText(value, ticks) {
  const step = ticks.length > 1 ? Math.abs(ticks[1] - ticks[0]) : 0,
    most = Math.max(...ticks.map(Math.abs));
  return digits(value, step ? Math.max(3, Math.ceil(Math.log10(most / step)) + 1) : 3);
}

function logTicks(low, high) {
  const found = [];
  for (let p = Math.floor(Math.log10(low)); 10 ** p <= high; p += 1) {
    for (const m of Math.log10(high / low) > 3.2 ? [1] : [1, 2, 5]) {
      if (m * 10 ** p >= low * 0.999 && m * 10 ** p <= high * 1.001) found.push(m * 10 ** p);
    }
  }
  return found;
}

/** Return the heading of a view, with a link to the part of the equations that tells its theory. */
export function headed(title, part) {
  if (!part) return el("h3", {}, title);
  const go = (event) => {
    event.preventDefault(); // the address holds the page's state
    byId("theory").open = true;
    const [place] = every("#theory h3").filter((h) => h.textContent === part);
    place.tabIndex = -1;
    place.focus();
  };
  return el(
    "h3",
    {},
    title,
    el("a", { href: "#theory", "data-part": part, onclick: go }, `equations: ${part}`),
  );
}

/**
 * @typedef {{label: string, unit: string, log?: boolean, zero?: boolean}} Axis `zero`: it reaches to 0
 * @typedef {((value: number) => number) & {back: (pixel: number) => number}} Scale from values to pixels
 */

let plots = 0; // so many there are

export class Plot {
  /** @type {Axis} */
  x;
  /** @type {Axis} */
  y;
  /** @type {((x: number, y: number, i: number) => void) | undefined} */
  drag;
  /** @type {number} */
  height;
  /** @type {{name: string, points: number[][], look: string}[]} */
  series;
  /** @type {{name: string, points: number[][], look: string}[]} */
  bands;
  /** @type {any[]} */
  marks;
  /** @type {any[]} */
  handles;
  /** @type {any} */
  strip;
  /** @type {{x?: number[], y?: number[]} | undefined} */
  span;
  /** @type {number | undefined} */
  id;
  /** @type {Scale} */
  sx;
  /** @type {Scale} */
  sy;
  /** @type {number | null | undefined} */
  held;

  /**
   * @param {Element} host
   * @param {{title: string, part?: string, x: Axis, y: Axis, height?: number,
   *   drag?: (x: number, y: number, i: number) => void}} given `drag`: called with data while a point is moved
   */
  constructor(host, { title, part, x, y, drag, height = 300 }) {
    Object.assign(this, { x, y, drag, height, series: [], bands: [], marks: [], handles: [] });
    const moved = {
      onpointerdown: (e) => this.grab(e),
      onpointerup: () => (this.held = null),
      onpointercancel: () => (this.held = null),
      onkeydown: (e) => this.key(e),
    };
    this.svg = el("svg", {
      role: "img",
      "aria-label": title,
      onpointermove: (e) => this.hover(e),
      onpointerleave: () => (this.readout.textContent = ""),
      ...(drag && moved),
    });
    this.legend = el("div", { class: "legend" });
    this.readout = el("div", { class: "readout", "aria-hidden": "true" });
    host.append(headed(title, part), this.legend, el("div", { class: "plot" }, this.svg, this.readout));
    new ResizeObserver(() => this.render()).observe(this.svg.parentNode);
  }

  /**
   * Show `series` [{name, points, look}], `marks` [{x, y, text, look}], `handles` [{x, y, label}], `bands`
   * [{name, points: [[x, low, high]], look}] and a `strip` {label, areas: [{points: [[x, share]], look}]} above.
   */
  show({ series = [], marks = [], handles = [], bands = [], strip = null, span }) {
    const can = (m) =>
      Number.isFinite(m.x) && Number.isFinite(m.y) && !(this.x.log && m.x <= 0) && !(this.y.log && m.y <= 0);
    Object.assign(this, {
      series,
      bands,
      strip,
      marks: marks.filter(can),
      handles: handles.filter(can),
      span,
    });
    this.render();
  }

  /**
   * Return the ends of an axis.
   * @param {Axis} axis
   * @param {number[]} values
   * @returns {number[]}
   */
  range(axis, values) {
    const good = values.filter((v) => Number.isFinite(v) && (!axis.log || v > 0));
    if (!good.length) return axis.log ? [1, 10] : [0, 1];
    let low = Math.min(...good),
      high = Math.max(...good);
    if (axis.log)
      return high > low ? [low / (high / low) ** 0.05, high * (high / low) ** 0.05] : [low / 2, high * 2];
    if (axis.zero) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
    const pad = (high - low || Math.abs(high) || 1) * 0.06;
    return [axis.zero && low === 0 ? 0 : low - pad, high + pad];
  }

  /**
   * Return the way from values to pixels.
   * @param {Axis} axis
   * @param {number[]} ends
   * @param {number} from
   * @param {number} to
   * @returns {Scale}
   */
  scale(axis, [low, high], from, to) {
    const f = axis.log ? Math.log : (v) => v,
      back = axis.log ? Math.exp : (v) => v,
      a = f(low),
      b = f(high);
    const there = (v) => from + ((f(v) - a) / (b - a)) * (to - from);
    there.back = (pixel) => back(a + ((pixel - from) / (to - from)) * (b - a));
    return there;
  }

  render() {
    const width = this.svg.parentNode.clientWidth || 600,
      { x, y, strip } = this,
      top = TOP + (strip ? STRIP : 0),
      height = this.height + top - TOP;
    const all = [
      ...this.series.flatMap((s) => s.points),
      ...this.bands.flatMap((b) =>
        b.points.flatMap(([a, low, high]) => [
          [a, low],
          [a, high],
        ]),
      ),
      ...[...this.marks, ...this.handles].map((m) => [m.x, m.y]),
    ];
    const xs =
        this.span?.x ??
        this.range(
          x,
          all.map((p) => p[0]),
        ),
      ys =
        this.span?.y ??
        this.range(
          y,
          all.map((p) => p[1]),
        );
    const sx = (this.sx = this.scale(x, xs, LEFT, width - RIGHT)),
      sy = (this.sy = this.scale(y, ys, height - BOTTOM, top));
    const [xName, xFactor, xZero] = axisUnit(xs, x.unit),
      [yName, yFactor, yZero] = axisUnit(ys, y.unit);
    const parts = [];
    /** @type {(axis: Axis, ends: number[], factor: number, zero: number, n: number) => number[]} */
    const ticks = (axis, [low, high], factor, zero, n) =>
      axis.log
        ? logTicks(low, high)
        : ticksOf((low - zero) / factor, (high - zero) / factor, n).map((v) => v * factor + zero);
    const across = ticks(x, xs, xFactor, xZero, width / 90),
      up = ticks(y, ys, yFactor, yZero, this.height / 55);
    const write = (axis, marks, factor, zero, v) =>
      axis.log
        ? digits((v - zero) / factor, 3)
        : tickText(
            (v - zero) / factor,
            marks.map((own) => (own - zero) / factor),
          );
    for (const v of across) {
      parts.push(
        `<line class="grid" x1="${sx(v)}" x2="${sx(v)}" y1="${top}" y2="${height - BOTTOM}"/>`,
        `<text class="tick" x="${sx(v)}" y="${height - BOTTOM + 16}" text-anchor="middle">${write(x, across, xFactor, xZero, v)}</text>`,
      );
    }
    for (const v of up) {
      parts.push(
        `<line class="grid" x1="${LEFT}" x2="${width - RIGHT}" y1="${sy(v)}" y2="${sy(v)}"/>`,
        `<text class="tick" x="${LEFT - 6}" y="${sy(v) + 4}" text-anchor="end">${write(y, up, yFactor, yZero, v)}</text>`,
      );
    }
    const titled = (axis, name) => escaped(`${axis.label}${name ? ` [${name}]` : ""}`);
    parts.push(
      `<text class="name" x="${(LEFT + width - RIGHT) / 2}" y="${height - 8}" text-anchor="middle">${titled(x, xName)}</text>`,
      `<text class="name" transform="translate(14 ${(top + height - BOTTOM) / 2}) rotate(-90)" text-anchor="middle">${titled(y, yName)}</text>`,
      `<clipPath id="clip-${(this.id ??= plots += 1)}"><rect x="${LEFT}" y="${top}" width="${width - LEFT - RIGHT}" height="${height - top - BOTTOM}"/></clipPath><g clip-path="url(#clip-${this.id})">`,
    );
    for (const { points, look } of this.bands)
      parts.push(`<path class="band ${look}" d="${this.outline(points)}"/>`);
    for (const { points, look } of this.series) {
      const good = points.filter(
        (p) => Number.isFinite(p[1]) && (!y.log || p[1] > 0) && (!x.log || p[0] > 0),
      );
      parts.push(
        `<polyline class="line ${look}" points="${good.map((p) => `${sx(p[0]).toFixed(1)},${sy(p[1]).toFixed(1)}`).join(" ")}"/>`,
      );
    }
    parts.push("</g>", ...(strip ? this.stripParts(strip, width) : []));
    for (const m of this.marks) {
      const room = 7 * (m.text ?? "").length + 12,
        words = width < 500 ? (m.brief ?? m.text) : m.text;
      const end = m.left || sx(m.x) > width - (words === m.text ? room : 70);
      parts.push(
        `<circle class="mark ${m.look ?? ""}" cx="${sx(m.x)}" cy="${sy(m.y)}" r="4"/>`,
        words
          ? `<text class="note" x="${sx(m.x) + (end ? -8 : 8)}" y="${sy(m.y) + (m.below ? 18 : -8)}" text-anchor="${end ? "end" : "start"}">${escaped(words)}</text>`
          : "",
      );
    }
    this.handles.forEach((h, i) =>
      parts.push(
        `<circle class="handle ${h.look ?? ""}" tabindex="0" role="slider" data-i="${i}" aria-label="${escaped(h.label)}" aria-valuenow="${digits(h.x, 6)}" aria-valuetext="${escaped(h.text ?? h.label)}" cx="${sx(h.x)}" cy="${sy(h.y)}" r="8"/>`,
      ),
    );
    /** @type {any} */
    const active = document.activeElement;
    const focused = this.svg.contains(active) ? active.dataset.i : null;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.svg.setAttribute("role", this.handles.length ? "group" : "img");
    this.svg.innerHTML = parts.join("");
    if (focused) this.svg.querySelector(`[data-i="${focused}"]`)?.focus();
    const named = [...this.series, ...this.bands, ...(strip?.areas ?? [])].filter((s) => s.name),
      listed = named.map((s) => `${s.name}|${s.look}`).join();
    if (listed !== this.listed) {
      this.listed = listed;
      this.legend.replaceChildren(...named.map((s) => el("span", { class: `key ${s.look}` }, s.name)));
    }
  }

  /** Return the outline of a band, there at its upper end and back at its lower one. */
  outline(points) {
    const at = (a, b) => `${this.sx(a).toFixed(1)},${this.sy(b).toFixed(1)}`;
    const good = points.filter(([, low, high]) => Number.isFinite(high) && (!this.y.log || low > 0));
    return good.length
      ? `M${[...good.map(([a, , high]) => at(a, high)), ...good.toReversed().map(([a, low]) => at(a, low))].join("L")}Z`
      : "";
  }

  /** Return a strip of shares, 0 to 100 %, above the plot. */
  stripParts({ label, areas }, width) {
    const low = TOP + STRIP - 12,
      high = TOP + 14,
      at = ([a, share]) => `${this.sx(a).toFixed(1)},${(low - share * (low - high)).toFixed(1)}`;
    const line = (y, text) =>
      `<line class="grid" x1="${LEFT}" x2="${width - RIGHT}" y1="${y}" y2="${y}"/><text class="tick" x="${LEFT - 6}" y="${y + 4}" text-anchor="end">${text}</text>`;
    return [
      `<text class="tick" x="${LEFT}" y="${TOP + 6}">${escaped(label)}</text>`,
      line(low, "0"),
      line(high, "100 %"),
      ...areas
        .filter(({ points }) => points.length)
        .map(
          ({ points, look }) =>
            `<path class="share ${look}" d="M${[[points[0][0], 0], ...points, [points.at(-1)[0], 0]].map(at).join("L")}"/>`,
        ),
    ];
  }

  place(event) {
    const box = this.svg.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  hover(event) {
    const [px, py] = this.place(event);
    if (this.held !== null && this.held !== undefined && this.drag) this.move(px, py);
    let best = null,
      least = 30;
    for (const { name, points } of this.series) {
      for (const [a, b] of points) {
        const far = Math.hypot(this.sx(a) - px, this.sy(b) - py);
        if (far < least) [best, least] = [[a, b, name], far];
      }
    }
    this.readout.textContent = best
      ? `${shown(best[0], this.x.unit)}: ${shown(best[1], this.y.unit)}${best[2] ? `, ${best[2]}` : ""}`
      : "";
  }

  grab(event) {
    const [px, py] = this.place(event);
    if (!this.handles.length) return;
    const far = this.handles.map((h) => Math.hypot(this.sx(h.x) - px, this.sy(h.y) - py));
    if (event.pointerType === "touch" && Math.min(...far) > 40) return;
    this.held = far.indexOf(Math.min(...far));
    this.svg.setPointerCapture(event.pointerId);
    event.preventDefault();
    this.move(px, py);
  }

  move(px, py) {
    this.drag?.(this.sx.back(px), this.sy.back(py), this.held ?? 0);
  }

  key(event) {
    const i = event.target.dataset?.i,
      way = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (i === undefined || !way) return;
    event.preventDefault();
    const h = this.handles[i],
      pixels = event.shiftKey ? 2 : 8;
    this.drag?.(
      this.sx.back(this.sx(h.x) + way[0] * pixels),
      this.sy.back(this.sy(h.y) - way[1] * pixels),
      Number(i),
    );
  }
}
