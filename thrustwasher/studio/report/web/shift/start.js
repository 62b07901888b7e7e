/* Fill the page's places; where a browser cannot, the still version stays. */

import { byId } from "../draw.js";
import { state } from "./cursor.js";
import * as Runs from "./decode.js";
import * as Discs from "./discs.js";
import * as Exports from "./exports.js";
import * as Flow from "./flow.js";
import * as Live from "./live.js";
import { Figures } from "./page_parts.js";
import * as Plots from "./plots.js";
import * as Slip from "./slip.js";

export { state, moveTo, zoom, nearest } from "./cursor.js";

async function start() {
  const data = JSON.parse(byId("data").textContent);
  const found = await Runs.all(data.runs);
  document.documentElement.classList.add("js"); // before plots ask how wide they are
  try {
    Plots.show(data, found, byId("plots"), byId("hero"));
    Figures.show(data.runs[0].figures);
    if (byId("copy-figures")) Exports.ofFigures(byId("copy-figures"));
    if (byId("flow")) Flow.start(data, state, byId("flow"));
    if (byId("slip")) Slip.start(state, byId("slip"));
    Live.start(data.washer);
    if (byId("discs")) Discs.start(data, state, byId("discs"));
  } catch (problem) {
    document.documentElement.classList.remove("js");
    throw problem;
  }
}

start();
