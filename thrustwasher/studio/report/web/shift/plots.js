/* Plots over one time: a common cursor, a common zoom, signals that are switched on and off. */

import { el } from "../draw.js";
import * as Controls from "./controls.js";
import { NAMES, first, last, moveTo, pan, schedule, state, zoom, zoomBy } from "./cursor.js";
import * as Exports from "./exports.js";
import { colour, number } from "./page_parts.js";
import * as Address from "./state.js";
import uPlot from "uplot";

const COLOURS = ["blue", "red", "green", "orange", "purple", "sky", "black", "grey"];
const DASHES = [undefined, [6, 4]];
const NEAR = 6; // pixels: a click this near to an event means it
const HEIGHT = 200,
  FIRST = 250;
const APART = 24; // pixels between ticks of values, at least: three fit into the lowest plot
const PAPER = 660,
  HALF = 320; // pixels that a plot is wide in print: the first ones, those side by side

/* Bring what can be seen up to date; all else follows when it comes into sight. */
function paint() {
  for (const panel of state.panels) if (panel.visible) paintPanel(panel);
}

function paintPanel(panel) {
  const { plot } = panel;
  if (plot) {
    if (panel.view !== state.view) {
      panel.view = state.view;
      plot.batch(() => plot.setScale("x", state.view)); // at once: the cursor is placed on it
    }
    const left = plot.valToPos(state.time[state.index], "x");
    plot.setCursor({ left: left >= 0 && left <= plot.over.clientWidth ? left : -10, top: 0 }, false);
  }
  for (const { signal, cells, body } of panel.rows) {
    if (body.parentNode.open === false) continue;
    cells.forEach((cell, k) => {
      const own = state.runs[k].signals.get(signal.name);
      cell.textContent = own ? number(own.values[state.index], own) : "–";
    });
  }
}

/* Panels */

function panelOf(given, known) {
  const aside = state.runs[0].aside;
  const names = Object.keys(given.signals).filter(
    (n) => known.get(n) && !known.get(n).steady && !aside.includes(n),
  );
  const panel = {
    given,
    rows: [],
    shown: names.map((name) => known.get(name)),
    visible: false,
    colours: {},
  };
  names.forEach((name) => {
    panel.colours[name] = given.signals[name];
  });
  return panel;
}

/* Every signal has one panel: where it is named, or the first one of its unit. */
function sorted(definitions) {
  const known = new Map([...state.runs].reverse().flatMap((run) => [...run.signals]));
  const panels = definitions.map((given) => panelOf(given, known)).filter((p) => p.shown.length);
  for (const panel of panels) panel.unit = panel.shown[0].unit;
  const taken = new Set(panels.flatMap((p) => p.shown.map((s) => s.name)));
  for (const signal of known.values()) {
    if (taken.has(signal.name)) continue;
    let panel =
      signal.unit === "1" ? undefined : panels.find((p) => p.unit === signal.unit && !p.given.turning);
    panel ??= panels.find((p) => p.unit === signal.unit && p.more);
    if (!panel) {
      const title = `Signals ${signal.unit === "1" ? "without unit" : `in ${signal.unit}`}`;
      panel = { ...panelOf({ title, signals: {} }, known), unit: signal.unit, more: true };
      panels.push(panel);
    }
    (panel.extras ??= []).push(signal);
  }
  return panels;
}

/* What is drawn of a signal: nothing where its part stands still, no value below a logarithmic floor. */
function drawn(panel, run, signal) {
  const { turning, floor, logarithmic } = panel.given;
  const own = run.signals.get(signal.name);
  if (!own) return new Array(state.time.length).fill(null);
  const speed = turning && run.signals.get(`${signal.name.split(".")[0]}.speed`);
  return Array.from(own.values, (value, i) => {
    if (value === null || !Number.isFinite(value) || (speed && Math.abs(speed.values[i]) < turning))
      return null;
    return logarithmic ? Math.max(value, floor) : (value - own.zero) / own.scale;
  });
}

/* The ends of a signal's band, 5 and 95 %, at the page's times; none where it is not known. */
function bandOf(panel, run, signal) {
  const band = run.bands?.[signal.name];
  if (!band) return undefined;
  const [time, ...ends] = band,
    own = run.signals.get(signal.name);
  let i = 0;
  const places = Array.from(state.time, (t) => {
    while (i < time.length - 2 && time[i + 1] <= t) i++;
    return t < time[0] || t > time[time.length - 1]
      ? undefined
      : [i, (t - time[i]) / (time[i + 1] - time[i])];
  });
  return ends.map((values) =>
    places.map((place) => {
      if (!place || values[place[0]] === null || values[place[0] + 1] === null) return null;
      const value = values[place[0]] + place[1] * (values[place[0] + 1] - values[place[0]]);
      return panel.given.logarithmic ? Math.max(value, panel.given.floor) : (value - own.zero) / own.scale;
    }),
  );
}

/* Lines of a panel: each signal of each run, behind them the ends of the bands. */
function linesOf(panel) {
  const lines = panel.shown.flatMap((signal) =>
    state.runs.map((run, k) => ({ signal, k, values: drawn(panel, run, signal) })),
  );
  const ends = panel.shown.flatMap((signal) =>
    state.runs.flatMap((run, k) =>
      (bandOf(panel, run, signal) ?? []).map((values) => ({ signal, k, values, end: true })),
    ),
  );
  return [...lines, ...ends];
}

/* A colour of the page that lets others through. */
function pale(name) {
  const full = colour(name);
  return full.length === 4 ? `${full}3` : `${full}33`;
}

/* What draws on a plot with the colours of now; `dots`: pixels of the screen. */
function drawing(name, work) {
  return (u) => {
    const { ctx, bbox } = u,
      dots = devicePixelRatio;
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = colour(name);
    ctx.font = `${11 * dots}px system-ui, sans-serif`;
    work(u, ctx, bbox, dots);
    ctx.restore();
  };
}

function strokeLine(ctx, from, to) {
  ctx.beginPath();
  ctx.moveTo(...from);
  ctx.lineTo(...to);
  ctx.stroke();
}

function shade(u, ctx, bbox) {
  const at = (t) => Math.max(bbox.left, Math.min(bbox.left + bbox.width, u.valToPos(t, "x", true)));
  state.runs[0].phases.forEach(([, start, end], i) => {
    ctx.fillStyle = colour(`phase${i % 5}`);
    ctx.fillRect(at(start), bbox.top, at(end) - at(start), bbox.height);
  });
}

/* The names of the phases where there is room for them. */
function namePhases(u, ctx, bbox, dots) {
  ctx.textAlign = "left";
  for (const [name, start, end] of state.runs[0].phases) {
    const [a, b] = [start, end].map((t) =>
      Math.max(bbox.left, Math.min(bbox.left + bbox.width, u.valToPos(t, "x", true))),
    );
    if (ctx.measureText(name).width + 8 * dots < b - a)
      ctx.fillText(name, a + 4 * dots, bbox.top + bbox.height - 6 * dots);
  }
}

function drawLevels(panel, u, ctx, bbox, dots) {
  const end = bbox.left + bbox.width,
    high = 12 * dots,
    taken = [];
  ctx.textAlign = "right";
  ctx.setLineDash([2 * dots, 3 * dots]);
  for (const [value, words] of [...(panel.given.levels ?? []), ...panel.limits]) {
    const y = u.valToPos(value, "y", true),
      wide = ctx.measureText(words).width;
    if (!(y > bbox.top && y < bbox.top + bbox.height)) continue;
    strokeLine(ctx, [bbox.left, y], [end, y]);
    // above its line, else below it; what finds room at neither side is left to the heading's words
    const sides = [y - 3 * dots - high, y + 3 * dots];
    if (words.endsWith("below")) sides.reverse();
    const free = (top) =>
      top >= bbox.top + 13 * dots &&
      top + high <= bbox.top + bbox.height &&
      taken.every((other) => Math.abs(top - other) >= high);
    const top = sides.find(free);
    if (top === undefined) continue;
    taken.push(top);
    ctx.fillStyle = colour("paper");
    ctx.fillRect(end - 6 - wide, top, wide + 6, high);
    ctx.fillStyle = colour("soft");
    ctx.fillText(words, end - 4, top + high - 2 * dots);
  }
}

function mark(u, ctx, bbox, dots) {
  const numbers = [],
    most = Math.max(1, Math.floor(bbox.height / (13 * dots)));
  let before = -Infinity,
    up = 0;
  ctx.textAlign = "left";
  ctx.setLineDash([dots, 3 * dots]);
  for (const event of state.events) {
    const x = u.valToPos(event.time, "x", true);
    if (x < bbox.left || x > bbox.left + bbox.width) continue;
    up = x - before < 18 * dots ? up + 1 : 0;
    before = x;
    strokeLine(ctx, [x, bbox.top], [x, bbox.top + bbox.height]);
    numbers.push([event.number, x + 2 * dots, bbox.top + 13 * (up % most) * dots]);
  }
  for (const [text, x, y] of numbers) {
    ctx.globalAlpha = 0.75;
    ctx.fillStyle = colour("paper");
    ctx.fillRect(x, y + dots, ctx.measureText(text).width + 2 * dots, 12 * dots);
    ctx.globalAlpha = 1;
    ctx.fillStyle = colour("mark");
    ctx.fillText(text, x + dots, y + 11 * dots);
  }
}

export function axisOf(given = {}) {
  const grid = { stroke: () => colour("line"), width: 1 };
  return {
    stroke: () => colour("soft"),
    grid,
    ticks: { ...grid, size: 5 },
    font: "12px system-ui, sans-serif",
    ...given,
  };
}

function options(panel, lines) {
  const start = lines.findIndex((line) => line.end);
  const bands = lines
    .filter((line) => line.end)
    .filter((_, i) => i % 2 === 0)
    .map(({ signal }, i) => ({
      series: [start + 2 * i + 2, start + 2 * i + 1],
      fill: () => pale(panel.colours[signal.name]),
    }));
  return {
    width: Math.max(200, panel.chart.clientWidth),
    height: panel.given.first ? FIRST : HEIGHT,
    legend: { show: false },
    cursor: {
      y: false,
      drag: { x: true, y: false, setScale: false, dist: 5 },
      bind: {
        dblclick: () => () => {
          zoom(first(), last());
          return null;
        },
      },
    },
    scales: { x: { time: false }, y: panel.given.logarithmic ? { distr: 3 } : {} },
    axes: [
      axisOf({
        label: "time [s]",
        labelSize: 16,
        labelGap: 0,
        labelFont: "12px system-ui, sans-serif",
        size: 30,
        values: (u, ticks) => ticks.map((t) => number(t)),
      }),
      axisOf({ size: 66, space: APART }),
    ],
    bands,
    series: [
      {},
      ...lines.map(({ signal, k, end }) => ({
        label: signal.name,
        stroke: end ? undefined : () => colour(panel.colours[signal.name]),
        width: end ? 0 : 1.6,
        dash: DASHES[k],
        points: { show: false },
        show: !panel.off?.has(signal.name),
      })),
    ],
    hooks: {
      drawClear: [drawing("shade", shade)],
      draw: [
        drawing("soft", (...given) => drawLevels(panel, ...given)),
        drawing("mark", mark),
        ...(panel.given.first ? [drawing("soft", namePhases)] : []),
      ],
      setSelect: [take],
    },
  };
}

function take(u) {
  const { left, width } = u.select;
  if (width < 5) return;
  u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  zoom(u.posToVal(left, "x"), u.posToVal(left + width, "x"));
}

function draw(panel) {
  panel.plot?.destroy();
  panel.plot = undefined;
  panel.chart.hidden = !panel.shown.length;
  if (!panel.shown.length) return;
  panel.limits = panel.shown
    .filter((s) => s.limit)
    .map((s) => [(s.limit - s.zero) / s.scale, `limit ${number(s.limit, s)}`]);
  const lines = linesOf(panel);
  panel.plot = new uPlot(
    options(panel, lines),
    [state.time, ...lines.map((line) => line.values)],
    panel.chart,
  );
  panel.view = undefined;
  listen(panel.plot);
}

function listen(plot) {
  const { over } = plot;
  const follow = (e) => moveTo(plot.posToIdx(e.clientX - over.getBoundingClientRect().left));
  over.addEventListener("pointermove", follow);
  over.addEventListener("pointerdown", follow);
  over.addEventListener("mouseleave", () => setTimeout(schedule)); // the library takes its cursor away
  over.addEventListener("click", (e) => {
    const near = state.events.find((event) => Math.abs(plot.valToPos(event.time, "x") - e.offsetX) < NEAR);
    if (near) state.select(near);
  });
  over.addEventListener(
    "wheel",
    (e) => {
      if (!e.ctrlKey && !e.shiftKey) return;
      e.preventDefault();
      if (e.ctrlKey) zoomBy(e.deltaY > 0 ? 1.25 : 0.8, plot.posToVal(e.offsetX, "x"));
      else pan(e.deltaY > 0 || e.deltaX > 0 ? 0.1 : -0.1);
    },
    { passive: false },
  );
}

function toggle(panel, signal, on) {
  panel.off ??= new Set();
  Address.chose(signal.name, on, panel.usual.has(signal.name));
  if (!panel.shown.includes(signal)) {
    panel.shown.push(signal);
    draw(panel);
  } else {
    if (on) panel.off.delete(signal.name);
    else panel.off.add(signal.name);
    panel.plot.series.forEach((line, i) => {
      if (i && line.label === signal.name) panel.plot.setSeries(i, { show: on });
    });
  }
  schedule();
}

function rowOf(panel, body, signal, on) {
  panel.colours[signal.name] ??= COLOURS[Object.keys(panel.colours).length % COLOURS.length];
  const cells = state.runs.map(() => el("td"));
  const box = el("input", {
    type: "checkbox",
    checked: on,
    "data-signal": signal.name,
    onchange: () => toggle(panel, signal, box.checked),
  });
  const line = el("i", { style: `border-color: var(--${panel.colours[signal.name]})` });
  const row = el(
    "tr",
    {},
    el("th", { scope: "row", title: signal.name }, el("label", {}, box, line, el("span", {}, signal.help))),
    ...cells,
  );
  body.tBodies[0].append(row);
  panel.rows.push({ signal, cells, body });
}

function tableOf(panel) {
  const unit = panel.unit === "1" ? "value" : panel.unit;
  const heads = state.runs.map((run, k) =>
    el("th", { scope: "col" }, state.runs.length > 1 ? NAMES[k] : unit),
  );
  return el(
    "table",
    {},
    el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "at the cursor"), ...heads)),
    el("tbody"),
  );
}

function build(panel, place) {
  panel.chart = el("div", {
    class: "chart",
    role: "img",
    "aria-label": `${panel.given.title} over time; the values at the cursor are in the table that follows`,
  });
  const legend = el("div");
  const table = tableOf(panel);
  panel.usual = new Set(panel.shown.map((signal) => signal.name));
  if (panel.shown.length) legend.append(table);
  panel.shown.forEach((signal) => rowOf(panel, table, signal, true));
  if (panel.extras) legend.append(extrasOf(panel));
  const unit = el("span", { class: "unit" }, ` [${panel.unit}]`);
  const note = el("span", { class: "note" }, panel.given.note ? ` ${panel.given.note}` : "");
  const head = panel.more ? [] : [el("h3", {}, panel.given.title, unit, note, Exports.ofPanel(panel, state))];
  panel.box = el(
    "section",
    { class: panel.more ? "panel more" : "panel" },
    ...head,
    el("div", { class: "beside" }, panel.chart, legend),
  );
  place.append(panel.box);
}

function extrasOf(panel) {
  const table = tableOf(panel);
  const of = panel.more ? panel.given.title.slice("Signals".length) : "";
  const words = `${panel.extras.length} more signal${panel.extras.length > 1 ? "s" : ""}${of}`;
  const fold = el(
    "details",
    {
      "data-stays": true,
      ontoggle: () => {
        if (fold.open && !table.tBodies[0].rows.length)
          panel.extras.forEach((s) => rowOf(panel, table, s, false));
        schedule();
      },
    },
    el("summary", {}, words),
    table,
  );
  return fold;
}

function allPlots() {
  return [...state.panels.map((panel) => panel.plot).filter(Boolean), ...state.others];
}

function repaint() {
  for (const plot of allPlots()) plot.redraw(false);
}

function fit(paper) {
  for (const plot of allPlots()) {
    const width = paper
      ? plot.root.closest("#plots")
        ? HALF
        : PAPER
      : Math.max(200, plot.root.parentNode.clientWidth);
    plot.setSize({ width, height: plot.height });
  }
}

function watch() {
  const seen = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) {
        const panel = state.panels.find((p) => p.box === entry.target);
        panel.visible = entry.isIntersecting;
        if (panel.visible && !panel.plot) draw(panel);
      }
      schedule();
    },
    { rootMargin: "200px" },
  );
  for (const panel of state.panels) seen.observe(panel.box);
  addEventListener("resize", () => fit());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", repaint);
  addEventListener("beforeprint", () => {
    for (const panel of state.panels) {
      if (!panel.plot) draw(panel);
      paintPanel(panel);
    }
    fit(true);
    repaint();
  });
  addEventListener("afterprint", () => {
    fit();
    repaint();
  });
}

/* What lies further down is drawn panel by panel: who jumps there finds it. */
function drawRest() {
  const next = state.panels.find((panel) => !panel.plot && panel.shown.length);
  if (!next) return;
  draw(next);
  paintPanel(next);
  setTimeout(drawRest, 20);
}

/* The events of all runs, numbered; one that both have at the same time stands there once. */
function happened() {
  const found = new Map();
  state.runs.forEach((run, k) =>
    run.events.forEach(([time, text]) => {
      const known = found.get(`${time} ${text}`);
      if (known) known.of += ` ${NAMES[k]}`;
      else found.set(`${time} ${text}`, { time, text, of: NAMES[k] });
    }),
  );
  const events = [...found.values()].sort((a, b) => a.time - b.time);
  return events.map((event, i) => ({ ...event, number: i + 1 }));
}

/* Switch a signal on or off by its name; nothing happens where there is none. */
function choose(name, on) {
  for (const panel of state.panels) {
    const signal = [...panel.shown, ...(panel.extras ?? [])].find((one) => one.name === name);
    if (!signal) continue;
    if (!panel.plot) draw(panel);
    const fold = panel.box.querySelector("details");
    if (panel.extras?.includes(signal)) fold.open = true;
    toggle(panel, signal, on);
    const boxOf = () => panel.box.querySelector(`input[data-signal="${CSS.escape(name)}"]`);
    if (boxOf()) boxOf().checked = on;
    else
      setTimeout(() => {
        if (boxOf()) boxOf().checked = on;
      });
    return;
  }
}

export function show(data, found, place, hero) {
  Object.assign(state, found, { view: { min: found.time[0], max: found.time[found.time.length - 1] } });
  state.events = happened();
  state.listeners.push(paint);
  Controls.build(state, place);
  state.panels = sorted(data.panel);
  for (const panel of state.panels) build(panel, hero && panel.given.first ? hero : place);
  watch();
  schedule();
  Address.apply(state, choose);
  setTimeout(drawRest, 200);
}
