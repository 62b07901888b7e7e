/* The chart's page: what is behind each mark and each cell, by pointer or from the keyboard. */
"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const NEAR = 14; // pixels from a mark
  const tip = make("div", "tip");
  tip.hidden = true;
  tip.setAttribute("role", "tooltip");
  document.body.append(tip);

  function make(tag, kind, ...children) {
    const node = Object.assign(document.createElement(tag), { className: kind });
    node.append(...children);
    return node;
  }

  function tell(lines, box) {
    tip.replaceChildren(...lines.map((line) => make("div", "", line)));
    tip.hidden = false;
    const wide = document.documentElement.clientWidth;
    tip.style.left = `${window.scrollX + Math.max(8, Math.min(box.right + 10, wide - tip.offsetWidth - 8))}px`;
    tip.style.top = `${window.scrollY + box.bottom + 8}px`;
  }

  const quiet = () => { tip.hidden = true; };

  /* The marks of a drawing with their words; one of them is a stop of the Tab key, arrows go on from it. */
  function marksOf(plot, points) {
    const marks = Object.entries(points).flatMap(([id, all]) => {
      const drawn = document.getElementById(`${plot.id}-${id}`)?.querySelectorAll("use") ?? [];
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
      let best, least = NEAR;
      for (const one of marks) {
        const box = one.mark.getBoundingClientRect();
        const far = Math.hypot(box.x + 0.5 * box.width - e.clientX, box.y + 0.5 * box.height - e.clientY);
        if (far < least) [best, least] = [{ ...one, box }, far];
      }
      if (best) tell(best.words, best.box); else quiet();
    });
    plot.addEventListener("pointerleave", quiet);
  }

  /* The map of where methods fail: a button for each cell, with its words. */
  function mapOf(group) {
    const heads = group.hazards.map((hazard) => headOf(hazard, "col"));
    const rows = group.methods.map((method, i) => make("tr", "", headOf(method, "row"),
      ...group.cells[i].map((cell, j) => make("td", "", cellOf(cell, method, group.hazards[j])))));
    const table = make("table", "", make("caption", "", `${group.name} (wrong: ${group.judged})`),
      make("thead", "", make("tr", "", make("td", ""), ...heads)), make("tbody", "", ...rows));
    return make("div", "map", table);
  }

  function headOf(words, scope) {
    return Object.assign(make("th", "", words), { scope });
  }

  function cellOf(cell, method, hazard) {
    const button = make("button", cell.verdict === "-" ? "none" : cell.verdict, `${cell.verdict} ${cell.figure}`.trim());
    const words = [`${method}, ${hazard}`, data.verdicts[cell.verdict] ?? "does not apply", cell.figure, cell.words]
      .filter((line) => line);
    button.type = "button";
    button.setAttribute("aria-description", words.join("; "));
    for (const what of ["focus", "click", "pointerenter"]) {
      button.addEventListener(what, () => tell(words, button.getBoundingClientRect()));
    }
    for (const what of ["blur", "pointerleave"]) button.addEventListener(what, quiet);
    return button;
  }

  for (const [file, points] of Object.entries(data.points)) {
    const plot = document.getElementById(file);
    if (plot) watch(plot, marksOf(plot, points));
  }
  const map = document.getElementById("map");
  if (map) {
    const key = Object.entries(data.verdicts).map(([verdict, words]) =>
      make("li", "", make("span", verdict, verdict), ` ${words}`));
    map.append(make("ul", "key", ...key), ...data.stability.map(mapOf));
  }
  addEventListener("keydown", (e) => { if (e.key === "Escape") quiet(); });
  document.documentElement.classList.add("js");
})();
