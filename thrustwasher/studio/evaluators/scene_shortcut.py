"""What the shortcut of ``scene_runs`` errs by: draws of a scene run both ways."""

import hashlib
import json
import warnings
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from ...model.quantity import Figure
from ...model.scatter import Scatter
from ...native.files import write
from ...processes import usable_cores
from .evaluator import Array, Row
from .scene_runs import Loop

FULL_RUNS = 16


class Runs(Protocol):
    """What is compared: a scene with some parts played, and with all of them solved."""

    @property
    def played(self) -> Mapping[str, Any]:
        """Its washers as recorded."""

    @property
    def figures(self) -> Mapping[str, Figure]:
        """Key figures, of kind "real", first."""

    @property
    def identity(self) -> Mapping[str, str]:
        """What makes it another scene."""

    @property
    def folder(self) -> Path:
        """Where the answer is kept."""

    def new_loop(self, played: Mapping[str, Any]) -> Loop:
        """Return the scene's instances, some of them played."""

    def all_answers(self, loop: Loop, rows: Sequence[Row]) -> Array:
        """Return all key figures of rows (n, m)."""


def shortcut_errors(evaluator: Runs, scatter: Scatter) -> tuple[Array, Array]:
    """Return what the shortcut errs by at draws, and the band, of each key figure (m,).

    It is measured once per scene and scatter.
    """
    from scipy.stats import qmc  # late: it takes a third of a second

    points = qmc.Sobol(len(scatter.sources), seed=np.random.default_rng(0))
    rows = scatter.values(points.random(FULL_RUNS))
    own = json.dumps([evaluator.identity, list(evaluator.figures), rows]).encode()
    file = evaluator.folder / f"shortcut-{hashlib.sha256(own).hexdigest()[:16]}.json"
    try:
        error, band = json.loads(file.read_text("utf-8"))
    except (OSError, ValueError):
        error, band = (x.tolist() for x in _measured(evaluator, rows))
        with suppress(OSError):
            write(file, json.dumps([error, band]).encode())
    return np.array(error), np.array(band)


def _measured(evaluator: Runs, rows: list[dict[str, Any]]) -> tuple[Array, Array]:
    """Return the largest error of the shortcut and the band, of each figure (m,), by full runs."""
    n = min(usable_cores(), len(rows))
    parts = [slice(i, None, n) for i in range(n)]
    loops = [(evaluator.new_loop(evaluator.played), evaluator.new_loop({})) for _ in parts]
    n_figures = sum(f.kind == "real" for f in evaluator.figures.values())
    both = np.empty((2, len(rows), n_figures))

    def run(part: slice, own: tuple[Loop, Loop]) -> None:
        for k, loop in enumerate(own):
            both[k, part] = evaluator.all_answers(loop, rows[part])

    with ThreadPoolExecutor(n) as pool:
        list(pool.map(run, parts, loops))
    for pair in loops:
        for loop in pair:
            loop.close()
    short, full = both
    with warnings.catch_warnings():  # a figure may be absent in all of these runs
        warnings.simplefilter("ignore", RuntimeWarning)
        band = np.nan_to_num(np.nanmax(full, 0) - np.nanmin(full, 0))
        error = np.nan_to_num(np.nanmax(np.abs(short - full), 0))
    one_alone = (np.isnan(short) != np.isnan(full)).any(0)  # as a lock-up that the other lacks
    return np.where(one_alone, band, error), band
