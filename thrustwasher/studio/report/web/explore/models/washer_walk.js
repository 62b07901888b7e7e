/* A walk along the washer's curve of solutions, as the kernels and the Python API make it. */

export const ALONE = 0.9; // share of the contact, as the kernels have it
export const SHALLOW = 3e-4;

/** A place on the curve of solutions, which moves as its film thickness is prescribed. */
export class Walker {
  /** @type {import("../kernel.js").Kernel} */
  kernel;
  /** @type {Record<string, number>} */
  L;
  /** @type {any} */
  washer;
  /** @type {import("../kernel.js").Numbers} */
  work;
  /** @type {number[]} */
  point;
  /** @type {number} */
  sigma;

  constructor(washer, point, load) {
    const { kernel, L } = washer,
      { par, curve: work } = washer.mesh;
    Object.assign(this, {
      kernel,
      L,
      washer,
      work,
      point: [load, ...point.slice(1)],
      sigma: par.view[L.D_SIGMA1],
    });
    const bulk = par.view[L.P_GEAR_FAR_FACE] === L.BULK && point[L.I_FAR_FACE];
    this.point[L.I_FAR_FACE] = bulk || point[L.I_OIL]; // as the kernels' point_of
    this.w = [
      par,
      work.part(L.N_HEAD),
      work.part(0, L.N_INFO),
      work.part(L.AT_FOUND, L.AT_CURVE),
      work.part(L.AT_CURVE, L.AT_OUTPUTS),
      work.part(L.AT_OUTPUTS, L.AT_POSITIONS),
      work.part(L.AT_POSITIONS, L.N_HEAD),
    ];
    this.at(L.ACCURACY, 1e-8);
  }

  at(place, value) {
    const view = this.work.view,
      k = this.L.AT_CURVE + place;
    if (value !== undefined) view[k] = value;
    return view[k];
  }

  get film() {
    return this.at(this.L.AT_FILM);
  }
  get load() {
    return this.at(this.L.AT_LOAD);
  }
  get share() {
    return this.at(this.L.AT_SHARE);
  }

  check(code) {
    if (code) throw new Error(this.washer.about.statuses[code] ?? `status ${code}`);
  }

  /** Call a kernel of the path; throws what is in the way. */
  go(name, ...given) {
    this.check(this.kernel.call(name, ...this.w, ...this.point, ...given));
  }

  start(ratio) {
    this.go("start_at", ratio);
  }
  to(film) {
    this.go("go_to_film", film);
  }
  note() {
    this.kernel.call("note", ...this.w);
  }
  forget() {
    this.work.view[this.L.N_HEAD + this.L.TAG_VALID] = 0;
  }

  result() {
    const { L } = this,
      load = this.load;
    this.kernel.call("outputs_at", ...this.w, load, ...this.point.slice(1));
    return this.named(load, this.work.view.slice(L.AT_OUTPUTS, L.AT_POSITIONS));
  }

  /** Return a load and outputs by name. */
  named(load, out) {
    const found = { load };
    this.washer.about.real_outputs.forEach((name, i) => (found[name] = out[i]));
    return found;
  }
}
