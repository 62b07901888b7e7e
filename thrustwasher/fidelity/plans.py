"""Plans: a rung for the part of a box it is verified in, and the next one for the rest."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .boxes import Part
from .candidates import Candidate, Seen

if TYPE_CHECKING:
    from .choose import Request


@dataclass(frozen=True, slots=True)
class Plan:
    """A rung, its promise, and the plan for what it leaves open."""

    fidelity: str
    error: float
    kind: str
    unit: str | None
    charts: str
    beside_folds: str
    call: float  # seconds per call
    seconds: float  # of this rung: all its calls and what is spent once
    spread: float
    share: float  # of the box that the plan is for
    where: str  # that part in words; empty for the whole box
    outside: Plan | None

    @property
    def total(self) -> float:
        """Seconds of this rung and of all that follow."""
        return self.seconds + (self.outside.total if self.outside else 0.0)

    @property
    def unverified(self) -> float:
        """Share of the box that no card speaks for."""
        here = self.share if math.isinf(self.error) else 0.0
        return here + (self.outside.unverified if self.outside else 0.0)


def plans(request: Request, found: list[Candidate]) -> list[Plan]:
    """Return all plans that hold the tolerance, the one to take first."""
    return _ordered(_plans(request, found, [Part(request.box)]))


def _plans(request: Request, found: list[Candidate], parts: list[Part]) -> list[Plan]:
    """Return a plan for each candidate that fits where it is verified in the parts."""
    made = []
    for rung in found:
        seen = rung.over(parts, request)
        if seen is not None and seen.error <= request.tol:
            others = [c for c in found if c is not rung]
            made.append(_plan(request, rung, seen, others, parts))
    return made


def _plan(
    request: Request, rung: Candidate, seen: Seen, others: list[Candidate], parts: list[Part]
) -> Plan:
    """Return the plan that begins with a rung; the best of the others takes what it leaves open."""
    outside = None
    left = sum(p.share for p in seen.rest)
    if seen.rest:
        after = _ordered(_plans(request, others, seen.rest))
        outside = after[0] if after else _unverified(request, rung, others, seen)
    share = sum(p.share for p in parts)
    calls = request.n_calls * max(share - left, 0.0)
    return Plan(
        rung.fidelity, seen.error, seen.kind, seen.unit, seen.charts, seen.beside_folds, rung.call,
        calls * rung.call + rung.setup, rung.spread(calls), share, _where(parts), outside,
    )  # fmt: skip


def _unverified(request: Request, rung: Candidate, others: list[Candidate], seen: Seen) -> Plan:
    """Return who serves the parts that no card speaks for: the model's default, or a finer rung."""
    rungs, usual = list(request.spec.fidelities), request.spec.default_fidelity
    last = rung
    if rungs.index(rung.fidelity) < rungs.index(usual):
        last = next((c for c in others if c.fidelity == usual), rung)
    share = sum(p.share for p in seen.rest)
    return Plan(
        last.fidelity, math.inf, seen.kind, seen.unit, "", "", last.call, 0.0, 0.0, share,
        _where(seen.rest), None,
    )  # fmt: skip


def _where(parts: list[Part]) -> str:
    return " or ".join(dict.fromkeys(p.where for p in parts if p.where))


def _ordered(options: list[Plan]) -> list[Plan]:
    """Return the plans, best first: verified everywhere, then cheap; ties to the more accurate.

    Costs are a tie if each lies within the other's spread: a rung that was badly timed ties no one.
    """
    left, ordered = list(options), []
    while left:
        best = min(left, key=lambda p: (round(p.unverified, 9), p.total))
        ties = [
            p
            for p in left
            if round(p.unverified, 9) == round(best.unverified, 9)
            and p.total - best.total <= min(p.spread, best.spread)
        ]
        chosen = min(ties, key=lambda p: (p.error, p.total))
        ordered.append(chosen)
        left.remove(chosen)
    return ordered
