/* The thrust washer: points, fields, load curve, Stribeck curve and draws of the scatter, by the kernels of the Python API. */

const MOST_DRAWN = 64; // draws whose constants are kept
const AT_ONCE = 2; // rows between two looks for messages

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
  /** @type {Record<string, import("../kernel.js").Numbers> | undefined} */
  whole;
  /** @type {Record<string, import("../kernel.js").Numbers> | undefined} */
  rooms;

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

  /** Throw what is in the way, if a kernel's status is not 0. */
  check(code) {
    if (code) throw new Error(this.about.statuses[code] ?? `status ${code}`);
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
      found = this.named(head.subarray(L.AT_OUTPUTS, L.AT_POSITIONS));
    found.fluid_load = head[L.AT_OUTPUTS + L.O_FLUID_LOAD];
    found.contact_load = head[L.AT_OUTPUTS + L.O_CONTACT_LOAD];
    found.washer_tilt_x = head[L.AT_POSITIONS + L.TILT_X];
    found.washer_tilt_y = head[L.AT_POSITIONS + L.TILT_Y];
    found.iterations = head[L.ITERATIONS];
    found.branch = about.branches[head[L.AT_FOUND + L.BRANCH]] ?? "film";
    return {
      ...found,
      regime: iout[L.IO_REGIME],
      distress: iout[L.IO_DISTRESS],
      solver_status: iout[L.IO_STATUS],
    };
  }

  /** Return outputs by name. */
  named(out) {
    return Object.fromEntries(this.about.real_outputs.map((name, i) => [name, out[i]]));
  }

  /** Film, pressures and temperatures of carrier and washer over the nodes, angle by angle. */
  fields(point) {
    const { kernel, L, mesh } = this,
      [nR, nT] = this.grid,
      n = nR * nT,
      rows = (mesh.fields ??= kernel.array(L.N_FIELDS * n + nT)),
      row = (k) => rows.view.slice(k * n, (k + 1) * n);
    this.inp.view.set(point);
    kernel.call("fill_fields", mesh.par, this.inp, mesh.work, rows);
    return {
      radius: mesh.par.view.slice(L.D_MESH + L.RADIUS * nR, L.D_MESH + (L.RADIUS + 1) * nR),
      angle: rows.view.slice(L.N_FIELDS * n),
      film_thickness: row(L.F_FILM),
      pressure: row(L.F_PRESSURE),
      contact_pressure: row(L.F_CONTACT),
      carrier_temperature: row(L.F_CARRIER),
      washer_temperature: row(L.F_WASHER),
    };
  }

  /** Go along speeds at one load, down from the fastest, then up again: rows of outputs. */
  *stribeck(point, speeds) {
    const { kernel, L } = this,
      { par, state, curve } = this.mesh,
      way = [...speeds.slice().reverse(), ...speeds];
    const own = (this.mesh.speeds ??= {
      state: kernel.array(state.length),
      inputs: kernel.table(way.length, L.NINP),
      out: kernel.table(way.length, L.NOUT),
      whole: kernel.table(way.length, L.NIOUT, Int32Array),
      statuses: kernel.array(way.length, Int32Array),
    });
    own.state.view.fill(0);
    own.inputs.view.set(way.flatMap((speed) => [point[0], speed, ...point.slice(2)]));
    for (let i = 0; i < way.length; i += AT_ONCE) {
      const end = Math.min(i + AT_ONCE, way.length),
        [inputs, out, whole] = [own.inputs, own.out, own.whole].map((table) => table.rows(i, end));
      const statuses = own.statuses.part(i, end);
      kernel.call("step_rows", par, inputs, own.state, curve, this.iout, out, whole, statuses);
      yield;
    }
    const rows = way.map((speed, i) => ({
      up: i >= speeds.length,
      speed,
      ...this.named(own.out.rows(i, i + 1).view),
    }));
    return { rows: rows.filter((_, i) => own.statuses.view[i] < this.about.first_failure) };
  }

  /**
   * Solve at rising loads with the parameters and inputs of a draw of the scatter. Return outputs by load, `up` on the
   * film branch to its fold, then in contact, `down` only where the contact branch is another solution; or a `broken` rule.
   */
  *draw(parameters, level, point, loads) {
    const { kernel, L } = this,
      { sizes } = this.about.levels[level],
      mesh = this.memory(level, `${level}, draws`);
    const [broken, par] = this.constants(mesh, parameters, level);
    if (broken) return { broken };
    const own = (mesh.loads ??= {
      inp: kernel.array(L.NINP),
      out: kernel.array(L.NOUT),
      iout: kernel.array(L.NIOUT, Int32Array),
      loads: kernel.array(loads.length),
      walk: kernel.array(sizes.walk),
      rows: kernel.array(2 * loads.length * L.N_SOLUTION),
    });
    own.inp.view.set(point);
    own.loads.view.set(loads);
    own.walk.view.fill(0);
    const { inp, out, iout, walk, rows } = own;
    do {
      this.check(
        kernel.call("follow_loads", par, inp, mesh.work, own.loads, mesh.state, out, iout, walk, rows),
      );
      yield;
    } while (!walk.view[L.WALK_ENDED]);
    const solutions = Array.from({ length: 2 * loads.length }, (_, i) => {
      const [branch, load, ...found] = rows.part(i * L.N_SOLUTION, (i + 1) * L.N_SOLUTION).view;
      return branch ? { load, ...this.named(found), branch: this.about.branches[branch] } : null;
    });
    return { up: solutions.slice(0, loads.length), down: solutions.slice(loads.length) };
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

  /** All solutions between two loads, as Python's load_curve. */
  *curve(point, loadMin, loadMax) {
    const { kernel, L, about } = this,
      { par, curve: work } = this.mesh,
      points = /** @type {any[]} */ ([]),
      folds = /** @type {any[]} */ ([]);
    const own = (this.whole ??= {
      inp: kernel.array(L.NINP),
      whole: kernel.array(L.N_WHOLE),
      rows: kernel.array(AT_ONCE * L.N_POINT),
    });
    own.inp.view.set(point);
    own.whole.view.fill(0);
    const { inp, whole, rows } = own,
      place = (row) => ({ load: row[0], ...this.named(row.subarray(1)) });
    do {
      this.check(kernel.call("follow_curve", par, inp, work, loadMin, loadMax, whole, rows));
      const kind = about.folds[whole.view[L.FOLD]];
      if (kind) folds.push({ kind, ...place(whole.view.subarray(L.FOLD_LOAD)) });
      for (let k = 0; k < whole.view[L.POINTS]; k += 1)
        points.push(place(rows.view.subarray(k * L.N_POINT, (k + 1) * L.N_POINT)));
      yield;
    } while (!whole.view[L.ENDED]);
    const branches = this.room("branches", points),
      ratios = this.room("points", points),
      passed = this.room("folds", folds);
    kernel.call("name_branches", ratios, passed, branches);
    points.forEach((p, i) => (p.branch = about.branches[branches.view[i]]));
    return { points, folds };
  }

  /** Return the film ratios of points as an array in the kernels' memory, kept under a name. */
  room(name, points) {
    const rooms = (this.rooms ??= {});
    if (!(rooms[name]?.length >= points.length)) rooms[name] = this.kernel.array(2 * points.length);
    const room = rooms[name].part(0, points.length);
    room.view.set(points.map((p) => p.film_ratio));
    return room;
  }
}
