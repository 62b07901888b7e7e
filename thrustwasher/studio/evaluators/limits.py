"""Rows of a sweep whose outputs are beyond what a part bears: counted by pieces, told at the end.

The bounds are those that a single solve warns of.
"""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

from ...errors import Status
from ...model.advice import quantity_text
from ...model.quantity import Figure
from ...model.registry import find_model
from ...model.spec import ModelSpec, Signal


class Beyond(NamedTuple):
    """How many rows have an output beyond its bound, and what the worst of them says."""

    signal: Signal | Figure
    sign: float  # 1: the bound is an upper one, -1: a lower one
    advice: str
    rows: int
    worst: float

    def text(self, of: int) -> str:
        """Return a line for a person; ``of`` are all there are."""
        value = quantity_text(self.signal, self.worst)
        return f"{self.rows} of {of} points, at worst {value}: {self.advice}"


def beyond(spec: ModelSpec, columns: Mapping[str, Any]) -> list[Beyond]:
    """Return the outputs that are beyond a bound in some rows."""
    found = []
    for s, sign, bound, advice in _bounds(spec):
        if s.name not in columns:  # of a mesh that is not there
            continue
        values = columns[s.name]
        rows = sign * values > sign * bound  # never of a failed row, which has nan
        if rows.any():
            worst = sign * float(np.max(sign * values[rows]))
            found.append(Beyond(s, sign, advice, int(rows.sum()), worst))
    return found


def beyond_ranges(
    figures: Mapping[str, Figure], columns: Mapping[str, Any], advice: Mapping[str, str]
) -> list[Beyond]:
    """Return the figures that are outside their range in some rows.

    ``advice``: by name, what is to be done; of others that they are usual up to there.
    """
    found = []
    for name, f in figures.items():
        for sign, bound in ((1.0, f.high), (-1.0, f.low)):
            rows = sign * columns[name] > sign * bound if np.isfinite(bound) else np.zeros(0, bool)
            if rows.any():
                worst = sign * float(np.max(sign * columns[name][rows]))
                most = quantity_text(f, bound).partition(" = ")[2]
                text = f"{'more' if sign > 0.0 else 'less'} than {most}"
                found.append(Beyond(f, sign, advice.get(name, text), int(rows.sum()), worst))
    return found


def joined(pieces: Iterable[Beyond]) -> list[Beyond]:
    """Return what pieces of one table say together."""
    found: dict[tuple[str, float], Beyond] = {}
    for new in pieces:
        key = new.signal.name, new.sign
        if old := found.get(key):
            worst = new.sign * max(new.sign * new.worst, new.sign * old.worst)
            new = old._replace(rows=old.rows + new.rows, worst=worst)
        found[key] = new
    return list(found.values())


def _bounds(spec: ModelSpec) -> list[tuple[Signal, float, float, str]]:
    """Return the outputs that have a bound, 1 for an upper and -1 for a lower one, and advice."""
    known, lowest = {s.name: s for s in spec.outputs}, find_model(spec.key).sweep.least
    return [
        *((s, 1.0, s.limit, Status.HOT.advice) for s in spec.outputs if s.limit),
        *((known[name], -1.0, bound, text) for name, (bound, text) in lowest.items()),
    ]
