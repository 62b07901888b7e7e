/* The chart's page: what is behind each mark and each cell, by pointer or from the keyboard. */

import { byId, el } from "../draw.js";

const data = JSON.parse(byId("data").textContent);
const NEAR = 14; // pixels from a mark
const tip = el("div", { class: "tip", role: "tooltip", hidden: true });
document.body.append(tip);

function tell(lines, box) {
  tip.replaceChildren(...lines.map((line) => el("div", {}, line)));
  tip.hidden = false;
  const wide = document.documentElement.clientWidth;
  tip.style.left = `${window.scrollX + Math.max(8, Math.min(box.right + 10, wide - tip.offsetWidth - 8))}px`;
  tip.style.top = `${window.scrollY + box.bottom + 8}px`;
}

const quiet = () => {
  tip.hidden = true;
};

/* The marks of a drawing with their words; one of them is a stop of the Tab key, arrows go on from it. */
function marksOf(plot, points) {
  const marks = Object.entries(points).flatMap(([id, all]) => {
    const drawn = byId(`${plot.id}-${id}`)?.querySelectorAll("use") ?? [];
    return [...drawn].slice(0, all.length).map((mark, i) => ({ mark, words: all[i] }));
  });
  marks.forEach(({ mark, words }, i) => {
    mark.setAttribute("tabindex", i ? -1 : 0);
    mark.setAttribute("role", "img");
    mark.setAttribute("aria-label", words.join("; "));
    mark.addEventListener("focus", () => tell(words, mark.getBoundingClientRect()));
    mark.addEventListener("blur", quiet);
    mark.addEventListener("keydown", (e) => {
      const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[e.key];
      if (!step) return;
      e.preventDefault();
      const next = marks[(i + step + marks.length) % marks.length].mark;
      mark.setAttribute("tabindex", -1);
      next.setAttribute("tabindex", 0);
      next.focus();
    });
  });
  return marks;
}

function watch(plot, marks) {
  if (!marks.length) return;
  plot.addEventListener("pointermove", (e) => {
    let best,
      least = NEAR;
    for (const one of marks) {
      const box = one.mark.getBoundingClientRect();
      const far = Math.hypot(box.x + 0.5 * box.width - e.clientX, box.y + 0.5 * box.height - e.clientY);
      if (far < least) [best, least] = [{ ...one, box }, far];
    }
    if (best) tell(best.words, best.box);
    else quiet();
  });
  plot.addEventListener("pointerleave", quiet);
}

/* The map of where methods fail: a button for each cell, with its words. */
function mapOf(group) {
  const head = (scope) => (words) => el("th", { scope }, words);
  const rows = group.methods.map((method, i) =>
    el(
      "tr",
      {},
      head("row")(method),
      ...group.cells[i].map((cell, j) => el("td", {}, cellOf(cell, method, group.hazards[j]))),
    ),
  );
  return el(
    "div",
    { class: "map" },
    el(
      "table",
      {},
      el("caption", {}, `${group.name} (wrong: ${group.judged})`),
      el("thead", {}, el("tr", {}, el("td"), ...group.hazards.map(head("col")))),
      el("tbody", {}, ...rows),
    ),
  );
}

function cellOf(cell, method, hazard) {
  const words = [
    `${method}, ${hazard}`,
    data.verdicts[cell.verdict] ?? "does not apply",
    cell.figure,
    cell.words,
  ].filter((line) => line);
  const show = (event) => tell(words, event.currentTarget.getBoundingClientRect());
  return el(
    "button",
    {
      type: "button",
      class: cell.verdict === "-" ? "none" : cell.verdict,
      "aria-description": words.join("; "),
      onfocus: show,
      onclick: show,
      onpointerenter: show,
      onblur: quiet,
      onpointerleave: quiet,
    },
    `${cell.verdict} ${cell.figure}`.trim(),
  );
}

for (const [file, points] of Object.entries(data.points)) {
  const plot = byId(file);
  if (plot) watch(plot, marksOf(plot, points));
}
const map = byId("map");
if (map) {
  const key = Object.entries(data.verdicts).map(([verdict, words]) =>
    el("li", {}, el("span", { class: verdict }, verdict), ` ${words}`),
  );
  map.append(el("ul", { class: "key" }, ...key), ...data.stability.map(mapOf));
}
addEventListener("keydown", (e) => {
  if (e.key === "Escape") quiet();
});
document.documentElement.classList.add("js");
