"use strict";
/* The thrust washer: points, fields, load curve and Stribeck curve, as the Python API solves them. */

const MOST_DRAWN = 64, CLEAR = 0.01, FILM_RATIO = 3, COARSE = 0.28, ROUGH = 1e-4, EXACT = 2e-6, MOST_NODES = 200, REACH = 5; // of draws
const GOLDEN = 0.618, MOST_LOADS = 100, FINEST = 0.1, ALONE = 0.9, STEEP = 1.1, SHALLOW = 3e-4;

class Model {
  constructor(kernel, about) {
    Object.assign(this, { kernel, about, L: about.layout, meshes: {} });
    const { L } = this;
    this.inp = kernel.array(L.NINP + 1);
    this.out = kernel.array(L.NOUT);
    this.iout = kernel.array(L.NIOUT, Int32Array);
  }

  /** Take parameters [numbers in their order] and a rung; return the number of a broken rule. */
  set(parameters, rung) {
    const broken = this.fill((this.mesh = this.memory(rung)), parameters, rung);
    this.grid = this.about.rungs[rung].grid;
    return broken;
  }

  /** Return memory for a rung, one of each name. */
  memory(rung, name = rung) {
    const { kernel } = this, { sizes } = this.about.rungs[rung];
    return (this.meshes[name] ??= {
      par: kernel.array(sizes.par), state: kernel.array(sizes.state),
      work: kernel.array(sizes.work), curve: kernel.array(sizes.work),
    });
  }

  /** Fill the constants of a mesh; return the number of a broken rule, -1 if no constants follow. */
  fill({ par, state }, parameters, rung) {
    const { kernel, L } = this, { grid, code } = this.about.rungs[rung];
    par.view.fill(0);
    par.view.set([...parameters, code]);
    par.view[L.P_THERMAL_MODE] = L.QUASI_STEADY;
    state.view.fill(0);
    return kernel.call("broken_rule", par) || (kernel.call("derive_grid", par, ...grid) ? -1 : 0);
  }

  /** Solve at (load, speed, tilt, oil, far face); `state` remembers. */
  step(point, branchCode, state) {
    this.inp.view.set([...point, branchCode]);
    const { par, work } = this.mesh;
    return this.kernel.call("step", par, this.inp, state, work, this.out, this.iout, 0, 1);
  }

  /**
   * Solve on from the last solution, or, `fresh`, from nothing: then the numbers are those of
   * solve_washer. A fresh solution stays on the branch that is named.
   */
  solve(point, fresh, branch) {
    const { L } = this, { state, work } = this.mesh;
    const branchCode = L[{ film: "FILM_BRANCH", contact: "CONTACT_BRANCH" }[branch]] ?? L.ANY;
    const afresh = (on) => (state.view.fill(0), this.step(point, on, state));
    const found = () => work.view[L.AT_FOUND + L.BRANCH];
    let code = fresh ? afresh(L.ANY) : this.step(point, L.ANY, state), asked = false, missing = false;
    if (fresh && branchCode !== L.ANY && code < this.about.first_failure && found() !== branchCode) {
      asked = afresh(branchCode) === 0 && found() === branchCode;
      missing = !asked;
      code = asked ? 0 : afresh(L.ANY);
    }
    return { code, outputs: this.outputs(), asked, missing, fields: this.fields(point) };
  }

  outputs() {
    const { L, about } = this, head = this.mesh.work.view, iout = this.iout.view, found = {};
    about.real_outputs.forEach((name, i) => (found[name] = head[L.AT_OUTPUTS + i]));
    found.fluid_load = head[L.AT_OUTPUTS + L.O_FLUID_LOAD];
    found.contact_load = head[L.AT_OUTPUTS + L.O_CONTACT_LOAD];
    found.washer_tilt_x = head[L.AT_POSITIONS + L.TILT_X];
    found.washer_tilt_y = head[L.AT_POSITIONS + L.TILT_Y];
    found.iterations = head[L.ITERATIONS];
    const branch = head[L.AT_FOUND + L.BRANCH];
    found.branch = branch === L.CONTACT_BRANCH ? "contact" : branch === L.UNSTABLE ? "unstable" : "film";
    return { ...found, regime: iout[L.IO_REGIME], distress: iout[L.IO_DISTRESS], solver_status: iout[L.IO_STATUS] };
  }

  /** Where the fields lie in work: as the kernels' ``fields_of`` and ``washer_model`` divide it. */
  places() {
    const { L } = this, par = this.mesh.par.view, [nR, nT] = this.grid, n = nR * nT;
    const column = par[L.D_PER_COLUMN], rings = par[L.D_RINGS], band = column * nT, temps = band + rings;
    const sides = Math.ceil(rings / L.N_SIDES) * L.N_SIDES, factor = L.N_TAG + 1 + temps;
    const following = factor + band * (4 * (2 * column + 1) + 2 * sides) + sides * (sides + 1);
    const nodal = L.N_HEAD + following + 4 * temps + L.N_SMALL;
    const temp = nodal + L.N_NODAL * n + nT + (2 * nR + 1) * n + 3 * L.N_SIDES * n;
    const cooled = par[L.P_OIL_COOLING] !== 0;
    let carrier = [cooled ? nR : 0, column], washer = [carrier[0] + nR, column];
    if (par[L.P_CONDUCTION] === L.ONLY_CARRIER) washer = [band, 0];
    else if (par[L.P_CONDUCTION] === L.ONLY_ROTATING) [carrier, washer] = [[band, 0], carrier];
    return { contact: nodal + 2 * n, temp, pressure: temp + temps, carrier, washer, film: cooled ? [0, column] : null };
  }

  /** Film, pressures and temperatures of carrier and washer over the nodes, angle by angle. */
  fields(point) {
    const { L } = this, [nR, nT] = this.grid, n = nR * nT, at = this.places();
    const par = this.mesh.par.view, work = this.mesh.work.view, mesh = L.D_MESH + L.N_RADIAL * nR;
    const radius = par.slice(L.D_MESH + L.RADIUS * nR, L.D_MESH + (L.RADIUS + 1) * nR);
    const cos = par.slice(mesh + L.COS * nT, mesh + (L.COS + 1) * nT);
    const sin = par.slice(mesh + L.SIN * nT, mesh + (L.SIN + 1) * nT);
    const q = work.slice(L.AT_POSITIONS, L.N_HEAD), film = new Float64Array(n), warm = new Float64Array(n), own = new Float64Array(n);
    for (let j = 0; j < nT; j += 1) {
      for (let i = 0; i < nR; i += 1) {
        const k = j * nR + i;
        film[k] = q[L.Z_WASHER] + radius[i] * (sin[j] * q[L.TILT_X] - cos[j] * q[L.TILT_Y]);
        warm[k] = point[L.I_OIL] + work[at.temp + at.carrier[0] + i + j * at.carrier[1]];
        own[k] = point[L.I_OIL] + work[at.temp + at.washer[0] + i + j * at.washer[1]];
      }
    }
    return {
      radius, angle: Float64Array.from(sin, (s, j) => (Math.atan2(s, cos[j]) + 2 * Math.PI) % (2 * Math.PI)),
      film_thickness: film, pressure: work.slice(at.pressure, at.pressure + n),
      contact_pressure: work.slice(at.contact, at.contact + n), carrier_temperature: warm, washer_temperature: own,
    };
  }

  /** Go along speeds at one load, down from the fastest, then up again: rows of outputs. */
  *stribeck(point, speeds) {
    const { L } = this, rows = [], state = (this.other ??= {})[this.grid] ??= this.kernel.array(this.mesh.state.length);
    const kept = this.mesh.work;
    state.view.fill(0);
    const order = speeds.map((_, i) => speeds.length - 1 - i);
    for (const i of [...order, ...order.slice().reverse()]) {
      const inputs = point.slice();
      inputs[L.I_SPEED] = speeds[i];
      this.mesh = { ...this.mesh, work: this.mesh.curve };
      const code = this.step(inputs, L.ANY, state), o = this.outputs();
      this.mesh = { ...this.mesh, work: kept };
      if (code < this.about.first_failure) rows.push({ up: rows.length >= speeds.length, speed: speeds[i], ...o });
      yield rows;
    }
    return { rows };
  }

  /**
   * Go over rising loads with the parameters and inputs of a draw of the scatter. Return outputs by load, `up` on the film
   * branch to its fold, then in contact, `down` only where the contact branch is another solution; or a `broken` rule.
   */
  *draw(parameters, rung, point, loads) {
    const kept = [this.mesh, this.grid], { grid } = this.about.rungs[rung], mesh = this.memory(rung, `${rung}, draws`);
    const [broken, par] = this.constants(mesh, parameters, rung);
    if (broken) return { broken };
    const own = () => ([this.mesh, this.grid] = [{ ...mesh, par }, grid]), back = () => ([this.mesh, this.grid] = kept);
    own();
    const steps = new Draw(this, point, loads).walk();
    for (let step = steps.next(); ; own(), step = steps.next()) {
      back();
      if (step.done) return step.value;
      yield;
    }
  }

  /** Return the number of a broken rule and the constants of a draw, made once for the same parameters. */
  constants({ state }, parameters, rung) {
    const known = (this.drawn ??= new Map()), key = JSON.stringify([parameters, rung]), size = this.about.rungs[rung].sizes.par;
    if (!known.has(key)) {
      const oldest = known.size < MOST_DRAWN ? undefined : known.keys().next().value, free = known.get(oldest)?.[1];
      known.delete(oldest);
      const par = free?.length === size ? free : this.kernel.array(size);
      known.set(key, [this.fill({ par, state }, parameters, rung), par]);
    }
    return known.get(key);
  }

  /** All solutions between two loads: the walk of Python's load_curve, point by point. */
  *curve(point, loadMin, loadMax) {
    const here = new Walker(this, point, loadMin), points = [], folds = [], places = [];
    here.start(6.0);
    while (here.load > loadMin && here.film < 1e3 * here.sigma) here.to(1.25 * here.film);
    const add = () => (places.push(here.film), points.push(here.result()));
    add();
    let top = 0, rising = true, byLoad = false;
    while (points.at(-1).load < loadMax || !rising) {
      const last = points.at(-1), steep = points.length > 1 && last.load > STEEP * points.at(-2).load;
      byLoad = rising && (byLoad || (steep && here.share > ALONE));
      if (!byLoad) {
        try {
          here.to(here.film - Math.max(FINEST * here.sigma, 0.12 * (here.film - 2.5 * here.sigma)));
        } catch (stuck) {
          byLoad = rising && (folds.length > 0 || here.film < 0);
          if (!byLoad) throw stuck;
        }
      }
      if (byLoad) here.toLoad(STEEP * here.load);
      add();
      const gain = points.at(-1).load - points[top].load, noise = SHALLOW * points[top].load + 1e-3;
      if (rising ? gain < -noise : gain > noise) {
        rising = !rising;
        folds.push(here.fold(rising ? "film_regained" : "film_lost", places[Math.max(0, top - 1)], places.at(-1)));
        top = points.length - 1;
      } else if (rising ? gain > 0 : gain < 0) top = points.length - 1;
      yield points;
    }
    for (const p of points) {
      const passed = folds.filter((fold) => p.film_ratio < fold.film_ratio).length;
      p.branch = !folds.length ? (p.film_ratio >= 3 ? "film" : "contact") : passed % 2 ? "unstable" : passed ? "contact" : "film";
    }
    return { points, folds };
  }
}

/** A place on the curve of solutions, which moves as its film thickness is prescribed. */
class Walker {
  constructor(washer, point, load) {
    const { kernel, L } = washer, { par, curve: work, state } = washer.mesh;
    Object.assign(this, { kernel, L, washer, work, point: [load, ...point.slice(1)], sigma: par.view[L.D_SIGMA1] });
    // A step sets how heat leaves the bodies; the curve does not use what it found.
    const own = (washer.other ??= {})[washer.grid] ??= kernel.array(state.length);
    own.view.fill(0);
    const mesh = washer.mesh;
    washer.mesh = { ...mesh, work };
    this.begun = washer.step(this.point, L.ANY, own);
    washer.mesh = mesh;
    const bulk = par.view[L.P_GEAR_FAR_FACE] === L.BULK && point[L.I_FAR_FACE];
    this.point[L.I_FAR_FACE] = bulk || point[L.I_OIL]; // as the kernels' point_of
    this.w = [
      par, work.part(L.N_HEAD), work.part(0, L.N_INFO), work.part(L.AT_FOUND, L.AT_CURVE),
      work.part(L.AT_CURVE, L.AT_OUTPUTS), work.part(L.AT_OUTPUTS, L.AT_POSITIONS), work.part(L.AT_POSITIONS, L.N_HEAD),
    ];
    this.at(L.ACCURACY, 1e-8);
  }

  at(place, value) {
    const view = this.work.view, k = this.L.AT_CURVE + place;
    if (value !== undefined) view[k] = value;
    return view[k];
  }

  get film() { return this.at(this.L.AT_FILM); }
  get load() { return this.at(this.L.AT_LOAD); }
  get share() { return this.at(this.L.AT_SHARE); }

  check(code) { if (code) throw new Error(this.washer.about.statuses[code] ?? `status ${code}`); }

  start(ratio) { this.check(this.kernel.call("enter_curve", ...this.w, ...this.point, ratio)); }
  forget() { this.work.view[this.L.N_HEAD + this.L.TAG_VALID] = 0; }

  to(film) {
    const walk = () => this.kernel.call("walk_to", ...this.w, ...this.point, film), { L } = this;
    let code = walk();
    if (code) {
      this.at(L.ACCURACY, this.at(L.ACCURACY) * 100);
      code = walk();
      this.at(L.ACCURACY, this.at(L.ACCURACY) * 0.01);
    }
    if (code && film < this.film && this.share > ALONE) {
      for (let i = 0; i < MOST_LOADS && this.film > film; i += 1) this.toLoad(1.02 * this.load);
      code = walk();
    }
    this.check(code);
  }

  toLoad(load) {
    const { kernel, L } = this;
    while (this.load < load * (1 - 1e-9)) {
      let step = load - this.load, code = 0;
      kernel.call("remember", ...this.w, 0);
      for (let i = 0; i < 12; i += 1) {
        code = kernel.call("newton", ...this.w, ...this.point, L.MODE_LOAD, this.load + step, L.NO_FLOOR, this.at(L.ACCURACY), 20);
        if (!code) break;
        kernel.call("recall", ...this.w, 0);
        this.forget();
        step *= 0.4;
      }
      this.check(code);
      this.note();
    }
  }

  /** Write where on the curve the present solution is, as the kernels' ``note``. */
  note() {
    const { L } = this, view = this.work.view, par = this.washer.mesh.par.view, q = view.subarray(L.AT_POSITIONS);
    const reached = view[L.REACHED_LOAD], e = 0.05 * this.sigma, r = par[L.P_OUTER_RADIUS];
    this.at(L.AT_FILM, q[L.Z_WASHER] - Math.sqrt(r * r * (q[L.TILT_X] ** 2 + q[L.TILT_Y] ** 2) + e * e));
    this.at(L.AT_LOAD, reached);
    this.at(L.AT_SLOPE, view[L.LOAD_SLOPE]);
    const [nR, nT] = this.washer.grid, small = this.washer.places().contact - 2 * nR * nT - L.N_SMALL;
    this.at(L.AT_SHARE, view[small + L.CONTACT] / Math.max(reached, 1e-12));
  }

  fold(kind, upper, lower) {
    const kept = this.work.view.slice(), sign = kind === "film_lost" ? 1 : -1;
    const back = () => (this.work.view.set(kept), this.forget());
    if (this.kernel.call("find_fold", ...this.w, ...this.point, upper, lower)) {
      back();
      while (upper - lower > 1e-3 * this.sigma) {
        const loads = [GOLDEN, 1 - GOLDEN].map((part) => (this.to(lower + part * (upper - lower)), sign * this.load));
        if (loads[0] > loads[1]) lower += (1 - GOLDEN) * (upper - lower);
        else upper -= (1 - GOLDEN) * (upper - lower);
      }
    }
    const found = { kind, ...this.result() };
    back();
    return found;
  }

  result() {
    const { L } = this, load = this.load;
    this.kernel.call("outputs_at", ...this.w, load, ...this.point.slice(1));
    const out = this.work.view.slice(L.AT_OUTPUTS, L.AT_POSITIONS), found = { load };
    this.washer.about.real_outputs.forEach((name, i) => (found[name] = out[i]));
    return found;
  }
}

/** A draw of the scatter: from load to load while the film is clear, along the curve where folds may be. */
class Draw extends Walker {
  constructor(washer, point, loads) {
    super(washer, point, loads[0]);
    const { temp, pressure } = washer.places(), [nR, nT] = washer.grid;
    Object.assign(this, { loads, up: [], down: [], at0: temp, at1: pressure + nR * nT, nodes: [], lost: null, regained: null });
  }

  *walk() {
    const { loads, up, down, nodes } = this;
    yield* this.clearFilm();
    if (up.length === loads.length) return { up, down };
    try {
      yield* this.curveOn();
    } catch { /* stuck: what lies beyond is solved by load, or missing */ }
    const found = (way, load, on) => {
      try {
        return this.solveAlong(way, load, on);
      } catch {
        return null;
      }
    };
    const { lost, regained } = this, film = lost === null ? nodes : this.until(lost), contact = regained === null ? [] : this.beyond(regained);
    for (let i = up.length; i < loads.length; i += 1) {
      const there = found(film, loads[i], lost === null);
      if (there) up[i] = { ...there, branch: lost !== null || there.film_ratio >= FILM_RATIO ? "film" : "contact" };
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
    const { L } = this, q = this.work.view.subarray(L.AT_POSITIONS);
    return (q[L.Z_WASHER] - this.washer.mesh.par.view[L.P_OUTER_RADIUS] * Math.hypot(q[L.TILT_X], q[L.TILT_Y])) / this.sigma;
  }

  /** Tell if the film is thick, stable and carries the load, as the kernels' ``is_clear_film``. */
  get isClear() { return this.at(this.L.AT_SLOPE) < 0 && this.ratio >= FILM_RATIO && this.share < CLEAR; }

  /** Return what is needed to come back here. */
  here() {
    const { L } = this, v = this.work.view;
    return { load: this.load, film: this.film, curve: v.slice(L.AT_CURVE, L.AT_CURVE + L.ACCURACY), q: v.slice(L.AT_POSITIONS, L.N_HEAD), fields: v.slice(this.at0, this.at1) };
  }

  goTo({ curve, q, fields }) {
    const v = this.work.view;
    v.set(curve, this.L.AT_CURVE);
    v.set(q, this.L.AT_POSITIONS);
    v.set(fields, this.at0);
  }

  /** Solve at a load from where a polynomial through other solutions leads, over the logarithm of the load. */
  solveFrom(others, load) {
    const { kernel, L } = this, v = this.work.view, x = others.map((p) => Math.log(p.load)), at = Math.log(load);
    const w = x.map((a, i) => x.reduce((f, b, j) => (i === j ? f : (f * (at - b)) / (a - b)), 1));
    for (const [name, first] of [["q", L.AT_POSITIONS], ["fields", this.at0]]) {
      const parts = others.map((p) => p[name]);
      for (let k = 0; k < parts[0].length; k += 1) {
        let sum = 0;
        for (let i = 0; i < w.length; i += 1) sum += w[i] * parts[i][k];
        v[first + k] = sum;
      }
    }
    const code = kernel.call("newton", ...this.w, ...this.point, L.MODE_LOAD, load, L.NO_FLOOR, EXACT, 12);
    if (!code) this.note();
    return !code;
  }

  /** Go from load to load as long as the film is clear; stand at the last such place. */
  *clearFilm() {
    const { loads, up, L } = this, found = [];
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
      const load = loads[up.length], thinner = this.load * Math.log(load / this.load) / this.at(L.AT_SLOPE) / this.sigma;
      if (this.ratio + thinner < FILM_RATIO || !this.solveFrom(found, load) || !this.isClear) break;
    }
    this.nodes.push(...found.slice(-2, -1)); // a fold may be next to the last one
    this.goTo(found.at(-1));
    this.forget();
  }

  /** Walk on to thinner films until no fold can follow: nodes, and which of them are next to folds. */
  *curveOn() {
    const { nodes, loads } = this, last = loads.at(-1);
    let top = nodes.push(this.here()) - 1, rising = true;
    for (;;) {
      const over = this.load >= last;
      if (rising && (this.share > ALONE || (over && (this.lost !== null || this.film < 0.5 * this.sigma)))) return;
      if (nodes.length > MOST_NODES) throw new Error("the walk along the curve does not end");
      yield;
      this.to(this.film - Math.max(COARSE * this.sigma, 0.12 * (this.film - 2.5 * this.sigma)));
      nodes.push(this.here());
      const gain = this.load - nodes[top].load, noise = SHALLOW * nodes[top].load + 1e-3, now = nodes.length - 1;
      if (rising ? gain < -noise : gain > noise) {
        if (rising) this.lost ??= top;
        else this.regained ??= top;
        if (rising && nodes[top].load > last) return; // the film is lost beyond the loads
        rising = !rising;
        top = now;
      } else if (rising ? gain > 0 : gain < 0) top = now;
    }
  }

  /** Return the nodes up to a fold next to node k, where the load is greatest, and the fold if a load is near. */
  until(k) {
    const fold = this.loads.some((load) => load > this.nodes[k].load && this.isNear(k, load)) && this.foldAt(k, 1);
    return fold ? [...this.nodes.slice(0, k + 1).filter((p) => p.film > fold.film), fold] : this.nodes.slice(0, k + 1);
  }

  /** Return the nodes from a fold next to node k on, where the load is least, and the fold if a load is near. */
  beyond(k) {
    const fold = this.loads.some((load) => load < this.nodes[k].load && this.isNear(k, load)) && this.foldAt(k, -1);
    return fold ? [fold, ...this.nodes.slice(k).filter((p) => p.film < fold.film)] : this.nodes.slice(k);
  }

  /** Tell if the fold next to node k may lie beyond a load, as the kernels' ``_near``. */
  isNear(k, load) {
    if (k === 0) return false;
    const [[s0, w0], [s1, w1], [s2, w2]] = this.nodes.slice(k - 1, k + 2).map((p) => [p.film, p.load]);
    const first = (w1 - w0) / (s1 - s0), bend = ((w2 - w1) / (s2 - s1) - first) / (s2 - s0), slope = first + bend * (s1 - s0);
    return Math.abs(w1 - load) < 0.02 * load + Math.min(0.25 * load, (1.25 * slope * slope) / Math.abs(bend));
  }

  /** Return the place of greatest (`sign` 1) or least load about node k, by parabolas through three places. */
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
      const found = this.here(), better = sign * (found.load - top.load) > 0;
      if (better) [one, top, two] = film > top.film ? [one, found, top] : [top, found, two];
      else if (film > top.film) one = found;
      else two = found;
    }
    return top;
  }

  /** Solve at a load between nodes of rising load, `on` beyond the last one too; null where it does not lie there. */
  solveAlong(nodes, load, on) {
    const i = nodes.findIndex((node) => node.load >= load);
    if (i === 0 || (i < 0 && !on)) return null;
    const near = i < 0 ? nodes.slice(-3) : nodes.slice(Math.max(0, i - 2), i + 1), end = near.at(-1);
    if (i < 0) {
      if (!this.solveFrom(near, load)) {
        this.goTo(end);
        this.forget();
        this.toLoad(load);
      }
      nodes.push(this.here());
    } else if (!this.solveFrom(near, load) || this.isOutside(near.at(-2), end)) this.search(near.at(-2), end, load);
    return this.result();
  }

  isOutside(upper, lower) { return this.film > upper.film + 0.1 * (upper.film - lower.film) || this.film < lower.film - 0.1 * (upper.film - lower.film); }

  /** Solve at a load between two nodes that Newton's method alone does not find. */
  search(upper, lower, load) {
    for (let n = 0; n < 30; n += 1) {
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
