/* The gear train: a point, and what comes over torque, speed and oil temperature. */

import { PointModel } from "../kernel.js";

const SHARES = Array.from({ length: 49 }, (_, i) => i / 24 - 1); // -1 to 1
const FACTORS = Array.from({ length: 25 }, (_, i) => i / 16); // of the speed: 0 to 1.5
const OILS = Array.from({ length: 35 }, (_, i) => 253.15 + 5 * i); // K
const OVER = 1.25, // the torque's curves reach this times the torque
  LEAST = 10; // N m, and this at least

export class Model extends PointModel {
  /** @type {import("../kernel.js").Numbers | undefined} */
  inputs;
  /** @type {import("../kernel.js").Numbers | undefined} */
  flags;

  /** Take parameters and a level; return the number of the first broken rule, 0 if all hold. */
  set(parameters, level) {
    const { kernel, about } = this,
      par = this.par.view;
    par.fill(0);
    par.set([...parameters, about.levels[level].code]);
    const broken = kernel.call("broken_rule", this.par);
    return broken || (kernel.call("derive", this.par) >= about.first_failure ? -1 : 0);
  }

  /** Solve a step of no duration; return its status and all that comes out, [] where nothing does. */
  step(torque, speed, oil) {
    const { L, kernel } = this,
      inputs = (this.inputs ??= kernel.array(L.NINP)),
      flags = (this.flags ??= kernel.array(L.NIOUT, Int32Array));
    this.state.view.fill(0);
    inputs.view.set([torque, speed, oil]);
    const code = kernel.call("step", this.par, inputs, this.state, this.work, this.out, flags, 0, 0);
    return { code: code || flags.view[L.IO_STATUS], values: Array.from(this.out.view) };
  }

  /** Tell if an output is of a mesh or shaft that is not there, or has no limit. */
  isAbsent(name) {
    const { L } = this,
      par = this.par.view,
      meshes = par[L.P_MESHES];
    const [, kind, number] = /^(mesh|shaft)_(\d)_/.exec(name) ?? [],
      limited = (i) => par[L.P_MESH + i * L.MESH_ROW + L.A_ROOT_LIMIT] > 0;
    if (kind && Number(number) > meshes + (kind === "shaft" ? 1 : 0)) return true;
    if (name === "root_safety") return !Array.from({ length: meshes }, (_, i) => i).some(limited);
    return name.endsWith("_root_safety") && !limited(Number(number) - 1);
  }

  /** Return the efficiency of a point, NaN where there is none, and a key of `flows`: as power_flow and solve_train. */
  flow(torque, speed, oil, values) {
    const { L } = this,
      at = (v) => v[L.O_OUTPUT_TORQUE] * v[L.O_OUTPUT_SPEED],
      given = torque * speed,
      left = at(values);
    if (given > 0 && left > 0) return [left / given, "forward"];
    if (given < 0 && left < 0) return [given / left, "backward"];
    if (given === 0 && left === 0) return [NaN, "at_rest"];
    if (given === 0 || left === 0) return [NaN, "none_out"];
    if (given > 0) {
      const again = this.step(L.MORE * torque, speed, oil);
      if (again.code >= this.about.first_failure || at(again.values) < left) return [NaN, "self_locking"];
    }
    return [NaN, "both"];
  }

  /** Return figures and status of a point. */
  figures(torque, speed, oil) {
    const { code, values } = this.step(torque, speed, oil),
      known = this.about.real_outputs.map((name, i) => [name, this.isAbsent(name) ? null : values[i]]);
    const [efficiency, flow] = this.flow(torque, speed, oil, values);
    const outputs = Object.fromEntries(known);
    delete outputs.oil_energy; // of a step, not of a point
    return { code, outputs: { ...outputs, efficiency, flow: this.about.flows[flow] } };
  }

  /** Return the losses of a point by source [W], NaN where nothing settles. */
  losses(torque, speed, oil) {
    const { L } = this,
      { code, values } = this.step(torque, speed, oil),
      failed = code >= this.about.first_failure;
    const of = (place) => (failed ? NaN : values[place]);
    const [efficiency] = failed ? [NaN] : this.flow(torque, speed, oil, values);
    return {
      loss: of(L.O_LOSS),
      mesh: of(L.O_MESH_LOSS),
      bearing: of(L.O_BEARING_LOSS),
      seal: of(L.O_SEAL_LOSS),
      churning: of(L.O_CHURNING_LOSS),
      efficiency,
    };
  }

  /** Solve at torque, speed and oil temperature, as solve_train. */
  solve([torque, speed, oil]) {
    const most = OVER * Math.max(Math.abs(torque), LEAST);
    const torques = SHARES.map((share) => ({
      torque: share * most,
      ...this.losses(share * most, speed, oil),
    }));
    const speeds = FACTORS.map((f) => ({ speed: f * speed, ...this.losses(torque, f * speed, oil) })),
      oils = OILS.map((temperature) => ({ temperature, ...this.losses(torque, speed, temperature) }));
    return { ...this.figures(torque, speed, oil), torques, speeds, oils };
  }
}
