/* What all pages share: folded tables are open on paper, and there the colours are those of light. */
"use strict";
(() => {
  const root = document.documentElement;
  let folded = [];
  addEventListener("beforeprint", () => {
    folded = [...document.querySelectorAll("details:not([open])")].filter((d) => !d.dataset.stays);
    for (const one of folded) one.open = true;
    root.classList.add("printed");
  });
  addEventListener("afterprint", () => {
    for (const one of folded) one.open = false;
    root.classList.remove("printed");
  });
})();
