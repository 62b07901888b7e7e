"""Reference values at held-out points, kept in a file: all rungs are compared with the same."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from ..store.digests import closure, kernel_digest, params_digest
from .envelopes import Case

QUANTITIES = ("friction_torque", "temperature", "film_thickness", "film_ratio")
Point = dict[str, float]
Values = dict[str, float | list[float]]
MARGIN = 0.05  # of a fold's load: points nearer are told apart


@dataclass(frozen=True)
class Truth:
    """What the reference says at a point on one chart.

    ``values`` holds the quantities, numbers or a course over time; ``uncertainty`` is the
    reference's own for each, in the same unit. ``by_mesh`` holds what a mesh said on the way.
    """

    point: Point
    chart: str | None
    branch: str | None
    values: Values
    uncertainty: dict[str, float]
    beside_fold: bool = False
    by_mesh: dict[str, Values] = field(default_factory=dict)


@dataclass(frozen=True)
class Source:
    """How a model's reference values are found, and what they are made with."""

    solve: Callable[[Any, Point], list[Truth]]
    kernels: tuple[str, ...]  # whose change makes kept values worthless
    fidelity: str
    grid: tuple[int, ...] | None
    routes: tuple[str, ...]


def truths(
    case: Case, source: Source, n: int, progress: Callable[[int], None] = lambda k: None
) -> list[Truth]:
    """Return the reference's answers at ``n`` points; what is kept is not solved again.

    A run that is stopped goes on where it was: each point is written when it is done.
    """
    path = _kept(case, source)
    path.parent.mkdir(parents=True, exist_ok=True)
    known = dict(_read(path))
    found: list[Truth] = []
    with path.open("a", encoding="utf-8") as file:
        for done, k in enumerate(case.numbers(n), 1):
            if k not in known:
                known[k] = source.solve(case.params, case.point(k))
                record = {"k": k, "truths": [asdict(t) for t in known[k]]}
                file.write("\n" + json.dumps(record))  # first: the line before may be cut off
                file.flush()
            found += known[k]
            progress(done)
    return found


def _read(path: Path) -> Iterator[tuple[int, list[Truth]]]:
    """Yield the points in a file; a line that was cut off is passed over."""
    if not path.exists():
        return
    for line in path.read_text("utf-8").split("\n"):
        try:
            record = json.loads(line)
            yield int(record["k"]), [Truth(**t) for t in record["truths"]]
        except (ValueError, KeyError, TypeError):
            continue


def _kept(case: Case, source: Source) -> Path:
    """Return the file for a case: its name tells kernels, parameters, box and method."""
    base = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    axes = [asdict(a) for a in case.envelope.values()]
    what = [kernel_digest(closure(*source.kernels)), params_digest(case.params), axes, case.seed,
            list(source.routes), list(source.grid or ()), MARGIN]  # fmt: skip
    digest = hashlib.sha256(json.dumps(what).encode()).hexdigest()[:16]
    name = f"{case.spec.key}-{case.name}-{digest}.jsonl"
    return Path(base) / "thrustwasher" / "references" / name
