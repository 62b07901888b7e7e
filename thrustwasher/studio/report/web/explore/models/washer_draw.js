/* A draw of the scatter: a washer over rising loads, on both ways of the load. */

import { ALONE, SHALLOW, Walker } from "./washer_walk.js";

const CLEAR = 0.01,
  FILM_RATIO = 3; // share of contact, film ratio: a film that is clear, as the kernels have it
const COARSE = 0.28,
  ROUGH = 1e-4,
  EXACT = 2e-6; // finest step along the curve [sigma]; tolerances there and of what is shown
const MOST_NODES = 200,
  REACH = 5,
  HALVINGS = 30; // nodes of a walk; solutions that a guess is made of

/** A draw of the scatter: from load to load while the film is clear, along the curve where folds may be. */
export class Draw extends Walker {
  /** @type {number[]} */
  loads;
  /** @type {any[]} */
  up;
  /** @type {any[]} */
  down;
  /** @type {any[]} */
  nodes;
  /** @type {number} */
  at0;
  /** @type {number} */
  at1;
  /** @type {number | null} */
  lost;
  /** @type {number | null} */
  regained;

  constructor(washer, point, loads) {
    super(washer, point, loads[0]);
    const { temp, pressure } = washer.places(),
      [nR, nT] = washer.grid;
    // A step sets how heat leaves the bodies, and is where loads on a clear film begin.
    const { mesh } = washer,
      own = ((washer.other ??= {})[washer.grid] ??= washer.kernel.array(mesh.state.length));
    own.view.fill(0);
    washer.mesh = { ...mesh, work: this.work };
    this.begun = washer.step([loads[0], ...point.slice(1)], washer.L.ANY, own);
    washer.mesh = mesh;
    Object.assign(this, {
      loads,
      up: [],
      down: [],
      at0: temp,
      at1: pressure + nR * nT,
      nodes: [],
      lost: null,
      regained: null,
      ended: null,
    });
  }

  *walk() {
    const { loads, up, down, nodes } = this;
    yield* this.clearFilm();
    if (up.length === loads.length) return { up, down };
    try {
      yield* this.curveOn();
    } catch {
      /* stuck: what lies beyond is solved by load, or missing */
    }
    const found = (way, load, on) => {
      try {
        return this.solveAlong(way, load, on);
      } catch {
        return null;
      }
    };
    const { lost, regained } = this,
      film = lost === null ? nodes : this.until(lost),
      contact = regained === null ? [] : this.beyond(regained);
    for (let i = up.length; i < loads.length; i += 1) {
      const there = found(film, loads[i], lost === null);
      if (there)
        up[i] = { ...there, branch: lost !== null || there.film_ratio >= FILM_RATIO ? "film" : "contact" };
      yield;
    }
    for (let i = 0; i < loads.length; i += 1) {
      const there = contact.length ? found(contact, loads[i], true) : null;
      if (there) (up[i] ? down : up)[i] = { ...there, branch: "contact" };
      up[i] ??= null;
      yield;
    }
    return { up, down };
  }

  get ratio() {
    const { L } = this,
      q = this.work.view.subarray(L.AT_POSITIONS);
    return (
      (q[L.Z_WASHER] - this.washer.mesh.par.view[L.P_OUTER_RADIUS] * Math.hypot(q[L.TILT_X], q[L.TILT_Y])) /
      this.sigma
    );
  }

  /** Tell if the film is thick, stable and carries the load, as the kernels' ``is_clear_film``. */
  get isClear() {
    return this.at(this.L.AT_SLOPE) < 0 && this.ratio >= FILM_RATIO && this.share < CLEAR;
  }

  /** Return what is needed to come back here. */
  here() {
    const { L } = this,
      v = this.work.view;
    return {
      load: this.load,
      film: this.film,
      curve: v.slice(L.AT_CURVE, L.AT_CURVE + L.ACCURACY),
      q: v.slice(L.AT_POSITIONS, L.N_HEAD),
      fields: v.slice(this.at0, this.at1),
    };
  }

  goTo({ curve, q, fields }) {
    const v = this.work.view;
    v.set(curve, this.L.AT_CURVE);
    v.set(q, this.L.AT_POSITIONS);
    v.set(fields, this.at0);
  }

  /** Stand where a polynomial through other solutions leads; `x`: what it goes over, of them and at the place. */
  guess(others, x, at) {
    const v = this.work.view,
      w = x.map((a, i) => x.reduce((f, b, j) => (i === j ? f : (f * (at - b)) / (a - b)), 1));
    /** @type {[string, number][]} */
    const pieces = [
      ["q", this.L.AT_POSITIONS],
      ["fields", this.at0],
    ];
    for (const [name, first] of pieces) {
      const parts = others.map((p) => p[name]);
      for (let k = 0; k < parts[0].length; k += 1) {
        let sum = 0;
        for (let i = 0; i < w.length; i += 1) sum += w[i] * parts[i][k];
        v[first + k] = sum;
      }
    }
  }

  /** Solve at a load from where other solutions lead, over the logarithm of the load. */
  solveFrom(others, load) {
    const { kernel, L } = this;
    this.guess(
      others,
      others.map((p) => Math.log(p.load)),
      Math.log(load),
    );
    const code = kernel.call("newton", ...this.w, ...this.point, L.MODE_LOAD, load, L.NO_FLOOR, EXACT, 12);
    if (!code) this.note();
    return !code;
  }

  /** Go from load to load as long as the film is clear; stand at the last such place. */
  *clearFilm() {
    const { loads, up, L } = this,
      found = [];
    this.at(L.ACCURACY, ROUGH);
    if (this.begun < this.washer.about.first_failure) this.note();
    if (this.begun || !this.isClear) {
      this.start(6);
      while (this.load > loads[0] && this.film < 1e3 * this.sigma) this.to(1.25 * this.film);
      return;
    }
    for (;;) {
      up.push({ ...this.result(), branch: "film" });
      found.push(this.here());
      if (found.length > REACH) found.shift();
      if (up.length === loads.length) return;
      yield;
      const load = loads[up.length],
        thinner = (this.load * Math.log(load / this.load)) / this.at(L.AT_SLOPE) / this.sigma;
      if (this.ratio + thinner < FILM_RATIO || !this.solveFrom(found, load) || !this.isClear) break;
    }
    this.nodes.push(...found.slice(-2, -1)); // a fold may be next to the last one
    this.goTo(found[found.length - 1]);
    this.forget();
  }

  /** Go on to thinner films until no fold can follow: nodes, and which of them are next to folds. */
  *curveOn() {
    const { nodes, loads } = this,
      last = loads[loads.length - 1];
    let top = nodes.push(this.here()) - 1,
      rising = true;
    for (;;) {
      const over = this.load >= last;
      if (
        rising &&
        (this.share > ALONE ||
          this.film < 0 ||
          (over && (this.lost !== null || this.film < 0.5 * this.sigma)))
      )
        return;
      if (nodes.length > MOST_NODES) throw new Error("the path along the curve does not end");
      yield;
      this.to(this.film - Math.max(COARSE * this.sigma, 0.12 * (this.film - 2.5 * this.sigma)));
      nodes.push(this.here());
      const gain = this.load - nodes[top].load,
        noise = SHALLOW * nodes[top].load + 1e-3,
        now = nodes.length - 1;
      if (rising ? gain < -noise : gain > noise) {
        if (rising) this.lost ??= top;
        else this.regained ??= top;
        if (rising && nodes[top].load > last) return; // the film is lost beyond the loads
        rising = !rising;
        top = now;
      } else if (rising ? gain > 0 : gain < 0) top = now;
    }
  }

  /** Return the nodes up to a fold next to node k, where the load is maximum, and the fold if a load is near. */
  until(k) {
    const fold =
      this.loads.some((load) => load > this.nodes[k].load && this.isNear(k, load)) && this.foldAt(k, 1);
    return fold
      ? [...this.nodes.slice(0, k + 1).filter((p) => p.film > fold.film), fold]
      : this.nodes.slice(0, k + 1);
  }

  /** Return the nodes from a fold next to node k on, where the load is minimum, and the fold if a load is near. */
  beyond(k) {
    const fold =
      this.loads.some((load) => load < this.nodes[k].load && this.isNear(k, load)) && this.foldAt(k, -1);
    return fold ? [fold, ...this.nodes.slice(k).filter((p) => p.film < fold.film)] : this.nodes.slice(k);
  }

  /** Tell if the fold next to node k may lie beyond a load, as the kernels' ``_near``. */
  isNear(k, load) {
    if (k === 0) return false;
    const [[s0, w0], [s1, w1], [s2, w2]] = this.nodes.slice(k - 1, k + 2).map((p) => [p.film, p.load]);
    const first = (w1 - w0) / (s1 - s0),
      bend = ((w2 - w1) / (s2 - s1) - first) / (s2 - s0),
      slope = first + bend * (s1 - s0);
    return Math.abs(w1 - load) < 0.02 * load + Math.min(0.25 * load, (1.25 * slope * slope) / Math.abs(bend));
  }

  /** Return the place of maximum (`sign` 1) or minimum load about node k, by parabolas through three places. */
  foldAt(k, sign) {
    let [one, top, two] = this.nodes.slice(k - 1, k + 2);
    for (let n = 0; n < 6; n += 1) {
      const [p, q] = [one, two].map((o) => (top.load - o.load) / (top.film - o.film)); // slopes of the chords
      const film = 0.5 * (top.film + one.film - (p * (two.film - one.film)) / (q - p));
      if (!(film < one.film && film > two.film) || Math.abs(film - top.film) < 1e-3 * this.sigma) break;
      this.goTo(top);
      try {
        this.to(film);
      } catch {
        break;
      }
      const found = this.here(),
        better = sign * (found.load - top.load) > 0;
      if (better) [one, top, two] = film > top.film ? [one, found, top] : [top, found, two];
      else if (film > top.film) one = found;
      else two = found;
    }
    return top;
  }

  /** Solve at a load between nodes of rising load, `on` beyond the last one too; null where it does not lie there. */
  solveAlong(nodes, load, on) {
    const i = nodes.findIndex((node) => node.load >= load);
    if (i === 0 || (i < 0 && (!on || this.ended === nodes))) return null;
    const near = i < 0 ? nodes.slice(-3) : nodes.slice(Math.max(0, i - 2), i + 1),
      end = near.at(-1);
    if (i < 0) {
      if (!this.solveFrom(near, load) && !this.climb(end, load)) {
        this.ended = nodes; // nor is there a solution at higher loads
        return null;
      }
      nodes.push(this.here());
    } else if (!this.solveFrom(near, load) || this.isOutside(near.at(-2), end))
      this.search(near.at(-2), end, load);
    return this.result();
  }

  /** Solve at a load above a solution in 2, 4 or 8 steps; tell if that goes. */
  climb(from, load) {
    return [2, 4, 8].some((steps) => {
      const before = [from];
      for (let n = 1; n <= steps; n += 1) {
        if (!this.solveFrom(before.slice(-2), from.load * (load / from.load) ** (n / steps))) return false;
        before.push(this.here());
      }
      return true;
    });
  }

  isOutside(upper, lower) {
    return (
      this.film > upper.film + 0.1 * (upper.film - lower.film) ||
      this.film < lower.film - 0.1 * (upper.film - lower.film)
    );
  }

  /** Solve at a load between two nodes that Newton's method alone does not find. */
  search(upper, lower, load) {
    for (let n = 0; n < HALVINGS; n += 1) {
      this.goTo(upper);
      this.forget();
      this.to(0.5 * (upper.film + lower.film));
      if (this.load < load) upper = this.here();
      else lower = this.here();
      if (this.solveFrom([upper, lower], load) && !this.isOutside(upper, lower)) return;
    }
    throw new Error(`no solution found at ${load} N`);
  }
}
