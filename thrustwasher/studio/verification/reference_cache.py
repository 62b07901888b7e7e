"""Reference values at held-out points, kept in a file: all levels are compared with the same."""

import hashlib
import json
from collections.abc import Callable
from contextlib import closing
from dataclasses import asdict
from functools import partial
from typing import Any

from ...errors import SolveError
from ...native.files import to_stderr, user_cache
from ...processes import Run, run_here
from ...storage.digests import kernel_digest, params_digest
from ...storage.journal import Journal, when_free
from .cases import Case
from .reference_clutch import SOURCE as CLUTCH
from .reference_gearmesh import SOURCE as GEARMESH
from .reference_values import FAILED, MARGIN, Answer, ReferencePoint, Source
from .reference_washer import SOURCE as WASHER

SOURCES = {"washer": WASHER, "clutch": CLUTCH, "gearmesh": GEARMESH}  # by the models' keys


def answer(model: str, params: Any, fidelity: str, known: ReferencePoint) -> Answer:
    """Return what a level says at the point of a reference value, asked as a user asks."""
    try:
        return SOURCES[model].answer(params, fidelity, known)
    except SolveError:
        return Answer({}, FAILED)


def reference_points(
    case: Case,
    source: Source,
    n: int,
    progress: Callable[[int], None] = lambda k: None,
    run: Run = run_here,
) -> list[ReferencePoint]:
    """Return the reference's answers at ``n`` points; what is kept is not solved again.

    A run that is stopped goes on where it was.
    """
    axes = [asdict(a) for a in case.box.values()]
    what = [
        kernel_digest(*source.kernels),
        params_digest(case.params),
        axes,
        case.seed,
        list(source.routes),
        list(source.grid or ()),
        MARGIN,
    ]
    digest = hashlib.sha256(json.dumps(what).encode()).hexdigest()[:16]
    path = user_cache() / "references" / f"{case.spec.key}-{case.name}-{digest}.journal"

    def begin() -> Journal:
        return Journal(path, {"source": digest}, "set of reference values")

    with closing(when_free(begin, to_stderr)) as journal:
        known = {
            k: [ReferencePoint(**r) for r in json.loads(text)] for k, text in journal.entries()
        }
        left = [k for k in range(n) if k not in known]
        rows = run(partial(source.solve, case.params), [case.point(k) for k in left], 1)
        for k, row in zip(left, rows, strict=True):
            known[k] = row
            journal.put(k, json.dumps([asdict(r) for r in row]).encode())
            progress(len(known))
        return [point for k in range(n) for point in known[k]]
