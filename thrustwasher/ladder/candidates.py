"""Rungs with fresh cards, what they promise over boxes and cost, and plans made of them.

A plan is a rung for the part of a box that it is verified in, and the next one for the rest.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

from ..model.spec import ModelSpec
from ..storage.digests import params_digest
from .boxes import Box, Part, Request, sizes, split
from .card import VERIFY, Card, load_cards, refused_files
from .card_parts import Axis, worst_near
from .formats import shown_error, shown_share


@dataclass(frozen=True, slots=True)
class Seen:
    """What a rung's cards say of parts of a box."""

    error: float  # promised, safety included
    kind: str  # of the error: relative or absolute
    unit: str | None
    rest: list[Part]  # where the rung is not verified or does not answer
    charts: str
    beside_folds: str

    @property
    def promise(self) -> str:
        """The error in words."""
        return shown_error(self.error, self.kind, self.unit)


@dataclass(frozen=True, slots=True)
class Candidate:
    """A rung with one fresh card per chart."""

    fidelity: str
    cards: tuple[Card, ...]

    @property
    def envelope(self) -> dict[str, Axis]:
        """The box that all charts have in common."""
        common = dict(self.cards[0].envelope)
        for card in self.cards[1:]:
            for name, axis in card.envelope.items():
                low, high = max(common[name].min, axis.min), min(common[name].max, axis.max)
                common[name] = Axis(low, high, axis.unit, axis.scale)
        return common

    @property
    def call(self) -> float:
        """Seconds per call, of the slowest chart."""
        return max(c.cost.call_median_s for c in self.cards)

    def setup(self, loaded: bool) -> float:
        """Seconds spent once: loading and compiling, building what is not shipped."""
        return max(
            (0.0 if loaded else c.cost.first_call_s) + (0.0 if c.built else c.cost.build_s)
            for c in self.cards
        )

    def spread(self, n_calls: float) -> float:
        """Seconds within which two costs count as equal."""
        return n_calls * max(c.cost.call_iqr_s for c in self.cards)

    def over(self, parts: list[Part], request: Request) -> Seen | None:
        """Return what the cards say of parts of a box, or None if they do not speak of any."""
        envelope, quantity = self.envelope, request.quantity
        told: list[tuple[float, float, str | None]] = []
        rest: list[Part] = []
        for part in parts:
            inside, pieces = split(part, envelope)
            rest += pieces
            if inside is None:
                continue
            found = [t for c in self.cards if (t := _read(c, quantity, inside.box))]
            told += found
            if not found:
                rest.append(Part(inside.box, inside.share, "where no held-out point fell"))
                continue
            silent = max(share for _, share, _ in found)
            if silent > 0.0:
                words = f"where {self.fidelity} itself says it is outside"
                rest.append(Part(inside.box, silent * inside.share, words))
        if not told:
            return None
        errors = self.cards[0].errors[quantity]
        charts = sorted({chart for _, _, chart in told if chart})
        return Seen(
            error=request.safety * max(worst for worst, _, _ in told),
            kind=errors.kind,
            unit=errors.unit,
            rest=rest,
            charts=f" ({' and '.join(charts)} chart{'s' * (len(charts) > 1)})" if charts else "",
            beside_folds=self._beside_folds(quantity, request.safety),
        )

    def _beside_folds(self, quantity: str, safety: float) -> str:
        """Say how large errors are beside folds, where they are told apart."""
        folds = [c.fold for c in self.cards if c.fold is not None and c.fold.n]
        worst = max((f.worst.get(quantity, 0.0) for f in folds), default=0.0)
        if not worst:
            return ""
        errors = self.cards[0].errors[quantity]
        margin = shown_share(max(f.margin for f in folds))
        promise = shown_error(safety * worst, errors.kind, errors.unit)
        return f"within {margin} of a fold's load: {promise}, if the branch is the same"


def _read(card: Card, quantity: str, box: Box) -> tuple[float, float, str | None] | None:
    """Return what a card says of a box inside its envelope, or None if no point fell there.

    That is the worst error, the share of points without an answer, and the card's chart.
    """
    errors = card.errors.get(quantity)
    if errors is None:
        return None
    rows, columns = (
        card.cells.touched(k, *sizes(box[name], card.envelope[name]))
        for k, name in enumerate(card.cells.axes)
    )
    cells = [(i, j) for i in rows for j in columns]
    found = [w for w in (worst_near(errors, i, j) for i, j in cells) if w is not None]
    if not found:
        return None
    answered = sum(errors.n[i][j] for i, j in cells)
    silent = sum(card.cells.outside[i][j] for i, j in cells)
    worst = max(*found, card.reference.uncertainty.get(quantity, 0.0))
    return worst, silent / max(answered + silent, 1), card.chart


def candidates(
    spec: ModelSpec, params: Any, rungs: list[str]
) -> tuple[list[Candidate], dict[str, str]]:
    """Return the rungs that have fresh cards, in the ladder's order, and why others have none."""
    every = load_cards(spec.key)
    digest = params_digest(params)
    found: list[Candidate] = []
    refused: dict[str, str] = {}
    for rung in rungs:
        cards = [c for c in every if c.fidelity == rung]
        mine = [c for c in cards if c.params.sha256 == digest]
        stale = [why for why in (c.stale() for c in mine) if why]
        if mine and not stale:
            found.append(Candidate(rung, tuple(mine)))
        else:
            refused[rung] = stale[0] if stale else _no_card(spec.key, rung, bool(cards))
    return found, refused


def _no_card(model: str, rung: str, others: bool) -> str:
    broken = [why for name, why in refused_files().items() if name.startswith(f"{model}-{rung}")]
    if broken:
        return f"its card is broken: {broken[0]}"
    if others:
        return "no card for these parameters; `thrustwasher cards PART.toml` makes some"
    return f"no card; make one: {VERIFY} {model} {rung}"


@dataclass(frozen=True, slots=True)
class Plan:
    """A rung, what its cards say, and the plan for what it leaves open."""

    rung: Candidate
    seen: Seen
    seconds: float  # of this rung: all its calls and what is spent once
    spread: float
    share: float  # of the box that the plan is for
    where: str  # that part in words; empty for the whole box
    outside: "Plan | None"

    @property
    def total(self) -> float:
        """Seconds of this rung and of all that follow."""
        return self.seconds + (self.outside.total if self.outside else 0.0)

    @property
    def unverified(self) -> float:
        """Share of the box that no card speaks for."""
        here = self.share if math.isinf(self.seen.error) else 0.0
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
    seconds = calls * rung.call + rung.setup(request.loaded)
    return Plan(rung, seen, seconds, rung.spread(calls), share, _where(parts), outside)


def _unverified(request: Request, rung: Candidate, others: list[Candidate], seen: Seen) -> Plan:
    """Return who serves the parts that no card speaks for: the model's default, or a finer rung."""
    rungs, usual = list(request.spec.fidelities), request.spec.default_fidelity
    last = rung
    if rungs.index(rung.fidelity) < rungs.index(usual):
        last = next((c for c in others if c.fidelity == usual), rung)
    share = sum(p.share for p in seen.rest)
    blank = replace(seen, error=math.inf, charts="", beside_folds="")
    return Plan(last, blank, 0.0, 0.0, share, _where(seen.rest), None)


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
        chosen = min(ties, key=lambda p: (p.seen.error, p.total))
        ordered.append(chosen)
        left.remove(chosen)
    return ordered
