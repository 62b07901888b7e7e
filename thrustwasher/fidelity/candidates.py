"""A rung with its fresh cards: what it promises over boxes, and what it costs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..models._spec import ModelSpec
from ..store.card_parts import Axis, worst_near
from ..store.cards import Card, load_cards, params_digest, refused_files
from .boxes import Box, Part, sizes, split
from .words import shown_error, shown_share

if TYPE_CHECKING:
    from .choose import Request


@dataclass(frozen=True, slots=True)
class Told:
    """What one card says of a box: worst error, share of points without an answer, its chart."""

    worst: float
    silent: float
    chart: str | None


@dataclass(frozen=True, slots=True)
class Seen:
    """What a rung's cards say of parts of a box."""

    error: float  # promised, safety included
    kind: str  # of the error: relative or absolute
    unit: str | None
    rest: list[Part]  # where the rung is not verified or does not answer
    charts: str
    beside_folds: str


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

    @property
    def setup(self) -> float:
        """Seconds spent once: loading and compiling, building what is not shipped."""
        return max(
            c.cost.first_call_s + (0.0 if c.is_built else c.cost.build_s) for c in self.cards
        )

    def spread(self, n_calls: float) -> float:
        """Seconds within which two costs count as equal."""
        return n_calls * max(c.cost.call_iqr_s for c in self.cards)

    def over(self, parts: list[Part], request: Request) -> Seen | None:
        """Return what the cards say of parts of a box, or None if they do not speak of any."""
        envelope, quantity = self.envelope, request.quantity
        told: list[Told] = []
        rest: list[Part] = []
        for part in parts:
            inside, pieces = split(part, envelope)
            rest += pieces
            if inside is None:
                continue
            found = [t for t in (_read(c, quantity, inside.box) for c in self.cards) if t]
            told += found
            if not found:
                rest.append(Part(inside.box, inside.share, "where no held-out point fell"))
                continue
            silent = max(t.silent for t in found)
            if silent > 0.0:
                words = f"where {self.fidelity} itself says it is outside"
                rest.append(Part(inside.box, silent * inside.share, words))
        if not told:
            return None
        errors = self.cards[0].errors[quantity]
        return Seen(
            error=request.safety * max(t.worst for t in told),
            kind=errors.kind,
            unit=errors.unit,
            rest=rest,
            charts=_charts({t.chart for t in told if t.chart}),
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


def _charts(names: set[str]) -> str:
    known = " and ".join(sorted(names))
    return f" ({known} chart{'s' * (len(names) > 1)})" if names else ""


def _read(card: Card, quantity: str, box: Box) -> Told | None:
    """Return what a card says of a box inside its envelope, or None if no point fell there."""
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
    return Told(worst, silent / max(answered + silent, 1), card.chart)


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
        return "no card for these parameters"
    return f"no card; make one: python -m thrustwasher.fidelity.verify {model} {rung}"
