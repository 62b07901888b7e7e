// Run steps of a model's kernels in node: JSON on standard input, rows of outputs on standard output.
import fs from "node:fs";

const given = JSON.parse(fs.readFileSync(0, "utf8"));
const { Kernel } = await import(given.script);
const kernel = new Kernel(fs.readFileSync(given.module), given.functions);
const [par, inp, state, work, out] = given.sizes.map((n) => kernel.array(n));
const iout = kernel.array(given.whole_outputs, Int32Array);
par.view.set(given.parameters);
const rows = [],
  codes = [kernel.call("derive", par)];
given.inputs.forEach((row, i) => {
  inp.view.set(row);
  codes.push(kernel.call("step", par, inp, state, work, out, iout, i * given.dt, given.dt));
  rows.push([...out.view, ...iout.view]);
});
process.stdout.write(JSON.stringify({ rows, codes }));
