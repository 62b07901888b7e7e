// Run a scene's kernels in node: JSON on standard input; figures of each run on standard output.
import fs from "node:fs";
import zlib from "node:zlib";

const { scripts, about, modules, runs } = JSON.parse(fs.readFileSync(0, "utf8"));
const [{ Kernel }, { Model }, { textOf, writer }] = await Promise.all(
  scripts.map((address) => import(address)),
);
const inflated = (text) => zlib.inflateSync(Buffer.from(text, "base64"));
const numbers = (text) => {
  const bytes = inflated(text);
  return new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
};
const say = writer(about.units);
about.tables = {};
about.recorded = {};
for (const [name, { map, recorded }] of Object.entries(about.washers)) {
  if (map) about.tables[name] = [map.at, numbers(map.table)];
  about.recorded[name] = { rows: numbers(recorded.rows), moving: recorded.moving };
}
const kernels = Object.entries(modules).map(([key, text]) => [
  key,
  new Kernel(inflated(text), about.models[key].functions),
]);
const model = new Model(Object.fromEntries(kernels), about);
const given = Object.fromEntries(Object.entries(about.profiles).map(([name, { points }]) => [name, points]));
const answers = runs.map(({ profiles = {}, washers, draw = null }) => {
  try {
    const steps = model.run({
      profiles: { ...given, ...profiles },
      washers,
      draw: draw === null ? null : about.scatter.rows[draw],
    });
    let step;
    do step = steps.next();
    while (!step.done);
    const { figures, warnings } = step.value;
    const told = warnings.map(({ pieces }) => textOf(pieces, say));
    return { figures, warnings: told, keys: warnings.map(({ key }) => key) };
  } catch (problem) {
    return { problem: problem.message };
  }
});
process.stdout.write(JSON.stringify(answers));
