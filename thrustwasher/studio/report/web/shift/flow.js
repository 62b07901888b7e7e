/* The energy balance as flows, from the start to the cursor: what came in, what it became, where heat went. */

import { el } from "../draw.js";
import { NAMES, moveTo } from "./cursor.js";
import { number } from "./page_parts.js";

const TALL = 300,
  BAR = 12;
const GAP = 22; // between flows: room for their words
const LEAST = 1e-4; // of the whole: a flow below it is not drawn
// Where bars stand; the last flows begin at the last one and are so long. Where the page is narrow, and on paper, flows
// have numbers and the words stand below.
const LAYOUTS = {
  wide: { width: 1120, columns: [230, 420, 620, 860], length: 80 },
  compact: { width: 520, columns: [40, 170, 310, 390], length: 80 },
};

function joule(value) {
  return Math.abs(value) >= 1000 ? `${(value / 1000).toPrecision(4)} kJ` : `${value.toPrecision(3)} J`;
}

/* What a flow is called; against its usual direction it is called the opposite. */
function words(signal, turned) {
  const plain = signal.help.split(" since the start")[0];
  return turned
    ? plain.replace("gained", "given up").replace("into", "from").replace("work of", "work into")
    : plain;
}

/* What came in and what went out up to a point, largest in the order of the list. */
function balance(run, flows, index) {
  const sources = [],
    sinks = [];
  for (const flow of flows) {
    const signal = run.signals.get(flow.signal);
    const value = signal ? signal.values[index] : 0;
    if (!value) continue;
    const comes = value > 0 === Boolean(flow.comes);
    const kept = comes || !flow.kept ? undefined : run.signals.get(flow.kept)?.values[index];
    const name = words(signal, value < 0);
    (comes ? sources : sinks).push({
      name,
      size: Math.abs(value),
      colour: flow.colour,
      kept,
      heat: flow.heat,
    });
  }
  const whole = Math.max(...[sources, sinks].map((side) => side.reduce((sum, one) => sum + one.size, 0)), 0);
  return { whole, sides: [sources, sinks].map((side) => side.filter((one) => one.size > LEAST * whole)) };
}

function ribbon(from, to, top, end, thick, colour, title) {
  const middle = 0.5 * (from + to);
  const d =
    `M${from},${top} C${middle},${top} ${middle},${end} ${to},${end} L${to},${end + thick} ` +
    `C${middle},${end + thick} ${middle},${top + thick} ${from},${top + thick} Z`;
  return el("path", { d, fill: `var(--${colour})`, "fill-opacity": 0.42 }, el("title", {}, title));
}

function bar(x, y, thick, colour) {
  return el("rect", { x, y, width: BAR, height: Math.max(thick, 1), fill: `var(--${colour})` });
}

function pictures(run, flows, index) {
  const key = el("ol", { class: "flow-key" });
  return [picture(run, flows, index, "wide"), picture(run, flows, index, "compact", key), key];
}

function picture(run, flows, index, name, key = null) {
  const { whole, sides } = balance(run, flows, index),
    layout = { ...LAYOUTS[name], key };
  const svg = el("svg", {
    class: `flow ${name}`,
    viewBox: `0 0 ${layout.width} ${TALL + 4 * GAP}`,
    role: "img",
  });
  if (!whole) {
    svg.setAttribute("aria-label", "No energy has flowed yet");
    svg.append(el("text", { x: 20, y: 40 }, "No energy has flowed yet."));
    return svg;
  }
  const scale = (TALL - GAP * Math.max(...sides.map((side) => side.length - 1))) / whole;
  const hub = { y: 40, height: whole * scale };
  svg.append(
    bar(layout.columns[1], hub.y, hub.height, "soft"),
    el("text", { x: layout.columns[1] - 10, y: hub.y - 12 }, "driveline"),
  );
  const ends = sides.map((side, k) => column(svg, side, k === 0, hub, scale, whole, layout));
  svg.setAttribute("aria-label", `Energy: ${ends[0]} became ${ends[1]}`);
  return svg;
}

/* Return what stands at a flow: its words, or a number whose words go into the key. */
function named(text, { key }) {
  if (!key) return text;
  key.append(el("li", {}, text));
  return String(key.children.length);
}

function column(svg, side, left, hub, scale, whole, layout) {
  let own = 30,
    middle = hub.y;
  const hot = [];
  for (const flow of side) {
    const thick = flow.size * scale;
    const share = `${((100 * flow.size) / whole).toPrecision(3)} %`;
    const title = `${flow.name}: ${joule(flow.size)}, ${share}`;
    const { columns } = layout,
      x = columns[left ? 0 : 2];
    svg.append(
      left
        ? ribbon(x + BAR, columns[1], own, middle, thick, flow.colour, title)
        : ribbon(columns[1] + BAR, x, middle, own, thick, flow.colour, title),
      bar(x, own, thick, flow.colour),
    );
    const at = own + 0.5 * thick;
    const place = left ? { x: x - 8, "text-anchor": "end" } : { x: x + BAR + 8 };
    const text = `${layout.key ? flow.name : short(flow.name)} ${joule(flow.size)}`;
    svg.append(el("text", { ...place, y: at + 5 }, named(text, layout)));
    if (!left && (flow.kept !== undefined || flow.heat)) hot.push({ ...flow, top: own, thick });
    own += thick + GAP;
    middle += thick;
  }
  if (hot.length) heats(svg, hot, scale, layout);
  return side.map((flow) => `${flow.name} ${joule(flow.size)}`).join(", ");
}

/* The last column: what plates hold, and what the oil has. */
function heats(svg, hot, scale, layout) {
  /** @type {[string, string, (flow: any) => number][]} */
  const parts = [
    ["steel plates", "orange", (f) => Math.max(0, Math.min(f.size, f.kept ?? 0))],
    ["oil", "sky", (f) => f.size - Math.max(0, Math.min(f.size, f.kept ?? 0))],
  ];
  const begin = layout.columns[3],
    end = begin + layout.length;
  let own = hot[0].top;
  for (const flow of hot) flow.from = flow.top;
  for (const [name, colour, sizeOf] of parts) {
    const sum = hot.reduce((total, flow) => total + sizeOf(flow), 0);
    if (sum * scale < 0.3) continue;
    svg.append(bar(end, own, sum * scale, colour));
    const at = own + 0.5 * sum * scale;
    const text = named(`${name} ${joule(sum)}`, layout);
    svg.append(el("text", { x: end + BAR + 8, y: at + 5 }, text));
    for (const flow of hot) {
      const thick = sizeOf(flow) * scale;
      svg.append(
        ribbon(
          begin,
          end,
          flow.from,
          own,
          thick,
          flow.colour,
          `${flow.name} to ${name}: ${joule(sizeOf(flow))}`,
        ),
      );
      flow.from += thick;
      own += thick;
    }
    own += GAP;
  }
}

function short(name) {
  return name.length > 27 ? `${name.slice(0, 26)}…` : name;
}

export function start(data, state, place) {
  const now = el("p", { class: "small" });
  const host = el("div", {
    class: "flows",
    tabindex: 0,
    role: "group",
    "aria-label": "flow of energy",
  });
  const last = state.time.length - 1;
  let shown = -1;
  const end = el("button", { type: "button", onclick: () => moveTo(last) }, "to the end of the run");
  place.append(now, host, el("p", { class: "choose" }, end));
  state.listeners.push(() => {
    const index = state.index || last; // before the cursor was moved: the whole run
    if (index === shown) return;
    shown = index;
    now.textContent = `From the start to ${state.time[index].toPrecision(4)} s${index === last ? ", the end" : ", the cursor"}.`;
    host.replaceChildren(
      ...state.runs.flatMap((run, k) => [
        ...(state.runs.length > 1
          ? [
              el(
                "h3",
                {},
                `${NAMES[k]}: ${run.title}` +
                  (index > run.end ? `, which ended at ${number(state.time[run.end])} s` : ""),
              ),
            ]
          : []),
        ...pictures(run, data.flow, Math.min(index, run.end)),
      ]),
    );
  });
}
