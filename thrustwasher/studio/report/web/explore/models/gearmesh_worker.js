/* The gear mesh: a point, and what comes with it along the path of contact. */

import { PointModel } from "../kernel.js";

export class Model extends PointModel {
  /** @type {{given: import("../kernel.js").Numbers, status: import("../kernel.js").Numbers} | undefined} */
  point;
  /** @type {import("../kernel.js").Numbers | undefined} */
  place;

  /** As all models; if the pinion has too few teeth (rule 1), return also the minimum number of them. */
  set(parameters, level) {
    const broken = super.set(parameters, level),
      teeth = this.L.P_PINION_TEETH,
      par = this.par.view;
    while (broken === 1 && (par[teeth] += 1) < this.L.MOST_TEETH)
      if (this.kernel.call("broken_rule", this.par) !== 1) return [broken, par[teeth]];
    return broken;
  }

  /** Solve at (power, speed, oil temperature), as solve_gearmesh. */
  solve([power, speed, oil]) {
    const { L, kernel } = this;
    if (Math.abs(power) > L.MOST_TORQUE * Math.abs(speed)) {
      throw new Error(
        `speed = ${speed} rad/s, allowed: from ${Math.abs(power) / L.MOST_TORQUE} rad/s on for power = ${power} W`,
      );
    }
    const torque = power === 0 ? 0 : Math.abs(power / speed);
    this.state.view.fill(0);
    const constants = this.shared(torque, speed, oil);
    this.work.view[L.W_WAY] = power < 0 ? -1 : 1;
    const code = kernel.call(
      "solve_point",
      constants,
      torque,
      speed,
      oil,
      torque * Math.abs(speed),
      this.state,
      0,
      this.work,
    );
    const f = this.work.view,
      par = constants.view,
      found = {};
    this.about.real_outputs.forEach((name, i) => (found[name] = f[i]));
    const loss = f[L.F_MEAN_FRICTION] * par[L.D_LOSS] * torque,
      ratio = f[L.F_RATIO];
    found.asperity_temperature = found.temperature;
    delete found.temperature;
    delete found.oil_energy; // of a step, not of a point
    Object.assign(found, {
      friction_torque: Math.sign(speed) * loss,
      friction_power: loss * Math.abs(speed),
      hertz_pressure: (4 / Math.PI) * f[L.F_PRESSURE],
      hertz_width: f[L.F_WIDTH],
      viscosity: f[L.F_VISCOSITY],
      area_ratio: f[L.F_AREA],
      sliding_speed: f[L.F_SLIDING],
      start_of_contact: par[L.D_START],
      contact_ratio: par[L.D_CONTACT_RATIO],
      overlap_ratio: par[L.D_OVERLAP],
      slide_roll_ratio: par[L.D_SLIDE_ROLL],
      regime: ratio > 3 ? 1 : ratio >= 1 ? 2 : 3,
    });
    const endures = par[L.P_FILM_HEAT] !== L.LOSS && par[L.P_STEEL] !== L.CASE_HARDENED;
    if (par[L.P_ROOT_LIMIT] === 0) found.root_safety = null;
    for (const name of Object.keys(found)) {
      if (
        name === "micropitting_safety"
          ? par[L.P_PERMISSIBLE_FILM_RATIO] === 0
          : !endures && /^(modification|allowable|stress_util)/.test(name)
      )
        found[name] = null;
    }
    return { code, outputs: found, path: this.path(constants, oil, speed, torque), teeth: this.teeth() };
  }

  /** Return the constants with the shares at this torque, which a step leaves; as they are where they are rigid. */
  shared(torque, speed, oil) {
    const { L, kernel } = this;
    if (this.par.view[L.P_LOAD_SHARING] !== L.ELASTIC) return this.par;
    this.point ??= { given: kernel.array(L.NINP), status: kernel.array(L.NIOUT) };
    this.point.given.view.set([torque, speed, oil]);
    kernel.call("step", this.par, this.point.given, this.state, this.work, this.out, this.point.status, 0, 0);
    return this.work.part(L.W_PAR, L.W_PAR + L.NPAR);
  }

  /** Safety against micropitting at the places of the path. */
  micropitting(constants, oil, speed, torque) {
    const { L } = this,
      par = constants.view,
      thin = this.work.view[L.F_BULK_VISCOSITY];
    const line = Math.max(torque * par[L.D_LINE], 1),
      turning = Math.max(Math.abs(speed), 1e-3);
    const at = (_, k) =>
      this.kernel.call("film_ratio_at", constants, k, line, turning, oil, thin) /
      par[L.P_PERMISSIBLE_FILM_RATIO];
    return Array.from({ length: par[L.D_PLACES] }, at);
  }

  /** What the transverse section is drawn from: lengths [m], angles [rad], positions in base pitches. */
  teeth() {
    const { L, kernel } = this,
      par = this.par.view,
      [tipPinion, tipGear, module] = kernel.call("tips", this.par);
    const transverse = module / Math.cos(par[L.P_HELIX_ANGLE]),
      side = par[L.D_SIDE],
      z = par[L.P_PINION_TEETH],
      ratio = par[L.P_GEAR_RATIO];
    const thickness = kernel.call("tip_thickness", this.par),
      pitch = kernel.call("pitch_of", this.par),
      root = par[L.P_TOOL_ADDENDUM];
    const wheel = (teeth, tip, i, shift, out) => ({
      teeth,
      tip,
      base: (teeth * pitch) / (2 * Math.PI),
      tipThickness: thickness[i] * transverse,
      out,
      working: (par[L.D_CENTRE] * teeth) / (z * (ratio + side)),
      root: (teeth * transverse) / 2 + (shift - out * root) * module,
    });
    return {
      side,
      module,
      pitch,
      angle: par[L.D_ANGLE],
      approach: par[L.D_APPROACH],
      recess: par[L.D_RECESS],
      pinion: wheel(z, tipPinion, 0, par[L.P_PROFILE_SHIFT_PINION], 1),
      gear: wheel(z * ratio, tipGear, 1, kernel.call("gear_shift", this.par), side),
    };
  }

  /** Flash, film, pressure and friction along the path, in proportion to the hottest position's; shares of the load, sliding. */
  path(constants, oil, speed, torque) {
    const { L } = this,
      f = this.work.view,
      par = constants.view;
    const n = par[L.D_PLACES];
    if (par[L.P_FILM_HEAT] !== L.LOSS || !n) return null;
    const row = (first) => Array.from(par.slice(first, first + n)),
      law = par[L.P_FRICTION_LAW],
      hot = f[L.W_PLACE];
    const varies = par[L.P_FIDELITY] !== L.CLOSED && (law === L.LI_SEIREG || law === L.MIXED_FRICTION);
    const friction = varies
      ? Array.from(f.slice(L.W_FRICTION, L.W_FRICTION + n))
      : new Array(n).fill(f[L.F_MEAN_FRICTION]);
    const along = (values, at, size) => values.map((v) => (v / values[at]) * size);
    const pressure = row(L.D_PATH_PRESSURE),
      most = pressure.indexOf(Math.max(...pressure));
    const flash = along(
      row(L.D_PATH_FLASH).map((v, k) => v * friction[k]),
      hot,
      f[L.F_FLASH_MAX],
    );
    const scuffing = f[L.F_SCUFFING_MARGIN] + f[L.F_BULK] + f[L.F_FLASH_MAX];
    const counted = (rise) => Math.max(rise, 1);
    const film = along(row(L.D_PATH_FILM), hot, f[L.F_FILM]);
    const here = (this.place ??= this.kernel.array(L.D_POSITION));
    const sliding = Array.from({ length: n }, (_, k) => {
      this.kernel.call("place_mesh", constants, k, here);
      return (here.view[L.D_V1] - here.view[L.D_V2]) * speed;
    });
    return {
      sliding,
      position: row(L.D_POSITION),
      friction,
      film,
      hot,
      scuffing,
      flank: flash.map((v) => v + f[L.F_BULK]),
      bulk: f[L.F_BULK],
      pressure: along(pressure, most, f[L.F_PRESSURE_MAX]),
      share: row(L.D_PATH_SHARE),
      // in proportion, so that the minimum is the mesh's own, which is rounded below a rise of 1 K
      safety: flash.map(
        (v) =>
          (f[L.F_SCUFFING_SAFETY] * counted(f[L.F_BULK] + f[L.F_FLASH_MAX] - oil)) /
          counted(v + f[L.F_BULK] - oil),
      ),
      micropitting:
        par[L.P_PERMISSIBLE_FILM_RATIO] > 0 ? this.micropitting(constants, oil, speed, torque) : null,
    };
  }
}
