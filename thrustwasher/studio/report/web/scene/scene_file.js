/* The scene as a TOML file that the command line runs. */

import { ABOUT } from "../explore/dom.js";
import { KNOWN, isSame } from "./profiles.js";

const plainKey = (name) => (/^[A-Za-z_]\w*$/.test(name) ? name : JSON.stringify(name));
const isTable = (value) => value !== null && typeof value === "object" && !Array.isArray(value);

/** Return a value as TOML writes it, numbers in full. */
function tomlValue(value) {
  if (Array.isArray(value)) return `[${value.map(tomlValue).join(", ")}]`;
  if (isTable(value))
    return `{ ${Object.entries(value)
      .map(([k, v]) => `${plainKey(k)} = ${tomlValue(v)}`)
      .join(", ")} }`;
  return JSON.stringify(value);
}

/** Return the lines of a table, its own values first. */
function tomlLines(table, above = "") {
  const entries = Object.entries(table),
    inner = entries.filter(([, v]) => isTable(v)),
    own = entries.filter(([, v]) => !isTable(v));
  const head = (own.length || !inner.length) && above ? ["", `[${above}]`] : []; // an empty table says that a part is there
  return [
    ...head,
    ...own.map(([k, v]) => `${plainKey(k)} = ${tomlValue(v)}`),
    ...inner.flatMap(([k, v]) => tomlLines(v, above ? `${above}.${plainKey(k)}` : plainKey(k))),
  ];
}

/** Return the text of a file with these profiles. */
export function sceneText(profiles) {
  const tables = structuredClone(ABOUT.file);
  const place = (path) => path.split(".").reduce((table, key) => (table[key] ??= {}), tables);
  for (const [name, points] of Object.entries(profiles)) {
    if (isSame(points, KNOWN[name].points)) continue;
    if (name === "shift_command")
      Object.assign(place("shift"), { start: points[0][0], duration: points[1][0] - points[0][0] });
    else place(KNOWN[name].table).points = points;
  }
  return `# ${ABOUT.name}, its profiles set in a browser\n${tomlLines(tables).join("\n")}\n`;
}
