// Run a page's worker in node: JSON on standard input; answers, with seconds, on standard output.
import fs from "node:fs";

const given = JSON.parse(fs.readFileSync(0, "utf8"));
const [{ Kernel }, { Model }] = await Promise.all(given.scripts.map((address) => import(address)));
const model = new Model(new Kernel(fs.readFileSync(given.module), given.about.functions), given.about);
const plain = (_, value) => (ArrayBuffer.isView(value) ? Array.from(value) : value);
const answers = given.tasks.map(([task, ...rest]) => {
  const began = performance.now();
  let result;
  try {
    result = model[task](...rest);
    if (result && result.next) {
      let step;
      do step = result.next();
      while (!step.done);
      result = step.value;
    }
  } catch (problem) {
    result = { problem: problem.message };
  }
  return { result, seconds: (performance.now() - began) / 1000 };
});
process.stdout.write(JSON.stringify(answers, plain));
