/* The wet clutch: an engagement over time under a profile of load that was drawn, as engage_clutch. */

import { PointModel } from "../kernel.js";

export class Model extends PointModel {
  /** @type {number} */
  toOil;

  /** Begin at the oil's temperature; return a status. */
  begin(load, oil) {
    const { kernel, L, par, work } = this,
      p = par.view;
    this.state.view.fill(0);
    work.view.fill(0);
    this.out.view.fill(0);
    this.toOil = 0;
    const code = kernel.call("load_memory", par, load, oil, this.state, work);
    if (code || (p[L.P_FIDELITY] >= L.FIELD && p[L.P_FILM_DYNAMICS] !== 0)) return code;
    work.view[L.W_NOW + L.Y_FILM] = 1;
    return kernel.call("settle_film", par, load, work);
  }

  show(load, slip, drum, oil, duration) {
    const { kernel, L, par, work, out } = this;
    kernel.call("fill_outputs", par, load, slip, drum, work, out);
    const o = out.view;
    [o[L.O_TEMPERATURE]] = kernel.call("mean_surface", par, work);
    o[L.O_ENERGY] = par.view[L.P_FACES] * work.view[L.W_NOW + L.Y_ENERGY];
    o[L.O_STORED_HEAT] = kernel.call("stored_heat", par, work, oil);
    const before = this.toOil;
    this.toOil = o[L.O_ENERGY] - o[L.O_STORED_HEAT];
    o[L.O_OIL_ENERGY] = this.toOil;
    o[L.O_OIL_HEAT] = duration > 0 ? (this.toOil - before) / duration : 0;
    return Array.from(o);
  }

  /** Solve for (slip, oil, drum speed, duration); `shares.load`: loads at even times from 0 to the end. */
  solve([slip, oil, drum, duration], _fresh, _branch, { ramp }) {
    const { kernel, L, par, work, about } = this,
      rows = [],
      times = [],
      loads = [],
      slips = [];
    const { POINTS } = L; // a whole number for each straight piece of the ramp
    for (let i = 0; i <= POINTS; i += 1) {
      const share = (i / POINTS) * (ramp.length - 1),
        k = Math.min(Math.floor(share), ramp.length - 2);
      times.push((duration * i) / POINTS);
      loads.push(ramp[k] + (ramp[k + 1] - ramp[k]) * (share - k));
      slips.push(slip * (1 - i / POINTS));
    }
    let code = this.begin(loads[0], oil);
    for (let i = 0; i <= POINTS && code < about.first_failure; i += 1) {
      const step = i ? times[i] - times[i - 1] : 0;
      if (i) {
        const power = this.out.view[L.O_POWER] / par.view[L.P_FACES];
        code = kernel.call(
          "advance",
          par,
          loads[i - 1],
          slips[i - 1],
          oil,
          loads[i],
          slips[i],
          oil,
          drum,
          drum,
          step,
          power,
          work.view[L.W_PROPOSED],
          work,
        );
      }
      if (code < about.first_failure) rows.push(this.show(loads[i], slips[i], drum, oil, step));
    }
    const series = { time: times, load: loads, speed: slips };
    about.real_outputs.forEach((name, k) => (series[name] = rows.map((row) => row[k])));
    const most = (values) => Math.max(...values.map(Math.abs));
    const outputs = {
      friction_torque_max: most(series.friction_torque),
      temperature_max: Math.max(...series.temperature),
      film_ratio_min: Math.min(...series.film_ratio),
      heat_flux_max: Math.max(...series.heat_flux),
      power_max: most(series.friction_power),
      energy: series.energy.at(-1),
      stored_heat: series.stored_heat.at(-1),
      boundary_from: times[series.film_ratio.findIndex((u) => u < 1)] ?? NaN,
    };
    const hottest = outputs.temperature_max;
    if (!code && hottest > L.HOT_LIMIT) code = hottest > L.EXTRAPOLATED_LIMIT ? L.EXTRAPOLATED : L.HOT;
    return { code, outputs, series };
  }
}
