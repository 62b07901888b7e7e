"""The whole way from parameters to a map file: plan, lines, check, card."""

from __future__ import annotations

import os
import platform
import time
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import ParameterError, naming
from ..kernels import washer_map_layout as L
from ..kernels._jit import kernel_digest
from ..models.washer_params import WasherParams
from ..store.maps import SUFFIX, pack
from .build import FIDELITIES, build_lines
from .check import check_map
from .plan import MapPlan, plan_map

Progress = Callable[[str], Callable[[int, int], None]]


def make_map(
    params: WasherParams, out: Path, *, box: dict[str, tuple[float, float]] | None = None,
    fidelity: str = "fine", workers: int | None = None, points: int = 200,
    progress: Progress | None = None,
) -> dict[str, Any]:  # fmt: skip
    """Build a map, check it and write it; return its card.

    Parameters
    ----------
    params : the washer
    out : file to write, ``*.twm``; what is solved is kept beside it until the map is done
    box : (low, high) of load [N], speed [rad/s], tilt [rad], oil_temperature [K]
    fidelity : "fine" or "field", the mesh that is mapped
    workers : processes; None: one per core
    points : held-out points of the check
    progress : called with a label, returns ``show(done, total)``

    Raises
    ------
    ParameterError : a wrong box or fidelity, or more numbers than a map may have
    SolveError : a node has no solution
    """
    if fidelity not in FIDELITIES:
        raise ParameterError(f"fidelity = {fidelity!r}, allowed: {' or '.join(FIDELITIES)}")
    plan = plan_map(params, box)
    size = L.DATA + int(np.prod(plan.shape)) * L.LINE
    if size > L.ROOM:
        raise ParameterError(
            f"box: {size} numbers for {plan.shape[0]} x {plan.shape[1]} x {plan.shape[2]} nodes, "
            f"allowed: {L.ROOM}; make the box smaller"
        )
    count = workers or os.cpu_count() or 1
    show = progress or (lambda _label: lambda _done, _total: None)
    began = time.perf_counter()
    journal = out.with_name(f"{out.name}.journal")
    data = build_lines(plan, fidelity=fidelity, workers=count, progress=show("lines"),
                       journal=journal)  # fmt: skip
    took = time.perf_counter() - began
    draft = out.with_name(f".{out.name}.draft{SUFFIX}")
    card = _card(plan, fidelity, took, count)
    try:
        _write(draft, data, card)
        verdict = check_map(params, str(draft), points=points, fidelity=fidelity, workers=count,
                            progress=show("held-out points"))  # fmt: skip
        card["held_out"] = verdict.as_dict()
        _write(draft, data, card)
        draft.replace(out)
        journal.unlink(missing_ok=True)
    finally:
        draft.unlink(missing_ok=True)
    return card


def _write(path: Path, data: Any, card: dict[str, Any]) -> None:
    with naming(path):
        path.write_bytes(pack(data, card))


def _card(plan: MapPlan, fidelity: str, took: float, workers: int) -> dict[str, Any]:
    return {
        "kind": "washer map", "params": asdict(plan.params), "box": plan.box,
        "nodes": plan.shape, "marks": plan.marks, "built_from": fidelity,
        "kernels": kernel_digest(), "build_s": round(took, 1), "workers": workers,
        "machine": f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores",
        "held_out": None,
    }  # fmt: skip
