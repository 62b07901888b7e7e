"use strict";
/* Fields over the washer as shaded discs. */

const SHADES = { // stops from low to high
  film: ["#00224e", "#35456c", "#666970", "#948e77", "#c8b866", "#fee838"],
  pressure: ["#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725"],
  warm: ["#000004", "#420a68", "#932667", "#dd513a", "#fca50a", "#fcffa4"],
};

function tableOf(stops) {
  const rgb = stops.map((c) => [1, 3, 5].map((k) => parseInt(c.slice(k, k + 2), 16))), made = new Uint8ClampedArray(256 * 3);
  for (let i = 0; i < 256; i += 1) {
    const at = (i / 255) * (rgb.length - 1), k = Math.min(Math.floor(at), rgb.length - 2);
    for (let c = 0; c < 3; c += 1) made[3 * i + c] = rgb[k][c] + (at - k) * (rgb[k + 1][c] - rgb[k][c]);
  }
  return made;
}

class Disc {
  constructor(host, { title, unit, shades, least = 0 }) {
    Object.assign(this, { title, unit, least, table: tableOf(SHADES[shades]), size: 200 });
    this.canvas = el("canvas", { width: this.size, height: this.size, role: "img" });
    this.bar = el("canvas", { width: 128, height: 8, class: "bar", "aria-hidden": "true" });
    this.low = el("span"); this.high = el("span");
    host.append(el("figure", { class: "disc" }, el("figcaption", {}, title), this.canvas,
      el("div", { class: "ends" }, this.low, this.bar, this.high)));
    const context = this.bar.getContext("2d"), image = context.createImageData(128, 8);
    for (let k = 0; k < 128 * 8; k += 1) this.shade(image.data, 4 * k, (k % 128) / 127);
    context.putImageData(image, 0, 0);
  }

  shade(data, at, share) {
    const k = 3 * Math.min(Math.max(Math.round(share * 255), 0), 255);
    data[at] = this.table[k]; data[at + 1] = this.table[k + 1]; data[at + 2] = this.table[k + 2]; data[at + 3] = 255;
  }

  /** Show values over nodes, angle by angle; pixels look up (place, weights) made once for a mesh. */
  show(values, pixels) {
    let low = Infinity, high = -Infinity;
    for (const v of values) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
    if (high < this.least) low = high = 0;
    const context = this.canvas.getContext("2d"), image = context.createImageData(this.size, this.size);
    const by = high > low ? 1 / (high - low) : 0, { at, k, w } = pixels;
    for (let p = 0; p < at.length; p += 1) {
      const v = w[4 * p] * values[k[4 * p]] + w[4 * p + 1] * values[k[4 * p + 1]] + w[4 * p + 2] * values[k[4 * p + 2]] + w[4 * p + 3] * values[k[4 * p + 3]];
      this.shade(image.data, 4 * at[p], (v - low) * by);
    }
    context.putImageData(image, 0, 0);
    [this.low.textContent, this.high.textContent] = [shown(low, this.unit, false, 3), high > low || low ? shown(high, this.unit, false, 3) : "nowhere more"];
    this.canvas.setAttribute("aria-label", `${this.title}: from ${this.low.textContent} to ${this.high.textContent}`);
  }
}

/** Return which nodes each pixel of a disc is interpolated from. */
function pixelsOf(radius, angle, size) {
  const at = [], k = [], w = [], nR = radius.length, nT = angle.length, outer = radius[nR - 1], middle = (size - 1) / 2;
  const order = Array.from(angle.keys()).sort((a, b) => angle[a] - angle[b]), turn = order.map((j) => angle[j]);
  for (let py = 0; py < size; py += 1) {
    for (let px = 0; px < size; px += 1) {
      const x = ((px - middle) / middle) * outer * 1.01, y = ((middle - py) / middle) * outer * 1.01, r = Math.hypot(x, y);
      if (r < radius[0] || r > outer) continue;
      let i = 0;
      while (i < nR - 2 && radius[i + 1] < r) i += 1;
      const a = (Math.atan2(y, x) + 2 * Math.PI) % (2 * Math.PI);
      let j = turn.findIndex((t) => t > a);
      j = (j < 0 ? nT : j) - 1;
      const from = j < 0 ? turn[nT - 1] - 2 * Math.PI : turn[j], to = j + 1 < nT ? turn[j + 1] : turn[0] + 2 * Math.PI;
      const one = order[(j + nT) % nT], two = order[(j + 1) % nT], t = (a - from) / (to - from), s = (r - radius[i]) / (radius[i + 1] - radius[i]);
      at.push(py * size + px);
      k.push(one * nR + i, one * nR + i + 1, two * nR + i, two * nR + i + 1);
      w.push((1 - t) * (1 - s), (1 - t) * s, t * (1 - s), t * s);
    }
  }
  return { at: Uint32Array.from(at), k: Uint32Array.from(k), w: Float32Array.from(w) };
}
