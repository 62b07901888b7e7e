/* Fill the page's places; where a browser cannot, the still version stays. */
"use strict";
(async () => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const found = await Runs.all(data.runs);
  const place = (id) => document.getElementById(id);
  document.documentElement.classList.add("js"); // before plots ask how wide they are
  try {
    Plots.show(data, found, place("plots"), place("hero"));
    Figures.show(data.runs[0].figures);
    if (place("copy-figures")) Exports.ofFigures(place("copy-figures"));
    if (place("flow")) Flow.start(data, Plots.state, place("flow"));
    if (place("slip")) Slip.start(Plots.state, place("slip"));
    Live.start(data.washer);
    if (place("discs")) Discs.start(data, Plots.state, place("discs"));
  } catch (problem) {
    document.documentElement.classList.remove("js");
    throw problem;
  }
})();
