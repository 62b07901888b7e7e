// From the modules of the pages to one script and one style each: npm run --prefix lab/pages bundle
//
// What comes out is committed: pages are written where there is no npm. A record beside it tells what
// it was made of; a test compares. --check writes nothing and fails if something else came out.
// A script leaves nothing in a page but `page`: what tests and measurements look at.
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import * as esbuild from "esbuild";

const HERE = fileURLToPath(new URL(".", import.meta.url));
const WEB = join(HERE, "../../thrustwasher/studio/report/web");
const OUT = join(WEB, "bundle");
const MODELS = ["washer", "clutch", "gearmesh", "losses", "train"];
const SHOWN = `export { state, ask, busy, setting, waiting } from "./explore/page.js";
export { ABOUT } from "./explore/dom.js";`;

// bundle -> the module that it begins with
const BUNDLES = {
  "page.js": 'import "./page.js";',
  "page.css": '@import "./page.css";',
  "shift.js": 'export * from "./shift/start.js";',
  "shift.css": '@import "uplot/dist/uPlot.min.css"; @import "./draw.css"; @import "./shift/shift.css";',
  "chart.js": 'import "./chart/chart.js";',
  "chart.css": '@import "./chart/chart.css";',
  "explore.css": '@import "./draw.css"; @import "./explore/explore.css";',
  "scene.js": 'export * from "./scene/scene_page.js";',
  "scene.css": '@import "./draw.css"; @import "./explore/explore.css"; @import "./scene/scene.css";',
  "scene_worker.js": answering("./scene/system.js"),
  ...Object.fromEntries(MODELS.map((model) => [`${model}.js`, exploring(model)])),
  ...Object.fromEntries(
    MODELS.map((model) => [`${model}_worker.js`, answering(`./explore/models/${model}_worker.js`)]),
  ),
};

function answering(model) {
  return `import { Model } from "${model}"; import { serve } from "./explore/worker.js"; serve(Model);`;
}

function exploring(model) {
  return `import { VIEW } from "./explore/models/${model}_view.js"; import { start } from "./explore/page.js";
start(VIEW);
export { VIEW };
${SHOWN}`;
}

async function bundled(name, contents) {
  const kind = name.endsWith(".css") ? "css" : "js";
  const made = await esbuild.build({
    stdin: { contents, resolveDir: WEB, loader: kind },
    bundle: true,
    write: false,
    format: kind === "js" ? "iife" : undefined,
    globalName: kind === "js" && contents.includes("export ") ? "page" : undefined,
    target: "es2022",
    charset: "utf8",
    minify: true,
    legalComments: "inline",
    nodePaths: [join(HERE, "node_modules")],
    logLevel: "warning",
  });
  return made.outputFiles[0].text;
}

const digest = (text) => createHash("sha256").update(text).digest("hex").slice(0, 16);

/** Return the digest of all that bundles are made of: paths and texts, in the order of their paths. */
function digestOfSources() {
  const files = readdirSync(WEB, { recursive: true })
    .map((name) => name.replaceAll("\\", "/"))
    .filter((name) => /\.(js|css)$/.test(name) && !name.startsWith("bundle/"))
    .map((name) => [name, join(WEB, name)]);
  for (const name of ["bundle.mjs", "package-lock.json"]) files.push([name, join(HERE, name)]);
  files.sort(([one], [other]) => (one < other ? -1 : 1));
  return digest(
    files.map(([name, path]) => `${name}\n${readFileSync(path, "utf8").replaceAll("\r\n", "\n")}`).join("\0"),
  );
}

const texts = {};
for (const [name, contents] of Object.entries(BUNDLES)) texts[name] = await bundled(name, contents);
const files = Object.fromEntries(Object.entries(texts).map(([name, text]) => [name, digest(text)]));
texts["made_of.json"] = `${JSON.stringify({ sources: digestOfSources(), files }, null, 2)}\n`;

if (process.argv.includes("--check")) {
  const kept = (name) => (existsSync(join(OUT, name)) ? readFileSync(join(OUT, name), "utf8") : "");
  const stale = Object.keys(texts).filter((name) => kept(name).replaceAll("\r\n", "\n") !== texts[name]);
  if (stale.length) console.error(`stale, npm run --prefix lab/pages bundle makes them: ${stale.join(", ")}`);
  process.exitCode = stale.length ? 1 : 0;
} else {
  rmSync(OUT, { recursive: true, force: true });
  mkdirSync(OUT);
  for (const [name, text] of Object.entries(texts)) writeFileSync(join(OUT, name), text);
  console.log(`${Object.keys(files).length} bundles in ${relative(process.cwd(), OUT)}`);
}
