/* The compiled kernels as functions: the same entries that Python calls, with the same blocks. */

/** An array in the kernels' memory; its view is made anew when the memory has grown. */
export class Numbers {
  /** @type {Kernel} */
  kernel;
  /** @type {number} */
  at;
  /** @type {number} */
  length;
  /** @type {Float64ArrayConstructor | Int32ArrayConstructor} */
  type;
  /** @type {number} */
  width;
  /** @type {Float64Array | Int32Array | undefined} */
  kept;

  /**
   * @param {Kernel} kernel
   * @param {number} at its first byte
   * @param {number} length
   * @param {Float64ArrayConstructor | Int32ArrayConstructor} type
   * @param {number} width of a table's row
   */
  constructor(kernel, at, length, type = Float64Array, width = 1) {
    Object.assign(this, { kernel, at, length, type, width });
  }

  get view() {
    const buffer = this.kernel.memory.buffer;
    if (this.kept?.buffer !== buffer) this.kept = new this.type(buffer, this.at, this.length);
    return this.kept;
  }

  /** Return the part from `first` up to `end` as an array of its own, in the same place. */
  part(first, end = this.length) {
    const at = this.at + first * this.type.BYTES_PER_ELEMENT;
    return new Numbers(this.kernel, at, end - first, this.type, this.width);
  }

  /** Return the rows of a table from `first` up to `end`. */
  rows(first, end) {
    return this.part(first * this.width, end * this.width);
  }
}

/** A module of kernels; `functions`: name -> place in the module's table, kinds of what it takes, how much comes back. */
export class Kernel {
  /** @type {WebAssembly.Memory} */
  memory;
  /** @type {number} */
  free;
  /** @type {number} */
  raised;
  /** @type {Numbers} */
  block;
  /** @type {Numbers} */
  wholes;
  /** @type {Numbers[]} */
  lent;
  /** @type {Record<string, {run: (...words: number[]) => number, takes: string[], returns: number, tuple: boolean}>} */
  functions;

  constructor(bytes, functions) {
    /** @type {any} */
    const { exports } = new WebAssembly.Instance(new WebAssembly.Module(bytes), {});
    this.memory = exports.memory;
    if (exports._initialize) exports._initialize();
    this.free = Math.ceil(exports.__heap_base.value / 16) * 16;
    this.raised = this.array(2).at;
    this.block = this.array(256);
    this.wholes = new Numbers(this, this.block.at, 512, Int32Array);
    const places = new Uint32Array(this.memory.buffer, exports.tw_table());
    this.functions = {};
    for (const [name, about] of Object.entries(functions)) {
      this.functions[name] = { ...about, run: exports.__indirect_function_table.get(places[about.place]) };
    }
  }

  /**
   * Return an array of zeros that is never given back.
   * @param {number} length
   * @param {Float64ArrayConstructor | Int32ArrayConstructor} type
   */
  array(length, type = Float64Array) {
    const made = new Numbers(this, this.free, length, type);
    this.free += Math.ceil((length * type.BYTES_PER_ELEMENT) / 16) * 16;
    const missing = this.free - this.memory.buffer.byteLength;
    if (missing > 0) this.memory.grow(Math.ceil(missing / 65536));
    return made;
  }

  /**
   * Return a table of zeros that is never given back.
   * @param {number} rows
   * @param {number} width
   * @param {Float64ArrayConstructor | Int32ArrayConstructor} type
   */
  table(rows, width, type = Float64Array) {
    return Object.assign(this.array(rows * width, type), { width });
  }

  /**
   * Call a kernel: arrays and numbers in the order of its arguments, tuples part by part.
   * Return the number that comes back, of a tuple the list of them.
   * @param {string} name
   * @param {...any} given `Numbers`, numbers, Booleans
   * @returns {any}
   */
  call(name, ...given) {
    const { run, takes, returns, tuple } = this.functions[name];
    const numbers = this.block.view,
      wholes = this.wholes.view;
    let word = 0;
    const whole = (value) => {
      wholes[2 * word] = value;
      wholes[2 * word + 1] = value < 0 ? -1 : 0;
      word += 1;
    };
    if (given.length !== takes.length) throw new Error(`${name} takes ${takes.length} arguments`);
    for (let i = 0; i < takes.length; i += 1) {
      if (takes[i] === "array" || takes[i] === "table") {
        whole(given[i].at);
        whole(given[i].length / (takes[i] === "table" ? given[i].width : 1));
        if (takes[i] === "table") whole(given[i].width);
      } else if (takes[i] === "float") {
        numbers[word] = given[i];
        word += 1;
      } else whole(Number(given[i]));
    }
    if (run(this.raised, this.raised + 8, this.block.at, this.block.at)) {
      throw new Error(`${name} raised an exception, which it never should`);
    }
    const back = Array.from(this.block.view.subarray(word, word + returns));
    return tuple ? back : back[0];
  }

  /** Return a kernel with its arrays bound: a function of the two numbers behind them, called often. */
  bound(name, ...arrays) {
    const { run, takes } = this.functions[name],
      block = this.array(2 * takes.length + 2),
      { raised } = this,
      { at } = block;
    const wholes = new Numbers(this, at, 4 * arrays.length, Int32Array).view,
      first = 2 * arrays.length;
    arrays.forEach((array, i) => ([wholes[4 * i], wholes[4 * i + 2]] = [array.at, array.length]));
    return (one, other) => {
      const numbers = block.view;
      numbers[first] = one;
      numbers[first + 1] = other;
      if (run(raised, raised + 8, at, at))
        throw new Error(`${name} raised an exception, which it never should`);
      return numbers[first + 2];
    };
  }
}

/** What models with one point have alike: their arrays, and taking parameters. */
export class PointModel {
  /** @type {Kernel} */
  kernel;
  /** @type {any} */
  about;
  /** @type {Record<string, number>} */
  L;
  /** @type {Numbers} */
  par;
  /** @type {Numbers} */
  state;
  /** @type {Numbers} */
  work;
  /** @type {Numbers} */
  out;
  /** @type {Record<string, Numbers> | undefined} */
  drawn;

  constructor(kernel, about) {
    Object.assign(this, { kernel, about, L: about.layout });
    Object.assign(this, this.memory());
  }

  memory() {
    return Object.fromEntries(
      ["par", "state", "work", "out"].map((name) => [
        name,
        this.kernel.array(this.L[`N${name.toUpperCase()}`]),
      ]),
    );
  }

  /**
   * Solve at inputs: each model its own way.
   * @param {...any} _given
   * @returns {any}
   */
  solve(..._given) {
    throw new Error("a model without equations");
  }

  /** Solve with parameters and inputs of a draw of the scatter; return also what is in the way. */
  *draw(parameters, level, ...given) {
    yield;
    const { par, state, work, out } = this;
    Object.assign(this, (this.drawn ??= this.memory()));
    try {
      const [broken] = [this.set(parameters, level)].flat(),
        found = broken ? { broken } : this.solve(...given);
      return found.code >= this.about.first_failure ? { problem: this.about.statuses[found.code] } : found;
    } finally {
      Object.assign(this, { par, state, work, out });
    }
  }

  /**
   * Take parameters [numbers in their order] and a level.
   * @param {number[]} parameters
   * @param {string} level
   * @returns {any} the number of a broken rule, -1 if no constants follow, else 0; or a list that begins with it
   */
  set(parameters, level) {
    const par = this.par.view,
      { L, kernel } = this;
    par.fill(0);
    par.set([...parameters, this.about.levels[level].code]);
    if ("P_THERMAL_MODE" in L) par[L.P_THERMAL_MODE] = L.QUASI_STEADY;
    return (
      kernel.call("broken_rule", this.par) ||
      (kernel.call("derive", this.par) >= this.about.first_failure ? -1 : 0)
    );
  }
}
