/* What the pages draw with: elements, and fields over a washer as shaded discs. */

const DISC = 300; // pixels of a disc's side
const LEVELS = 8; // contour lines lie between them
const IN_SVG = new Set(["svg", "path", "rect", "text", "title"]);
// colours from low to high: viridis after Smith & van der Walt, cividis after Nuñez & al., inferno
const PRESSURE = ["#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725"];
const WARM = ["#000004", "#420a68", "#932667", "#dd513a", "#fca50a", "#fcffa4"];
const SHADES = {
  film_thickness: ["#00224e", "#35456c", "#666970", "#948e77", "#c8b866", "#fee838"],
  carrier_temperature: WARM,
  washer_temperature: WARM,
};
const LEAST = { contact_pressure: 1, pressure: 1 }; // Pa, below it a field counts as zero everywhere

/**
 * Return an element with properties (as attributes; "on..." listens) and children.
 * @param {string} tag
 * @param {Record<string, any>} given
 * @param {...any} children
 * @returns {any} an element of that tag
 */
export function el(tag, given = {}, ...children) {
  const made = IN_SVG.has(tag)
    ? document.createElementNS("http://www.w3.org/2000/svg", tag)
    : document.createElement(tag);
  for (const [name, value] of Object.entries(given)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

/**
 * Return an element of the page.
 * @param {string} id
 * @returns {any} an element of whatever tag; null where the page has none
 */
export const byId = (id) => document.getElementById(id);

/**
 * Return the page's elements that a selector names.
 * @param {string} selector
 * @returns {any[]} elements of whatever tags
 */
export const every = (selector) => [...document.querySelectorAll(selector)];

/** Return 256 colours. */
function tableOf(stops) {
  const rgb = stops.map((c) => [1, 3, 5].map((k) => parseInt(c.slice(k, k + 2), 16))),
    made = new Uint8ClampedArray(256 * 3);
  for (let i = 0; i < 256; i += 1) {
    const at = (i / 255) * (rgb.length - 1),
      k = Math.min(Math.floor(at), rgb.length - 2);
    for (let c = 0; c < 3; c += 1) made[3 * i + c] = rgb[k][c] + (at - k) * (rgb[k + 1][c] - rgb[k][c]);
  }
  return made;
}

/**
 * Return what draws on a canvas.
 * @param {HTMLCanvasElement} canvas
 */
const contextOf = (canvas) => /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));

export class Disc {
  /** @type {string} */
  title;
  /** @type {(value: number) => string} */
  tell;
  /** @type {number} */
  least;
  /** @type {Uint8ClampedArray} */
  table;
  /** @type {HTMLCanvasElement} */
  canvas;

  /** Add a figure to `host` for a field of that `name`; `tell` says a value with its unit. */
  constructor(host, { name, title, tell }) {
    Object.assign(this, { title, tell, least: LEAST[name] ?? 0, table: tableOf(SHADES[name] ?? PRESSURE) });
    this.canvas = el("canvas", { width: DISC, height: DISC, role: "img" });
    const scale = el("canvas", { width: 128, height: 8, class: "scale", "aria-hidden": "true" });
    this.low = el("span");
    this.high = el("span");
    host.append(
      el(
        "figure",
        { class: "disc" },
        el("figcaption", {}, title),
        this.canvas,
        el("div", { class: "ends" }, this.low, scale, this.high),
      ),
    );
    const context = contextOf(scale),
      image = context.createImageData(128, 8);
    for (let k = 0; k < 128 * 8; k += 1) this.shade(image.data, 4 * k, (k % 128) / 127, 1);
    context.putImageData(image, 0, 0);
  }

  shade(data, at, share, light) {
    const k = 3 * Math.min(Math.max(Math.round(share * 255), 0), 255);
    for (let c = 0; c < 3; c += 1) data[at + c] = light * this.table[k + c];
    data[at + 3] = 255;
  }

  /** Show values over nodes, angle by angle; `pixels`: what they are looked up with, made once for a mesh. */
  show(values, pixels, speed) {
    let low = Infinity,
      high = -Infinity;
    for (const v of values) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
    if (high < this.least) low = high = 0;
    const ends = [this.tell(low), this.tell(high)],
      same = ends[0] === ends[1];
    const context = contextOf(this.canvas),
      image = context.createImageData(DISC, DISC),
      level = new Int8Array(DISC * DISC).fill(-1);
    const by = same ? 0 : 1 / (high - low),
      { at, k, w } = pixels;
    for (let p = 0; p < at.length; p += 1) {
      const v =
        w[4 * p] * values[k[4 * p]] +
        w[4 * p + 1] * values[k[4 * p + 1]] +
        w[4 * p + 2] * values[k[4 * p + 2]] +
        w[4 * p + 3] * values[k[4 * p + 3]];
      const place = at[p],
        own = Math.min(LEVELS - 1, Math.max(0, Math.floor((v - low) * by * LEVELS)));
      level[place] = own;
      const line =
        ((level[place - 1] ?? -1) >= 0 && level[place - 1] !== own) ||
        ((level[place - DISC] ?? -1) >= 0 && level[place - DISC] !== own);
      this.shade(image.data, 4 * place, (v - low) * by, line ? 0.6 : 1);
    }
    context.putImageData(image, 0, 0);
    if (speed) this.turning(context, 0.24 * DISC * pixels.hole, Math.sign(speed));
    [this.low.textContent, this.high.textContent] = same ? [`${ends[0]} everywhere`, ""] : ends;
    this.canvas.setAttribute(
      "aria-label",
      `${this.title}: ${same ? this.low.textContent : `from ${ends[0]} to ${ends[1]}`}`,
    );
  }

  /** Draw an arrow around the middle: which way the washer turns. */
  turning(context, radius, way) {
    const last = -2.1 * way,
      middle = DISC / 2,
      [x, y] = [middle + radius * Math.cos(last), middle + radius * Math.sin(last)];
    const side = (along, across) => [
      x + 0.2 * radius * (across * Math.cos(last) + along * way * Math.sin(last)),
      y + 0.2 * radius * (across * Math.sin(last) - along * way * Math.cos(last)),
    ];
    context.strokeStyle = context.fillStyle = getComputedStyle(this.canvas).color;
    context.lineWidth = 0.03 * radius;
    context.beginPath();
    context.arc(middle, middle, radius, 2.6 * way, last, way > 0);
    context.stroke();
    context.beginPath();
    for (const corner of [side(1.6, 0), side(0, 0.8), side(0, -0.8)]) context.lineTo(...corner);
    context.fill();
  }
}

/** Return which nodes each pixel of a disc is interpolated from: places, nodes and weights. */
export function pixelsOf(radius, angle) {
  const at = [],
    k = [],
    w = [],
    nR = radius.length,
    nT = angle.length,
    outer = radius[nR - 1],
    middle = (DISC - 1) / 2;
  const order = Array.from(angle.keys()).sort((a, b) => angle[a] - angle[b]),
    turn = order.map((j) => angle[j]);
  for (let py = 0; py < DISC; py += 1) {
    for (let px = 0; px < DISC; px += 1) {
      const x = ((px - middle) / middle) * outer * 1.01,
        y = ((middle - py) / middle) * outer * 1.01,
        r = Math.hypot(x, y);
      if (r < radius[0] || r > outer) continue;
      let i = 0;
      while (i < nR - 2 && radius[i + 1] < r) i += 1;
      const a = (Math.atan2(y, x) + 2 * Math.PI) % (2 * Math.PI);
      let j = turn.findIndex((t) => t > a);
      j = (j < 0 ? nT : j) - 1;
      const from = j < 0 ? turn[nT - 1] - 2 * Math.PI : turn[j],
        to = j + 1 < nT ? turn[j + 1] : turn[0] + 2 * Math.PI;
      const one = order[(j + nT) % nT],
        two = order[(j + 1) % nT],
        t = (a - from) / (to - from),
        s = (r - radius[i]) / (radius[i + 1] - radius[i]);
      at.push(py * DISC + px);
      k.push(one * nR + i, one * nR + i + 1, two * nR + i, two * nR + i + 1);
      w.push((1 - t) * (1 - s), (1 - t) * s, t * (1 - s), t * s);
    }
  }
  return {
    at: Uint32Array.from(at),
    k: Uint32Array.from(k),
    w: Float32Array.from(w),
    hole: radius[0] / outer,
  };
}
