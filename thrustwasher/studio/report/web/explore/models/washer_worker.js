/* The thrust washer: points, fields, load curve and Stribeck curve, as the Python API solves them. */

import { Draw } from "./washer_draw.js";
import { Walker } from "./washer_walk.js";

const MOST_DRAWN = 64; // draws whose constants are kept

export class Model {
  /** @type {Record<string, number>} */
  L;
  /** @type {any} */
  about;
  /** @type {import("../kernel.js").Kernel} */
  kernel;
  /** @type {Record<string, any>} */
  meshes;
  /** @type {Map<string, any> | undefined} */
  drawn;
  /** @type {Record<string, any> | undefined} */
  other;
  /** @type {import("../kernel.js").Numbers | undefined} */
  whole;

  constructor(kernel, about) {
    Object.assign(this, { kernel, about, L: about.layout, meshes: {} });
    const { L } = this;
    this.inp = kernel.array(L.NINP + 1);
    this.out = kernel.array(L.NOUT);
    this.iout = kernel.array(L.NIOUT, Int32Array);
  }

  /** Take parameters [numbers in their order] and a level; return the number of a broken rule. */
  set(parameters, level) {
    const broken = this.fill((this.mesh = this.memory(level)), parameters, level);
    this.grid = this.about.levels[level].grid;
    return broken;
  }

  /** Return memory for a level, one of each name. */
  memory(level, name = level) {
    const { kernel } = this,
      { sizes } = this.about.levels[level];
    return (this.meshes[name] ??= {
      par: kernel.array(sizes.par),
      state: kernel.array(sizes.state),
      work: kernel.array(sizes.work),
      curve: kernel.array(sizes.work),
    });
  }

  /** Fill the constants of a mesh; return the number of a broken rule, -1 if no constants follow. */
  fill({ par, state }, parameters, level) {
    const { kernel, L } = this,
      { grid, code } = this.about.levels[level];
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
    const { L } = this,
      { state, work } = this.mesh;
    const branchCode = L[{ film: "FILM_BRANCH", contact: "CONTACT_BRANCH" }[branch]] ?? L.ANY;
    const afresh = (on) => (state.view.fill(0), this.step(point, on, state));
    const found = () => work.view[L.AT_FOUND + L.BRANCH];
    let code = fresh ? afresh(L.ANY) : this.step(point, L.ANY, state),
      asked = false,
      missing = false;
    if (fresh && branchCode !== L.ANY && code < this.about.first_failure && found() !== branchCode) {
      asked = afresh(branchCode) === 0 && found() === branchCode;
      missing = !asked;
      code = asked ? 0 : afresh(L.ANY);
    }
    return { code, outputs: this.outputs(), asked, missing, fields: this.fields(point) };
  }

  outputs() {
    const { L, about } = this,
      head = this.mesh.work.view,
      iout = this.iout.view,
      found = {};
    about.real_outputs.forEach((name, i) => (found[name] = head[L.AT_OUTPUTS + i]));
    found.fluid_load = head[L.AT_OUTPUTS + L.O_FLUID_LOAD];
    found.contact_load = head[L.AT_OUTPUTS + L.O_CONTACT_LOAD];
    found.washer_tilt_x = head[L.AT_POSITIONS + L.TILT_X];
    found.washer_tilt_y = head[L.AT_POSITIONS + L.TILT_Y];
    found.iterations = head[L.ITERATIONS];
    const branch = head[L.AT_FOUND + L.BRANCH];
    found.branch = branch === L.CONTACT_BRANCH ? "contact" : branch === L.UNSTABLE ? "unstable" : "film";
    return {
      ...found,
      regime: iout[L.IO_REGIME],
      distress: iout[L.IO_DISTRESS],
      solver_status: iout[L.IO_STATUS],
    };
  }

  /** Where the fields lie in work: as the kernels' ``fields_of`` and ``washer_model`` divide it. */
  places() {
    const { L } = this,
      par = this.mesh.par.view,
      [nR, nT] = this.grid,
      n = nR * nT;
    const column = par[L.D_PER_COLUMN],
      rings = par[L.D_RINGS],
      band = column * nT,
      temps = band + rings;
    const sides = Math.ceil(rings / L.N_SIDES) * L.N_SIDES,
      factor = L.N_TAG + 1 + temps;
    const following = factor + band * (4 * (2 * column + 1) + 2 * sides) + sides * (sides + 1);
    const nodal = L.N_HEAD + following + 4 * temps + L.N_SMALL;
    const temp = nodal + L.N_NODAL * n + nT + (2 * nR + 1) * n + 3 * L.N_SIDES * n;
    const cooled = par[L.P_OIL_COOLING] !== 0;
    let carrier = [cooled ? nR : 0, column],
      washer = [carrier[0] + nR, column];
    if (par[L.P_CONDUCTION] === L.ONLY_CARRIER) washer = [band, 0];
    else if (par[L.P_CONDUCTION] === L.ONLY_ROTATING) [carrier, washer] = [[band, 0], carrier];
    return {
      contact: nodal + 2 * n,
      temp,
      pressure: temp + temps,
      carrier,
      washer,
      film: cooled ? [0, column] : null,
    };
  }

  /** Film, pressures and temperatures of carrier and washer over the nodes, angle by angle. */
  fields(point) {
    const { L } = this,
      [nR, nT] = this.grid,
      n = nR * nT,
      at = this.places();
    const par = this.mesh.par.view,
      work = this.mesh.work.view,
      mesh = L.D_MESH + L.N_RADIAL * nR;
    const radius = par.slice(L.D_MESH + L.RADIUS * nR, L.D_MESH + (L.RADIUS + 1) * nR);
    const cos = par.slice(mesh + L.COS * nT, mesh + (L.COS + 1) * nT);
    const sin = par.slice(mesh + L.SIN * nT, mesh + (L.SIN + 1) * nT);
    const q = work.slice(L.AT_POSITIONS, L.N_HEAD),
      film = new Float64Array(n),
      warm = new Float64Array(n),
      own = new Float64Array(n);
    for (let j = 0; j < nT; j += 1) {
      for (let i = 0; i < nR; i += 1) {
        const k = j * nR + i;
        film[k] = q[L.Z_WASHER] + radius[i] * (sin[j] * q[L.TILT_X] - cos[j] * q[L.TILT_Y]);
        warm[k] = point[L.I_OIL] + work[at.temp + at.carrier[0] + i + j * at.carrier[1]];
        own[k] = point[L.I_OIL] + work[at.temp + at.washer[0] + i + j * at.washer[1]];
      }
    }
    return {
      radius,
      angle: Float64Array.from(sin, (s, j) => (Math.atan2(s, cos[j]) + 2 * Math.PI) % (2 * Math.PI)),
      film_thickness: film,
      pressure: work.slice(at.pressure, at.pressure + n),
      contact_pressure: work.slice(at.contact, at.contact + n),
      carrier_temperature: warm,
      washer_temperature: own,
    };
  }

  /** Go along speeds at one load, down from the fastest, then up again: rows of outputs. */
  *stribeck(point, speeds) {
    const { L } = this,
      rows = [],
      state = ((this.other ??= {})[this.grid] ??= this.kernel.array(this.mesh.state.length));
    const kept = this.mesh.work;
    state.view.fill(0);
    const order = speeds.map((_, i) => speeds.length - 1 - i);
    for (const i of [...order, ...order.slice().reverse()]) {
      const inputs = point.slice();
      inputs[L.I_SPEED] = speeds[i];
      this.mesh = { ...this.mesh, work: this.mesh.curve };
      const code = this.step(inputs, L.ANY, state),
        o = this.outputs();
      this.mesh = { ...this.mesh, work: kept };
      if (code < this.about.first_failure)
        rows.push({ up: rows.length >= speeds.length, speed: speeds[i], ...o });
      yield rows;
    }
    return { rows };
  }

  /**
   * Go over rising loads with the parameters and inputs of a draw of the scatter. Return outputs by load, `up` on the film
   * branch to its fold, then in contact, `down` only where the contact branch is another solution; or a `broken` rule.
   */
  *draw(parameters, level, point, loads) {
    const kept = [this.mesh, this.grid],
      { grid } = this.about.levels[level],
      mesh = this.memory(level, `${level}, draws`);
    const [broken, par] = this.constants(mesh, parameters, level);
    if (broken) return { broken };
    const own = () => ([this.mesh, this.grid] = [{ ...mesh, par }, grid]),
      back = () => ([this.mesh, this.grid] = kept);
    own();
    const steps = new Draw(this, point, loads).walk();
    for (let step = steps.next(); ; own(), step = steps.next()) {
      back();
      if (step.done) return step.value;
      yield;
    }
  }

  /** Return the number of a broken rule and the constants of a draw, made once for the same parameters. */
  constants({ state }, parameters, level) {
    const known = (this.drawn ??= new Map()),
      key = JSON.stringify([parameters, level]),
      size = this.about.levels[level].sizes.par;
    if (!known.has(key)) {
      const oldest = known.size < MOST_DRAWN ? undefined : known.keys().next().value,
        free = known.get(oldest)?.[1];
      known.delete(oldest);
      const par = free?.length === size ? free : this.kernel.array(size);
      known.set(key, [this.fill({ par, state }, parameters, level), par]);
    }
    return known.get(key);
  }

  /** All solutions between two loads: the path of Python's load_curve, point by point. */
  *curve(point, loadMin, loadMax) {
    const { L } = this,
      here = new Walker(this, point, loadMin),
      points = /** @type {any[]} */ ([]),
      folds = /** @type {any[]} */ ([]),
      whole = (this.whole ??= this.kernel.array(L.N_WHOLE));
    here.go("begin_curve", loadMin, whole);
    points.push(here.result());
    while (points.at(-1).load < loadMax || !whole.view[L.RISES]) {
      here.go("next_point", whole);
      points.push(here.result());
      here.go("pass_fold", whole);
      const [fold, load, ...out] = whole.view.subarray(L.FOLD);
      if (fold) folds.push({ kind: fold > 0 ? "film_lost" : "film_regained", ...here.named(load, out) });
      yield points;
    }
    for (const p of points) {
      const passed = folds.filter((fold) => p.film_ratio < fold.film_ratio).length;
      p.branch = !folds.length
        ? p.film_ratio >= 3
          ? "film"
          : "contact"
        : passed % 2
          ? "unstable"
          : passed
            ? "contact"
            : "film";
    }
    return { points, folds };
  }
}
