"""Bands of a scene by the study's shortcut against plain full runs.

    nice python -m lab.benchmarks.scatter_scene plain plain.npz  1024 independent draws, full runs
    python -m lab.benchmarks.scatter_scene compare plain.npz     a study, figure against figure
    python -m lab.benchmarks.scatter_scene paired plain.npz      the shortcut at some of these draws
    python -m lab.benchmarks.scatter_scene bands thrustwasher/shift/scene/known_bands.toml
                                                                what a page shows without a study

``plain`` takes some twenty minutes of one core and keeps what it has after every batch: the same
command goes on. All parts of the default scene run at their level ``field``; the washers of full
runs are solved in every step.
"""

import argparse
import time
from pathlib import Path
from typing import Any

import numpy as np

from thrustwasher.processes import runner, usable_cores
from thrustwasher.shift import load_scene
from thrustwasher.shift.scene.places import scene_scatter
from thrustwasher.studio.evaluators.scene import scene_evaluator
from thrustwasher.studio.scatter.propagate import propagate
from thrustwasher.studio.scatter.target import Target, target_of

LEVELS = (0.05, 0.5, 0.95)
BATCH = 16
TOLD = (  # on the first page of a report without a study, and in docs/uncertainty.md
    *("lock_after_ramp_start", "slip_energy", "slip_energy_per_area", "peak_jerk", "torque_hole"),
    *("peak_clutch_temperature", "peak_clutch_heat_flux", "friction_lock", "lock_speed"),
    *("washer_torque", "washer_film_ratio", "minimum_washer_film_ratio"),
    *("peak_washer_temperature_max", "peak_flash_temperature", "minimum_scuffing_safety"),
)


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=("plain", "compare", "paired", "bands"))
    parser.add_argument("file", type=Path)
    parser.add_argument("--scene", default="planetary")
    parser.add_argument("--runs", type=int, default=1024, help="plain full runs")
    parser.add_argument("--base", type=int, default=256, help="base points of the study")
    parser.add_argument("--indices", action="store_true", help="of the study, for its time")
    parser.add_argument("--workers", type=int, default=usable_cores())
    given = parser.parse_args()
    if given.what == "plain":
        plain(given.scene, given.file, given.runs, given.workers)
    elif given.what == "bands":
        given.file.write_text(bands(given.scene, given.base, given.workers), "utf-8")
    elif given.what == "paired":
        paired(given.scene, given.file, given.base)
    else:
        compare(given.scene, given.file, given.base, given.workers, given.indices)


def bands(name: str, base: int, workers: int) -> str:
    """Return the table of a scene's bands: of each figure nominal value and quantiles."""
    found = propagate(load_scene(name), runs=base, workers=workers, indices=False)
    lines = [
        "# Figures of built-in scenes by their own [scatter], SI units: nominal value, then 5, 50",
        f"# and 95 % quantiles. Made by lab/benchmarks/scatter_scene.py bands, {base} base points.",
        f"[{name}]",
        f"runs = {found.runs}",
        "",
        f"[{name}.figures]",
    ]
    for figure in TOLD:
        band = found.figures[figure]
        numbers = [band.nominal, *(band.quantiles.get(level, np.nan) for level in LEVELS)]
        if np.isfinite(numbers).all() and numbers[1] < numbers[3]:
            lines.append(f"{figure} = [{', '.join(f'{x:.5g}' for x in numbers)}]")
    return "\n".join([*lines, ""])


def _target(name: str) -> Any:
    """Return a built-in scene as a study has it."""
    scene = load_scene(name)
    return target_of(scene_evaluator(scene), scene_scatter(scene))


class _Full:
    """Full runs of some draws, in a worker."""

    def __init__(self, target: Target) -> None:
        self.target = target

    def __call__(self, rows: list[dict[str, Any]]) -> Any:
        return self.target.solve(rows, np.ones(len(rows), bool))


def plain(name: str, file: Path, runs: int, workers: int) -> None:
    """Run independent draws in full and keep figures, outcomes and series."""
    target = _target(name)
    target.evaluator.played = {}
    uniforms = np.random.default_rng(2027).random((runs, len(target.scatter.sources)))
    rows = target.scatter.values(uniforms)
    answers = np.full((runs, len(target.nominal())), np.nan)
    codes, done, spent = np.full(runs, -1), 0, 0.0
    if file.exists():
        with np.load(file) as kept:
            answers, codes, spent = kept["answers"], kept["codes"], float(kept["seconds"])
        done = int((codes >= 0).sum())
    batches = [rows[i : i + BATCH] for i in range(done, runs, BATCH)]
    with runner(workers) as run:
        begin = time.perf_counter()
        for found, flags in run(_Full(target), batches, 1):
            span = slice(done, done + len(flags))
            answers[span], codes[span], done = found, flags, done + len(flags)
            np.savez(
                file,
                answers=answers,
                codes=codes,
                uniforms=uniforms,
                names=target.scatter.names,
                figures=[f.name for f in target.figures],
                outcomes=target.outcomes,
                series=target.series,
                time=target.time,
                nominal=target.nominal(),
                seconds=spent + time.perf_counter() - begin,
                note=f"{workers} workers; fidelity levels: {target.identity['levels']}; "
                f"washers in the loop",
            )
            print(f"{done} of {runs}", flush=True)


def compare(name: str, file: Path, base: int, workers: int, indices: bool) -> None:
    """Print quantiles of a study against those of the plain runs."""
    with np.load(file) as kept:
        sound = kept["codes"] == 0
        answers, figures = kept["answers"][sound], kept["figures"].tolist()
        print(f"plain: {sound.sum()} runs, {kept['seconds']:.0f} s; {kept['note']}")
    begin = time.perf_counter()
    found = propagate(load_scene(name), runs=base, workers=workers, indices=indices)
    print(f"study: {found.solves} runs, {time.perf_counter() - begin:.0f} s, failed {found.failed}")
    print(*found.warnings, sep="\n")
    print(f"{'figure':30} {'5 %':>21} {'50 %':>21} {'95 %':>21}  off/band, noise of plain/band")
    outside = 0
    for i, figure in enumerate(figures):
        band = found.figures.get(figure)
        if band is None:
            continue
        values = answers[np.isfinite(answers[:, i]), i]
        known = np.quantile(values, LEVELS)
        width = known[2] - known[0]
        if not width > 1e-9 * abs(known[1]):
            continue
        own = [band.quantiles[level] for level in LEVELS]
        noise = _noise(values)
        off = np.abs(np.subtract(own, known)) / width
        pairs = " ".join(f"{a:10.4g} {b:10.4g}" for a, b in zip(known, own, strict=True))
        inside = [
            band.confidence[level][0] - 2.0 * e <= x <= band.confidence[level][1] + 2.0 * e
            for level, x, e in zip(LEVELS, known, noise, strict=True)
        ]
        outside += 3 - sum(inside)
        mark = "" if all(inside) else "*"
        print(f"{figure:30} {pairs}  {off.max():.3f} {max(noise) / width:.3f} {mark}")
    print(f"{outside} quantiles apart by more than both confidences (*)")


def paired(name: str, file: Path, draws: int) -> None:
    """Print how far the shortcut is from full runs at the same draws, over the band."""
    target = _target(name)
    with np.load(file) as kept:
        draws = min(draws, int((kept["codes"] >= 0).sum()))
        full, uniforms = kept["answers"][:draws], kept["uniforms"][:draws]
    begin = time.process_time()
    own, _ = target.solve(target.scatter.values(uniforms), np.ones(draws, bool))
    print(f"{draws} draws, {(time.process_time() - begin) / draws:.2f} s of one core each")
    print(f"{'figure':30} {'largest':>9} {'rms':>9} {'quantiles':>9}  over the band")
    for i, figure in enumerate(target.figures):
        there = np.isfinite(own[:, i]) & np.isfinite(full[:, i])
        a, b = own[there, i], full[there, i]
        known = np.quantile(b, LEVELS)
        width = known[2] - known[0]
        if width > 1e-9 * abs(known[1]):
            off, moved = np.abs(a - b) / width, np.abs(np.quantile(a, LEVELS) - known) / width
            rms = float(np.sqrt((off**2).mean()))
            print(f"{figure.name:30} {off.max():9.4f} {rms:9.4f} {moved.max():9.4f}")


def _noise(values: Any) -> list[float]:
    """Return standard errors of the quantiles, by drawing the sample again."""
    rng = np.random.default_rng(0)
    again = rng.choice(values, (200, len(values)))
    return np.quantile(again, LEVELS, axis=1).std(1).tolist()


if __name__ == "__main__":
    main()
