/* The driveline losses: a point, and the what comes when all speeds change together, or the oil. */

import { PointModel } from "../kernel.js";

const FACTORS = Array.from({ length: 61 }, (_, i) => i / 40); // of the speeds: 0 to 1.5
const SHAFTS = ["input", "output", "drum"];
const OILS = Array.from({ length: 69 }, (_, i) => 253.15 + 2.5 * i); // K

export class Model extends PointModel {
  /** @type {import("../kernel.js").Numbers | undefined} */
  inputs;
  /** @type {import("../kernel.js").Numbers | undefined} */
  flags;

  /** Take parameters and a level; there are no rules between them. */
  set(parameters, level) {
    this.par.view.fill(0);
    this.par.view.set([...parameters, this.about.levels[level].code]);
    return this.kernel.call("derive", this.par) >= this.about.first_failure ? -1 : 0;
  }

  /** Solve at speeds, tooth force and oil temperature, as solve_losses. */
  solve(point) {
    const { L, kernel, about } = this;
    const inputs = (this.inputs ??= kernel.array(L.NINP));
    const flags = (this.flags ??= kernel.array(L.NIOUT, Int32Array));
    const at = (factor, oil = point.at(-1)) => {
      this.state.view.fill(0);
      inputs.view.set([...point.slice(0, L.SPEEDS).map((speed) => factor * speed), point[L.I_FORCE], oil]);
      const code = kernel.call("step", this.par, inputs, this.state, this.work, this.out, flags, 0, 0);
      const regimes = SHAFTS.map((name, i) => [`${name}_churning_regime`, flags.view[i]]);
      return {
        code: code || flags.view.at(-1),
        outputs: Object.fromEntries([
          ...about.real_outputs.map((name, i) => [name, this.out.view[i]]),
          ...regimes,
        ]),
      };
    };
    const curve = FACTORS.map((factor) => ({ factor, ...at(factor).outputs })),
      warm = OILS.map((oil) => ({ oil, ...at(1, oil).outputs })),
      here = at(1);
    delete here.outputs.oil_energy; // of a step, not of a point
    return { ...here, curve, warm };
  }
}
