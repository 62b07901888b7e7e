/* What a reader takes along: signals as CSV, a plot as SVG or PNG, the key figures as text. */

import { el, every } from "../draw.js";
import { colour } from "./page_parts.js";

const WIDE = 900,
  HIGH = 320,
  MARGIN = { left: 70, right: 16, top: 34, bottom: 40 };

function save(name, content, type) {
  const link = el("a", {
    href: URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type })),
    download: name,
  });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const button = (face, words, onclick) =>
  el("button", { type: "button", title: words, "aria-label": words, onclick }, face);
const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/* All signals that change, at the page's points, in the units that the page shows. */
export function csv(state) {
  const run = state.runs[0],
    names = [...run.signals.keys()];
  const head = ["time [s]", ...names.map((name) => `${name} [${run.signals.get(name).unit}]`)]
    .map(quoted)
    .join(",");
  const columns = names.map((name) => run.signals.get(name));
  const rows = Array.from(state.time, (t, i) =>
    [t, ...columns.map((s) => (s.values[i] - s.zero) / s.scale)]
      .map((v) => (Number.isFinite(v) ? String(Number(v.toPrecision(7))) : ""))
      .join(","),
  );
  return [head, ...rows, ""].join("\n");
}

/* A plot as drawing: what is switched on, in the zoom of now. */
export function svg(panel, state) {
  const { plot } = panel,
    { min, max } = state.view,
    scale = plot.scales.y,
    log = panel.given.logarithmic,
    f = log ? Math.log10 : (v) => v;
  const x = (t) => MARGIN.left + ((t - min) / (max - min)) * (WIDE - MARGIN.left - MARGIN.right);
  const y = (v) =>
    HIGH -
    MARGIN.bottom -
    ((f(v) - f(scale.min)) / (f(scale.max) - f(scale.min))) * (HIGH - MARGIN.top - MARGIN.bottom);
  const escaped = (text) => String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`),
    parts = [];
  const text = (px, py, words, more = "") =>
    parts.push(`<text x="${px.toFixed(1)}" y="${py.toFixed(1)}" ${more}>${escaped(words)}</text>`);
  state.runs[0].phases.forEach(([name, start, end], i) => {
    const [a, b] = [Math.max(start, min), Math.min(end, max)];
    if (b <= a) return;
    parts.push(
      `<rect x="${x(a).toFixed(1)}" y="${MARGIN.top}" width="${(x(b) - x(a)).toFixed(1)}" height="${HIGH - MARGIN.top - MARGIN.bottom}" fill="${colour(`phase${i % 5}`)}"/>`,
    );
    if (x(b) - x(a) > 7 * name.length) text(x(a) + 4, MARGIN.top + 13, name, 'class="soft"');
  });
  const [across, up] = plot.axes;
  (across._splits ?? []).forEach((t, i) =>
    text(x(t), HIGH - MARGIN.bottom + 16, across._values[i] ?? "", 'text-anchor="middle"'),
  );
  (up._splits ?? []).forEach((v, i) => {
    if (up._values[i] === null || up._values[i] === "") return;
    parts.push(
      `<path d="M${MARGIN.left} ${y(v).toFixed(1)}H${WIDE - MARGIN.right}" stroke="${colour("line")}"/>`,
    );
    text(MARGIN.left - 6, y(v) + 4, up._values[i], 'text-anchor="end"');
  });
  let key = MARGIN.left;
  plot.series.forEach((series, k) => {
    if (!k || !series.show || !series.width) return;
    const own = plot.data[k],
      dash = series.dash ? ' stroke-dasharray="6 4"' : "",
      ink = colour(panel.colours[series.label]),
      points = [];
    for (let i = 0; i < state.time.length; i += 1) {
      if (state.time[i] >= min && state.time[i] <= max && Number.isFinite(own[i]) && own[i] !== null)
        points.push(`${x(state.time[i]).toFixed(1)},${y(own[i]).toFixed(1)}`);
    }
    parts.push(
      `<polyline fill="none" stroke="${ink}" stroke-width="1.6"${dash} points="${points.join(" ")}"/>`,
    );
    text(key, 26, series.label, `fill="${ink}"`);
    key += 7 * series.label.length + 18;
  });
  text(MARGIN.left, 12, `${panel.given.title} [${panel.unit}]`, 'font-weight="bold"');
  text((WIDE + MARGIN.left) / 2, HIGH - 8, "time [s]", 'text-anchor="middle"');
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDE} ${HIGH}" width="${WIDE}" height="${HIGH}" font-family="sans-serif" font-size="12" fill="${colour("ink")}"><rect width="100%" height="100%" fill="${colour("paper")}"/>${parts.join("")}</svg>`;
}

function png(panel) {
  const from = panel.plot.ctx.canvas,
    made = el("canvas", { width: from.width, height: from.height }),
    context = made.getContext("2d");
  context.fillStyle = colour("paper");
  context.fillRect(0, 0, made.width, made.height);
  context.drawImage(from, 0, 0);
  made.toBlob((blob) => save(`${nameOf(panel)}.png`, blob));
}

const nameOf = (panel) => panel.given.title.toLowerCase().replace(/\W+/g, "-");

/* The buttons of a plot. */
export function ofPanel(panel, state) {
  const { title } = panel.given;
  return el(
    "span",
    { class: "takes" },
    button(
      "SVG",
      `save ${title} as SVG`,
      () => panel.plot && save(`${nameOf(panel)}.svg`, svg(panel, state), "image/svg+xml"),
    ),
    button("PNG", `save ${title} as PNG`, () => panel.plot && png(panel)),
  );
}

export const ofSignals = (state) =>
  button("CSV", "save all signals as CSV", () => save("signals.csv", csv(state), "text/csv"));

/* The button that copies the key figures, a line each. */
export function ofFigures(place) {
  const said = el("span", { role: "status" });
  place.append(
    button("copy the key figures", "copy the key figures as text", async () => {
      const rows = every("#key-figures tr[data-figure]").map((row) =>
        [row.dataset.figure, ...[...row.cells].map((cell) => cell.textContent)].join("\t"),
      );
      try {
        await navigator.clipboard.writeText(rows.join("\n"));
        said.textContent = ` ${rows.length} lines copied`;
      } catch {
        said.textContent = " this browser does not let a page copy";
      }
    }),
    said,
  );
}
