"""The pages as a reader meets them: size, time to write, to open, to follow what is moved.

``python -m lab.benchmarks.pages [--step "0.13 ms"]`` runs the default scene, by this step 10 000 of
them, and drives its report and the pages to explore in Chromium. With ``--pictures docs/images``
it only writes the documentation's pictures of them.
"""

import argparse
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from playwright.sync_api import Browser, Page, sync_playwright

MODELS = ("washer", "gearmesh", "clutch")
RUNS, FRAMES, UPDATES = 5, 120, 200
SIZE = {"width": 1200, "height": 900}
# There is something to explore.
REPORT, EXPLORE, SCENE = "#now:not(:empty)", "html[data-settled]", "html[data-run]"
# The time from one painted frame to the next while something moves in each.
PACE = """async ([what, frames]) => {
  const { time } = page.state;
  const [first, last] = [time[0], time[time.length - 1]];
  const act = {
    cursor: (k) => page.moveTo(Math.floor((time.length - 1) * k)),
    zoom: (k) => page.zoom(first, last - 0.8 * k * (last - first)),
  }[what];
  const taken = [];
  let before = performance.now();
  for (let k = 0; k < frames; k++) {
    act(k / frames);
    await new Promise(requestAnimationFrame);
    const now = performance.now();
    taken.push(now - before);
    before = now;
  }
  return taken;
}"""
# The time from the question of the page to the worker's answer, the point moved a little each time.
UPDATE = """async ([task, updates]) => {
  const taken = [];
  const point = page.ABOUT.inputs.map((s) => s.value);
  for (let k = 0; k < updates; k++) {
    const moved = [point[0] * (1 + 1e-3 * k), ...point.slice(1)];
    const { extra } = page.state;
    const given = task === "solve" ? { point: moved, fresh: false, branch: "", extra }
      : { given: [moved, 20, 3000] };
    const began = performance.now();
    await new Promise((done) => page.ask(task, given, done));
    taken.push(performance.now() - began);
  }
  return taken;
}"""

# Other fill and kiss of the clutch than the scene's.
TUNED = """() => page.change("clutch_pressure", [[0.1, 0], [0.11, 6e4], [0.2, 6e4], [0.4, 3.45e5],
  [0.7, 2.8e5], [0.86, 3.7e5], [1.2, 7.2e5]])"""

# Height of the page, where its first picture begins, its words.
LAID_OUT = """() => [document.documentElement.scrollHeight,
  document.querySelector("#hero canvas").getBoundingClientRect().top + scrollY,
  document.body.innerText.split(/\\s+/).length]"""

# The time from switching the scatter on to all of its draws.
SCATTER = """async () => {
  const began = performance.now();
  document.getElementById("scatter").click();
  while (!document.documentElement.dataset.scattered) await new Promise((go) => setTimeout(go, 2));
  return performance.now() - began;
}"""


# The time of each run and of each redraw while the kiss point is dragged for some seconds.
DRAG = """async ([seconds]) => {
  const taken = [], drawn = [], { plot } = Object.values(page.editors)[0];
  const start = page.now.clutch_pressure[2][1];
  const root = document.documentElement, moved = new MutationObserver(() => {
    taken.push(Number(root.dataset.took));
    drawn.push(performance.now());
  });
  moved.observe(root, { attributes: true, attributeFilter: ["data-run"] });
  const began = performance.now();
  plot.held = 2;
  for (let k = 0; performance.now() - began < 1e3 * seconds; k += 1) {
    plot.drag(page.now.clutch_pressure[2][0], start + 2e4 + 1e3 * (k % 20), 2);
    await new Promise(requestAnimationFrame);
  }
  plot.held = null;
  moved.disconnect();
  return [taken, drawn.length / seconds];
}"""


def called(*words: str) -> float:
    """Return the seconds of wall clock of a whole command."""
    began = time.perf_counter()
    subprocess.run([sys.executable, "-m", "thrustwasher", *words], check=True, capture_output=True)
    return time.perf_counter() - began


def opened(browser: Browser, path: Path, ready: str) -> tuple[Page, float]:
    """Return a page and the seconds until it can be explored."""
    page = browser.new_page(viewport=SIZE)
    began = time.perf_counter()
    page.goto(path.as_uri())
    page.wait_for_selector(ready, state="attached")
    return page, time.perf_counter() - began


def settled(browser: Browser, path: Path, ready: str) -> tuple[Page, float]:
    """Return a page and the seconds it takes to open, the median of several."""
    taken = []
    for k in range(RUNS):
        page, seconds = opened(browser, path, ready)
        taken.append(seconds)
        if k < RUNS - 1:
            page.close()
    return page, statistics.median(taken)


def measure_report(browser: Browser, folder: Path, step: str) -> None:
    words = ["shift", "--out", str(folder), *(["--step", step] if step else [])]
    taken = [called(*words) for _ in range(RUNS + 1)][1:]
    report = folder / "report.html"
    print(
        f"report: written in {statistics.median(taken):.2f} s (minimum {min(taken):.2f} s) with "
        f"its run, {report.stat().st_size / 1e6:.2f} MB"
    )
    page, seconds = settled(browser, report, REPORT)
    print(f"  open and interactive after {seconds:.2f} s")
    page.evaluate("() => document.getElementById('plots').scrollIntoView()")
    page.wait_for_selector(".u-over")
    print(f"  {page.evaluate('page.state.time.length')} points")
    page.set_viewport_size({"width": 1300, "height": 900})
    page.evaluate("() => document.getElementById('discs')?.scrollIntoView()")
    page.wait_for_timeout(1500)
    page.evaluate("scrollTo(0, 0)")
    high, first, words = page.evaluate(LAID_OUT)
    paper = re.findall(rb"/Type\s*/Page[^s]", page.pdf(format="A4"))
    print(
        f"  {high} px high at 1300 px, the first picture at {first:.0f} px, {words} words, "
        f"{len(paper)} printed pages"
    )
    page.evaluate("() => document.getElementById('plots').scrollIntoView()")
    for what in ("cursor", "zoom"):
        pace = sorted(page.evaluate(PACE, [what, FRAMES]))
        print(
            f"  {what}: {1e3 / statistics.median(pace):.0f} frames a second, "
            f"{1e3 / pace[int(0.95 * FRAMES)]:.0f} in the slowest twentieth"
        )


def measure_explore(browser: Browser, folder: Path, model: str) -> None:
    path = folder / f"{model}.html"
    called("explore", model, "--out", str(path))
    page, seconds = settled(browser, path, EXPLORE)
    page.wait_for_timeout(1000)  # until its curves are drawn
    print(
        f"{model}: {path.stat().st_size / 1e6:.2f} MB, first result {seconds:.2f} s after opening"
    )
    taken = sorted(page.evaluate(UPDATE, ["solve", UPDATES]))
    print(
        f"  an update takes {statistics.median(taken):.2f} ms, one of twenty over "
        f"{taken[int(0.95 * UPDATES)]:.2f} ms"
    )
    if model == "washer":
        curves = page.evaluate(UPDATE, ["curve", RUNS])
        print(f"  its load curve {statistics.median(curves) / 1e3:.2f} s")
    page.close()
    print(f"  its scatter {scatter_time(browser, path):.2f} s")


def measure_scene(browser: Browser, folder: Path, scene: str) -> None:
    path = folder / f"{scene}.html"
    seconds = called("explore", scene, "--out", str(path))
    page, first = settled(browser, path, SCENE)
    print(
        f"{scene}: {path.stat().st_size / 1e6:.2f} MB, written in {seconds:.1f} s, first run "
        f"{first:.2f} s after opening"
    )
    page.wait_for_selector("#washer_level[value=field]", state="attached")
    words = page.text_content("#state")
    taken, redraws = page.evaluate(DRAG, [5.0])
    print(
        f"  dragged: a run takes {statistics.median(taken):.1f} ms, at most {max(taken):.1f} ms; "
        f"{redraws:.0f} redraws a second"
    )
    print(f"  then: {words}")
    page.close()


def scatter_time(browser: Browser, path: Path) -> float:
    """Return the seconds that the draws of the scatter take on a page just opened, the median."""
    taken = []
    for _ in range(RUNS):
        page, _ = opened(browser, path, EXPLORE)
        page.wait_for_timeout(1000)
        taken.append(page.evaluate(SCATTER) / 1e3)
        page.close()
    return statistics.median(taken)


def draw(browser: Browser, folder: Path, images: Path) -> None:
    """Write the documentation's pictures."""
    called("shift", "--out", str(folder / "report"))
    shutil.copy(folder / "report" / "overview.png", images / "shift.png")
    page, _ = opened(browser, folder / "report" / "report.html", REPORT)
    page.wait_for_selector("#hero .u-over")
    page.evaluate("page.moveTo(Math.floor(0.4 * page.state.time.length))")
    page.wait_for_timeout(500)
    page.screenshot(path=images / "report.png")
    path = folder / "washer.html"
    called("explore", "washer", "--out", str(path))
    page, _ = opened(browser, path, EXPLORE)
    page.wait_for_timeout(1500)
    page.screenshot(path=images / "explore.png")
    path = folder / "scene.html"
    called("explore", "planetary", "--out", str(path))
    page, _ = opened(browser, path, SCENE)
    page.evaluate(TUNED)
    page.wait_for_timeout(4000)
    page.screenshot(path=images / "explore-shift.png")


def main() -> None:
    """Measure and print, or draw."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--step", default="", help="communication step, if not the scene's")
    parser.add_argument("--pictures", metavar="FOLDER", type=Path, help="write pictures there")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name, sync_playwright() as play:
        path = shutil.which("chromium")
        browser = play.chromium.launch(executable_path=path, args=["--no-sandbox"])
        folder = Path(name) / "pages"
        folder.mkdir()
        if given.pictures:
            draw(browser, folder, given.pictures)
        else:
            for model in MODELS:
                measure_explore(browser, folder, model)
            measure_scene(browser, folder, "planetary")
            measure_report(browser, Path(name) / "report", given.step)
        browser.close()


if __name__ == "__main__":
    main()
