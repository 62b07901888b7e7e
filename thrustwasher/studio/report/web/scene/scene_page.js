/* The page of a scene: profiles dragged by their points, the shift run again and again, figures and plots next to those of A. */

import { byId, el, every } from "../draw.js";
import { ABOUT, digits, pretty, quantiles, readQuantity, shown } from "../explore/dom.js";
import { Plot } from "../explore/plot.js";
import { KNOWN, isSame, movedPoint, profilesOf, readProfile, writtenProfile, wrongWith } from "./profiles.js";
import { textOf, writer } from "./quantity.js";
import { sceneText } from "./scene_file.js";
import * as Units from "../units.js";

const SETTLE = 300; // ms after the last change: then the washers are solved on their own level
const DRAWN = 420; // points of a line, at most
const MOST_TIMES = 131; // instants of a band
const LOOKS = ["one", "two", "three"];
const WASHERS = Object.keys(ABOUT.washers),
  OWN = WASHERS.length ? ABOUT.washers[WASHERS[0]].level : "";
const QUICK =
  WASHERS.length && OWN !== "map"
    ? WASHERS.every((name) => ABOUT.washers[name].map)
      ? "map"
      : "recorded"
    : "";
const LEVEL_WORDS = {
  map: "by their map",
  recorded: "with the torque of the last full run",
  "": WASHERS.length ? `at their own fidelity level, ${OWN}` : "none in this scene",
};
/** @type {[string, string[]][]} */
const EDITORS = [
  ["Pressures on the pistons", ["clutch_pressure", "brake_pressure"]],
  ["Engine torque", ["engine_torque"]],
  ["Shift command", ["shift_command"]],
];
const VIEWS = [
  {
    title: "Speeds",
    label: "speed",
    unit: "rad/s",
    lines: [
      ["engine", "transmission.engine_speed", 1],
      ["engine in first gear", "transmission.output_speed", ABOUT.ratio],
      ["output", "transmission.output_speed", 1],
    ],
    band: "transmission.engine_speed",
  },
  {
    title: "Torques of the packs",
    label: "torque",
    unit: "N.m",
    lines: [
      ["clutch", "transmission.clutch_reaction", 1],
      ["brake", "transmission.brake_reaction", 1],
    ],
  },
  {
    title: "Heat of the packs",
    label: "heat",
    unit: "J",
    lines: [
      ["clutch", "transmission.clutch_heat", 1],
      ["brake", "transmission.brake_heat", 1],
    ],
  },
  ABOUT.reach === null
    ? {
        title: "Acceleration of the output",
        label: "acceleration",
        unit: "rad/s2",
        lines: [["output", "transmission.output_acceleration", 1]],
        band: "transmission.output_acceleration",
      }
    : {
        title: "Acceleration of the vehicle",
        label: "acceleration",
        unit: "m/s2",
        lines: [["vehicle", "transmission.output_acceleration", ABOUT.reach]],
        band: "transmission.output_acceleration",
      },
  {
    title: "Interface temperature",
    label: "temperature",
    unit: "K",
    lines: [
      ["clutch", "clutch.temperature", 1],
      ["brake", "brake.temperature", 1],
    ],
  },
];

let now = profilesOf(),
  pinned = { profiles: profilesOf(), run: /** @type {any} */ (null) },
  shown_ = /** @type {any} */ (null);
let quick = /** @type {any} */ (null),
  slow = /** @type {Runner | null} */ (null),
  recorded = /** @type {any} */ (null);
let busy = false,
  waiting = false,
  timer = 0,
  count = 0,
  strange = "",
  changes = 0,
  solvedFor = -1;
/** @type {{queue: any[], found: any[], for: number, running: boolean, bands?: any}} */
let draws = { queue: [], found: [], for: -1, running: false };
/** @type {Record<string, any>} */
export const editors = {};
/** @type {any[]} */
const views = [];

/** A worker with the kernels of all models. */
class Runner {
  constructor(modules, data) {
    const source = byId("worker").textContent;
    this.heard = {};
    this.worker = new Worker(URL.createObjectURL(new Blob([source], { type: "text/javascript" })));
    this.worker.onmessage = ({ data: { id, task, result, problem } }) =>
      this.heard[id]?.(result, problem, task);
    this.worker.onerror = (problem) =>
      say(`The computation stopped: ${problem.message}. The figures are those of the last run.`, "problem");
    this.count = 0;
    /** @type {Promise<void>} */
    this.ready = new Promise((answer, refuse) => {
      this.post("begin", { about: data, modules }, (_, problem) =>
        problem ? refuse(new Error(problem)) : answer(),
      );
    });
  }

  post(task, given, answer) {
    const id = (this.count += 1);
    this.heard[id] = (...what) => {
      delete this.heard[id];
      answer(...what);
    };
    this.worker.postMessage({ id, task, ...given });
  }

  /** Give up what is under way. */
  stop() {
    this.worker.postMessage({ task: "stop" });
  }

  /** Run the scene; a run that is under way is given up. */
  run(given, answer) {
    this.post("run", { given: [given] }, answer);
  }
}

async function inflated(text) {
  const bytes = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  return new Response(
    new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate")),
  ).arrayBuffer();
}

function say(text, look = "") {
  const place = byId("state");
  place.className = look;
  if (place.textContent !== text) place.textContent = text;
}

/** Run the scene with the washers' quick way; one run is in flight, the last wish waits. */
function wish() {
  changes += 1;
  draws.queue = [];
  slow?.stop();
  clearTimeout(timer);
  timer = setTimeout(settled, SETTLE);
  if (busy) waiting = true;
  else start();
}

function start() {
  busy = true;
  const which = changes,
    given = { profiles: now, washers: QUICK, recorded };
  recorded = null;
  draws.running = false; // a draw in flight is given up
  quick.run(given, (result, problem) => {
    busy = false;
    if (problem) failed(problem);
    else received(result, given.profiles, QUICK, which);
    if (waiting) {
      waiting = false;
      start();
    }
  });
}

/** After the last change: the state goes into the address, washers are solved on their own level, draws follow. */
function settled() {
  if (busy || waiting) {
    timer = setTimeout(settled, 30);
    return;
  }
  keepAddress();
  const which = changes,
    profiles = structuredClone(now);
  if (QUICK && shown_ && solvedFor !== which && !shown_.problem) {
    slow ??= new Runner(MODULES, DATA);
    slow.run({ profiles, washers: "" }, (result, problem) => {
      if (which !== changes) return;
      if (problem)
        say(
          `The washers at their own fidelity level: ${problem}. The figures are those ${LEVEL_WORDS[QUICK]}.`,
          "problem",
        );
      else {
        recorded = result.recorded;
        received(result, profiles, "", which);
      }
    });
  }
  followDraws();
}

function received(result, profiles, washers, which) {
  if (washers === "" && QUICK) solvedFor = which;
  shown_ = { ...result, profiles, washers };
  pinned.run ??= isStart(pinned.profiles) && isStart(profiles) ? shown_ : null;
  if (pinned.run && pinned.run.washers !== "" && washers === "" && sameAll(pinned.profiles, profiles))
    pinned.run = shown_;
  count += 1;
  document.body.classList.remove("stale");
  byId("run_count").value = byId("run_count").textContent = String(count);
  byId("washer_level").value = washers || OWN;
  byId("washer_level").textContent = LEVEL_WORDS[washers];
  showFigures();
  const warned = showWarnings(result.warnings, washers);
  drawViews();
  const later = washers && solvedFor !== which ? `; at their own fidelity level, ${OWN}, in a moment` : "";
  say(
    `${strange}This run took ${digits(result.took, 2)} ms${WASHERS.length ? `, the washers ${LEVEL_WORDS[washers]}${later}` : ""}.${warned ? ` ${warned} warning${warned > 1 ? "s" : ""}, listed above the plots.` : ""}`,
    strange ? "problem" : "",
  );
  if (washers === QUICK) document.documentElement.dataset.took = String(result.took);
  document.documentElement.dataset.run = String(count);
}

function failed(problem) {
  document.body.classList.add("stale");
  if (shown_) shown_.problem = problem;
  showWarnings(null);
  say(
    `${strange}No run with these profiles: ${problem}. The figures are those of ${shown_ ? "the last run" : "the scene as it is"}.`,
    "problem",
  );
  document.documentElement.dataset.run = `failed ${(count += 1)}`;
}

const isStart = (profiles) => sameAll(profiles, profilesOf());
const sameAll = (one, other) => Object.keys(KNOWN).every((name) => isSame(one[name], other[name]));

/** Write a quantity in the units chosen, else as the command line does. */
const write = writer(ABOUT.units);
const sayQuantity = (value, unit, n = 4, relative = false) =>
  Units.of(unit, relative) ? shown(value, unit, relative, n) : write(value, unit, n, relative);

/** Show the warnings of the run whose figures are displayed, null: it failed; those of no other run stay. */
function showWarnings(found, washers = "") {
  const { checked_outside: outside } = ABOUT.warnings,
    all = (found ?? []).map(({ pieces }) => textOf(pieces, sayQuantity));
  const head = found
    ? `Warnings of this run: ${all.length || "none"}`
    : "The run failed; the line at the top says why";
  const later =
    found && washers === "recorded" ? ["Warnings about the washers follow with their own solution."] : [];
  byId("warnings").replaceChildren(
    el("h2", { id: "warnings-head" }, head),
    el("ul", {}, ...all.map((text) => el("li", { class: "warning" }, text))),
    ...later.map((text) => el("p", { class: "note" }, text)),
    el(
      "p",
      { class: "note" },
      "Checked only by ",
      el("code", {}, "thrustwasher shift"),
      `: ${outside.join("; ")}.`,
    ),
  );
  return all.length;
}

/** Put the figures into their places, those of A and the difference below. */
function showFigures() {
  const { engaging } = shown_.shift,
    a = pinned.run?.figures ?? {};
  for (const place of every("data[id]")) {
    const about = ABOUT.figures[place.id],
      name =
        place.id.startsWith("peak_") && place.id.endsWith("_temperature")
          ? `peak_${engaging}_temperature`
          : place.id;
    if (!about) continue;
    const value = shown_.figures[name] ?? null,
      other = a[name] ?? null,
      words = (v) =>
        v === null ? (name === "lock_time" ? "does not lock" : "–") : shown(v, about.unit, false);
    place.value = value === null ? "" : String(value);
    place.textContent = words(value);
    const more =
      value !== null && other !== null && !sameAll(pinned.profiles, shown_.profiles)
        ? `, ${value >= other ? "+" : "−"}${shown(Math.abs(value - other), about.unit, true, 3)}`
        : "";
    byId(`a-${place.id}`).textContent =
      pinned.run && !sameAll(pinned.profiles, shown_.profiles) ? `A ${words(other)}${more}` : "";
  }
}

/** Return at most so many points of a line, minimum and maximum of each segment. */
function thinned(time, values, factor) {
  const n = time.length,
    found = [],
    by = Math.ceil((2 * n) / DRAWN);
  for (let i = 0; i < n; i += by) {
    let low = i,
      high = i;
    for (let k = i; k < Math.min(i + by, n); k += 1) {
      if (values[k] < values[low]) low = k;
      if (values[k] > values[high]) high = k;
    }
    for (const k of low === high ? [low] : low < high ? [low, high] : [high, low])
      found.push([time[k], factor * values[k]]);
  }
  found.push([time[n - 1], factor * values[n - 1]]);
  return found;
}

function drawViews() {
  const { time, signals, figures } = shown_,
    a = pinned.run && pinned.run !== shown_ && !sameAll(pinned.profiles, shown_.profiles) ? pinned.run : null;
  const span = { x: [ABOUT.start_time, ABOUT.stop_time] };
  for (const { plot, lines, band, unit } of views) {
    const own = lines.map(([name, signal, factor], i) => ({
      name,
      look: `b-${LOOKS[i]}`,
      points: thinned(time, signals[signal], factor),
    }));
    const before = a
      ? lines.map(([, signal, factor], i) => ({
          name: i ? "" : "A",
          look: `a-${LOOKS[i]}`,
          points: thinned(a.time, a.signals[signal], factor),
        }))
      : [];
    const bands = band && draws.bands ? bandOf(band, lines[0][2]) : [];
    plot.show({ series: [...before, ...own], bands, span });
    const ranges = lines.map(
      ([name, signal, factor]) =>
        `${name} ${shown(factor * Math.min(...signals[signal]), unit)} to ${shown(factor * Math.max(...signals[signal]), unit)}`,
    );
    plot.svg.setAttribute(
      "aria-label",
      `${plot.title} over time: ${ranges.join("; ")}; lock-up ${figures.lock_time === null ? "none" : shown(figures.lock_time, "s")}`,
    );
  }
}

const handlesOf = (names) =>
  names.flatMap((name, k) =>
    now[name].map(([t, x], i) => ({
      name,
      i,
      look: `b-${LOOKS[k]}`,
      x: t,
      y: x,
      label: `${KNOWN[name].text}, point ${i + 1} of ${now[name].length}`,
      text: `${shown(t, "s")}, ${shown(x, KNOWN[name].unit)}`,
    })),
  );

/** Return the line of a profile over the whole time: constant before and behind its points. */
const wholeLine = (points) =>
  [[ABOUT.start_time, points[0][1]], ...points, [ABOUT.stop_time, points.at(-1)[1]]].filter(
    ([t]) => t >= ABOUT.start_time && t <= ABOUT.stop_time,
  );

function drawEditor(editor) {
  const { plot, names } = editor,
    a = sameAll(pinned.profiles, now) ? [] : names;
  if (plot.held === null || plot.held === undefined || !editor.span) {
    const values = names.flatMap((name) => now[name].map(([, x]) => x)),
      high = Math.max(...values, 0),
      low = Math.min(...values, 0),
      pad = (high - low || 1) * 0.18;
    editor.span = { x: [ABOUT.start_time, ABOUT.stop_time], y: [low < 0 ? low - pad : 0, high + pad] };
  }
  const before = a.map((name, i) => ({
    name: i ? "" : "A",
    look: `a-${LOOKS[i]}`,
    points: wholeLine(pinned.profiles[name]),
  }));
  const own = names.map((name, i) => ({
    name: KNOWN[name].text,
    look: `b-${LOOKS[i]}`,
    points: wholeLine(now[name]),
  }));
  plot.show({
    series: [...before, ...own],
    handles: handlesOf(names).filter(({ x }) => x >= ABOUT.start_time && x <= ABOUT.stop_time),
    span: editor.span,
  });
}

function drawEditors() {
  byId("as-scene").textContent = sceneText(now);
  byId("as-command").textContent = `thrustwasher shift --scene ${ABOUT.name}-tuned.toml`;
  for (const editor of Object.values(editors)) {
    drawEditor(editor);
    editor.tables.forEach((table) => table.show());
  }
}

/** The points of a profile as fields, for numbers in full. */
class Points {
  constructor(host, name) {
    this.name = name;
    this.body = el("tbody");
    this.error = el("p", { class: "error", role: "alert", id: `error-${name}` });
    const add = el("button", { type: "button", onclick: () => this.add() }, "add a point"),
      { unit, text, fixed } = KNOWN[name];
    const head = el(
      "tr",
      {},
      ...["time [s]", `value [${pretty(unit)}]`, ""].map((words) => el("th", { scope: "col" }, words)),
    );
    host.append(
      el(
        "details",
        {},
        el("summary", {}, `${text}: points as numbers`),
        el(
          "div",
          {},
          el("table", { class: "points" }, el("thead", {}, head), this.body),
          this.error,
          fixed ? "" : add,
        ),
      ),
    );
  }

  show() {
    const points = now[this.name],
      { fixed } = KNOWN[this.name];
    if (this.body.rows.length !== points.length) {
      const field = (i, k) =>
        el("input", {
          "aria-label": `${KNOWN[this.name].text}, ${k ? "value" : "time"} of point ${i + 1}`,
          id: `${this.name}-${i + 1}-${k ? "value" : "time"}`,
          disabled: Boolean(k && fixed),
          onchange: () => this.take(),
        });
      this.body.replaceChildren(
        ...points.map((_, i) =>
          el(
            "tr",
            {},
            el("td", {}, field(i, 0)),
            el("td", {}, field(i, 1)),
            el(
              "td",
              {},
              fixed || points.length === 1
                ? ""
                : el(
                    "button",
                    {
                      type: "button",
                      "aria-label": `take point ${i + 1} away`,
                      onclick: () => this.set(points.filter((_p, k) => k !== i)),
                    },
                    "×",
                  ),
            ),
          ),
        ),
      );
    }
    [...this.body.rows].forEach((row, i) =>
      row.querySelectorAll("input").forEach((input, k) => {
        if (input !== document.activeElement || input.dataset.set === undefined)
          input.value = String(points[i][k]);
        input.removeAttribute("aria-invalid");
      }),
    );
    this.error.textContent = "";
  }

  take() {
    const { unit } = KNOWN[this.name],
      points = [];
    for (const row of this.body.rows) {
      const pair = [...row.querySelectorAll("input")].map((input, k) => ({
        input,
        ...readQuantity(input.value, { unit: k ? unit : "s", relative: false }),
      }));
      const bad = pair.find(({ value }) => !Number.isFinite(value));
      if (bad) return this.refuse(`${this.name}${bad.wrong}`, bad.input);
      points.push(pair.map(({ value }) => value));
    }
    const wrong = wrongWith(this.name, points);
    return wrong ? this.refuse(`${this.name}: ${wrong}`) : this.set(points);
  }

  /**
   * @param {string} words
   * @param {HTMLElement | null} input
   */
  refuse(words, input = null) {
    this.error.textContent = words;
    input?.setAttribute("aria-invalid", "true");
  }

  add() {
    const points = now[this.name];
    if (points.length >= ABOUT.most_points)
      return this.refuse(`${this.name}: ${points.length + 1} points, allowed: 1 .. ${ABOUT.most_points}`);
    const gaps = points.slice(1).map(([t], i) => t - points[i][0]),
      k = gaps.indexOf(Math.max(...gaps)),
      [one, other] = [points[k], points[k + 1]];
    const made = other
      ? [(one[0] + other[0]) / 2, (one[1] + other[1]) / 2].map((v) => Number(v.toPrecision(6)))
      : [points[0][0] + 0.1, points[0][1]];
    return this.set([...points.slice(0, other ? k + 1 : 1), made, ...points.slice(other ? k + 1 : 1)]);
  }

  set(points) {
    change(this.name, points);
  }
}

export function change(name, points) {
  strange = "";
  now = { ...now, [name]: points };
  drawEditors();
  wish();
}

// draws of the scatter

function followDraws() {
  const on = byId("scatter").checked;
  if (!on || draws.for === changes || !shown_ || shown_.problem) return;
  draws = {
    queue: ABOUT.scatter.rows.map((row, k) => [row, k]),
    found: [],
    for: changes,
    running: draws.running,
    bands: draws.bands,
  };
  byId("scatter-state").textContent = `Running ${ABOUT.scatter.draws} draws …`;
  if (!draws.running) nextDraw();
}

function nextDraw() {
  const one = draws.queue.shift(),
    which = draws.for;
  draws.running = Boolean(one);
  if (!one) return;
  const [draw] = one,
    done = (found) => {
      if (which === draws.for && which === changes) {
        draws.found.push(found);
        if (!draws.queue.length) showDraws();
      }
      nextDraw();
    };
  if (draw.problem) done({ problem: draw.problem });
  else
    quick.run(
      { profiles: now, washers: WASHERS.length ? "recorded" : "", draw, recorded: null },
      (result, problem) => {
        if (problem || !result) done({ problem: problem ?? "stopped" });
        else {
          const { time, signals } = result,
            by = Math.max(1, Math.floor(time.length / MOST_TIMES)),
            picked = (values) => values.filter((_, i) => i % by === 0);
          done({
            figures: result.figures,
            time: picked(time),
            signals: Object.fromEntries(
              VIEWS.flatMap(({ band }) => (band ? [[band, picked(signals[band])]] : [])),
            ),
          });
        }
      },
    );
}

function showDraws() {
  const sound = draws.found.filter((d) => !d.problem),
    names = ["lock_time", "slip_energy", "peak_jerk"];
  draws.bands = sound;
  const one = (name) => {
    const { unit } = ABOUT.figures[name],
      values = sound.map((d) => d.figures[name] ?? NaN),
      [low, middle, high] = quantiles(values).map((v) => shown(v, unit, false, 3));
    return `${name.replaceAll("_", " ")} ${low} .. ${high}, median ${middle}`;
  };
  const unlocked = sound.filter((d) => d.figures.lock_time === null).length,
    lost = draws.found.length - sound.length;
  byId("scatter-state").textContent =
    `5 to 95 % of ${draws.found.length} draws, the washers with the torque of the last full run: ${names
      .filter((n) => sound.some((d) => Number.isFinite(d.figures[n])))
      .map(one)
      .join("; ")}.${unlocked ? ` ${unlocked} do not lock.` : ""}${lost ? ` ${lost} cannot be run.` : ""}`;
  byId("scatter-state").dataset.done = String(draws.for);
  drawViews();
}

function bandOf(signal, factor) {
  const sound = draws.bands,
    stale = draws.for !== changes || draws.queue.length ? " stale" : "";
  if (sound.length < 2) return [];
  const rows = Array.from(sound[0].time, (t, i) => [
    t,
    ...quantiles(sound.map((d) => factor * d.signals[signal][i])),
  ]);
  return [
    {
      name: "5 to 95 % of the draws",
      look: `scatter-one${stale}`,
      points: rows.map(([t, low, , high]) => [t, low, high]),
    },
  ];
}

// the address

function keepAddress() {
  const pairs = [],
    usual = profilesOf();
  for (const name of Object.keys(KNOWN))
    if (!isSame(now[name], usual[name])) pairs.push(`${name}=${writtenProfile(now[name])}`);
  for (const name of Object.keys(KNOWN))
    if (!isSame(pinned.profiles[name], usual[name]))
      pairs.push(`a.${name}=${writtenProfile(pinned.profiles[name])}`);
  if (byId("scatter").checked) pairs.push("scatter=true");
  if (Units.mode !== "mixed") pairs.push(`units=${Units.mode}`);
  const text = pairs.length ? `#${pairs.join("&")}` : location.pathname + location.search;
  document.documentElement.dataset.settled = pairs.length ? text : "";
  if ((location.hash || "") !== (pairs.length ? text : "")) history.replaceState(null, "", text);
}

/** Take what the address names; what cannot be taken is told, all else stays as in the scene. */
function readAddress() {
  const wrong = [],
    given = profilesOf(),
    before = profilesOf();
  let scatter = false;
  const decoded = (text) => {
    try {
      return decodeURIComponent(text);
    } catch {
      return text;
    }
  };
  for (const word of location.hash.slice(1).split("&").filter(Boolean)) {
    const [key, text] = [decoded(word.split("=")[0]), decoded(word.split("=").slice(1).join("="))],
      name = key.replace(/^a\./, "");
    if (Object.hasOwn(KNOWN, name)) {
      const read = readProfile(name, text);
      if (read.wrong) wrong.push(read.wrong);
      else (key === name ? given : before)[name] = read.points;
    } else if (key === "units") {
      if (Units.wrong) wrong.push(Units.wrong);
    } else if (key === "scatter") {
      if (!["true", "false"].includes(text)) wrong.push(`scatter = ${text}, allowed: true or false`);
      else if (text === "true" && !ABOUT.scatter)
        wrong.push("scatter = true, allowed: false, since nothing scatters in this scene");
      else scatter = text === "true";
    } else
      wrong.push(
        `${key.slice(0, 40)} is nothing that this page knows, allowed: ${[...Object.keys(KNOWN), "scatter", "units"].join(", ")}`,
      );
  }
  strange = wrong.length ? `The address: ${wrong.join("; ")}. ` : "";
  byId("scatter").checked = scatter;
  now = given;
  pinned = { profiles: before, run: null };
  drawEditors();
  if (sameAll(before, now)) wish();
  else {
    changes += 1;
    quick.run({ profiles: before, washers: QUICK, recorded: null }, (result) => {
      if (result) pinned.run = { ...result, profiles: before, washers: QUICK };
      wish();
    });
  }
}

function built() {
  const host = byId("editor"),
    right = byId("views");
  for (const [title, all] of EDITORS) {
    const names = all.filter((name) => name in KNOWN);
    if (!names.length) continue;
    const section = el("section", { class: "panel" }),
      { unit } = KNOWN[names[0]];
    host.append(section);
    /** @type {any} */
    const editor = (editors[title] = { names });
    editor.plot = new Plot(section, {
      title,
      x: { label: "time", unit: "s" },
      y: {
        label: title
          .split(" ")
          .slice(unit === "Pa" ? 0 : -1)[0]
          .toLowerCase(),
        unit,
      },
      height: unit === "1" ? 180 : 250,
      drag: (t, x, k) => {
        const handle = editor.plot.handles[k];
        if (!handle) return;
        const { name, i } = handle,
          made = movedPoint(name, now[name], i, t, Math.min(Math.max(x, editor.span.y[0]), editor.span.y[1]));
        if (made[0] !== now[name][i][0] || made[1] !== now[name][i][1])
          change(
            name,
            now[name].map((p, k2) => (k2 === i ? made : p)),
          );
      },
    });
    for (const kind of ["pointerup", "pointercancel"])
      editor.plot.svg.addEventListener(kind, () => setTimeout(() => drawEditor(editor)));
    editor.tables = names.map((name) => new Points(section, name));
  }
  if (!host.children.length)
    host.append(el("p", {}, "This scene has no profile over time: its engine torque is constant."));
  right.append(byId("warnings"));
  for (const view of VIEWS) {
    const section = el("section", { class: "panel" });
    right.append(section);
    views.push({
      ...view,
      plot: Object.assign(
        new Plot(section, {
          title: view.title,
          x: { label: "time", unit: "s" },
          y: { label: view.label, unit: view.unit },
          height: 220,
        }),
        { title: view.title },
      ),
    });
  }
  byId("pin").addEventListener("click", () => {
    if (!shown_) return;
    pinned = { profiles: structuredClone(shown_.profiles), run: shown_ };
    showFigures();
    drawEditors();
    drawViews();
    keepAddress();
  });
  byId("swap").addEventListener("click", () => {
    const other = pinned.profiles;
    pinned = { profiles: now, run: shown_ };
    now = structuredClone(other);
    drawEditors();
    wish();
  });
  byId("reset").addEventListener("click", () => {
    now = profilesOf();
    strange = "";
    drawEditors();
    wish();
  });
  byId("save").addEventListener("click", () => {
    const link = el("a", {
      href: URL.createObjectURL(new Blob([sceneText(now)], { type: "application/toml" })),
      download: `${ABOUT.name}-tuned.toml`,
    });
    link.click();
    say(
      `Saved as ${ABOUT.name}-tuned.toml; run it with: thrustwasher shift --scene ${ABOUT.name}-tuned.toml`,
    );
  });
  every(".tools")[0].append(Units.choice());
  const scatter = byId("scatter"),
    sources = ABOUT.scatter?.sources ?? [];
  scatter.disabled = !ABOUT.scatter;
  scatter.addEventListener("change", () => {
    draws = { queue: [], found: [], for: -1, running: draws.running, bands: null };
    byId("scatter-state").textContent = "";
    drawViews();
    settled();
  });
  byId("sources").append(
    ABOUT.scatter
      ? el(
          "table",
          {},
          el(
            "thead",
            {},
            el("tr", {}, ...["name", "law", "from"].map((text) => el("th", { scope: "col" }, text))),
          ),
          el(
            "tbody",
            {},
            ...sources.map(({ name, law, reason }) =>
              el(
                "tr",
                {},
                el("th", { scope: "row" }, el("code", {}, name)),
                el("td", {}, law),
                el("td", {}, reason || "given"),
              ),
            ),
          ),
        )
      : el("p", {}, "This scene has no [scatter]."),
  );
  for (const button of every("button[data-copy]")) {
    button.addEventListener("click", () => {
      getSelection()?.selectAllChildren(byId(button.dataset.copy));
      navigator.clipboard?.writeText(byId(button.dataset.copy).textContent).catch(() => {});
    });
  }
}

let MODULES = null,
  DATA = null;

async function begin() {
  const still = byId("state").textContent;
  try {
    const each = every("script.module").map(async (place) => [
      place.dataset.model,
      new Uint8Array(await inflated(place.textContent)),
    ]);
    MODULES = Object.fromEntries(await Promise.all(each));
    DATA = { ...ABOUT, tables: {}, recorded: {} };
    for (const [name, { map, recorded: own }] of Object.entries(ABOUT.washers)) {
      if (map) DATA.tables[name] = [map.at, new Float64Array(await inflated(map.table))];
      DATA.recorded[name] = { rows: new Float64Array(await inflated(own.rows)), moving: own.moving };
    }
    quick = new Runner(MODULES, DATA);
    await quick.ready;
  } catch (problem) {
    say(
      `This browser cannot run the kernels: ${/** @type {Error} */ (problem).message}. ${still}`,
      "problem",
    );
    return;
  }
  built();
  for (const part of every(".live")) part.hidden = false;
  readAddress();
  addEventListener(
    "hashchange",
    () => location.hash === (document.documentElement.dataset.settled ?? "") || readAddress(),
  );
}

if (
  typeof WebAssembly === "object" &&
  typeof Worker === "function" &&
  typeof DecompressionStream === "function"
)
  begin();
else
  say(`This browser has no WebAssembly, in which the kernels run. ${byId("state").textContent}`, "problem");

export { now };
