"""Cards: the verified error and the cost of one rung, chart and parameter set.

A card is a JSON file that ``python -m thrustwasher.study.verify`` writes. It speaks for the
kernels and the parameters it was made with and for its envelope only; one that no longer fits is
refused with the command that renews it. A file that cannot be read is refused too: a solve never
stops because of a card.
"""

import json
import os
import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from ..errors import ParameterError
from ..model.record import from_plain
from ..model.registry import find_model
from ..native.files import user_cache
from ..storage.digests import CHECK, DATA, closure, is_broken, kernel_digest, params_digest, sealed
from . import card_parts as part
from .formats import shown_error

SCHEMA = 2
SAFETY = 1.5  # between a cell's worst held-out point and what is promised
OWN = "own-"  # begins the name of a parameter set whose cards lie in the user's cache
FOLDER = "THRUSTWASHER_CARDS"  # environment: one more folder with cards, for own parameter sets
VERIFY = "python -m thrustwasher.study.verify"  # makes cards


@dataclass(frozen=True, slots=True)
class Card:
    """What is known of one rung's error in one box of inputs; the fields are the file's keys."""

    schema: int
    model: str
    fidelity: str
    chart: str | None
    branch: str | None
    fold: part.Fold | None
    params: part.ParameterSet
    kernels: part.Sources
    package: dict[str, Any]  # version, commit
    made: str
    envelope: dict[str, part.Axis]
    errors: dict[str, part.Errors]
    cells: part.Cells
    by_film_ratio: part.ByFilmRatio | None
    held_out: part.HeldOut
    reference: part.Reference
    cost: part.Cost
    machine: dict[str, Any]  # that the seconds were measured on

    @property
    def name(self) -> str:
        """The file's name without its ending."""
        parts = [self.model, self.fidelity, self.chart, self.params.name]
        return "-".join(p for p in parts if p and p != "default")

    def covers(self, point: Mapping[str, float]) -> bool:
        """Tell if a point (all inputs, SI) lies inside the envelope; only sizes count."""
        return all(
            name in point and axis.min <= _size(axis, point[name]) <= axis.max
            for name, axis in self.envelope.items()
        )

    def error_of(
        self, quantity: str, point: Mapping[str, float], film_ratio: float | None = None
    ) -> float | None:
        """Return the worst error of a point's cell, or None outside the envelope.

        With the film ratio found there, the worst of its class if that is less: both hold.
        """
        if quantity not in self.errors or not self.covers(point):
            return None
        i, j = (
            self.cells.index(k, _size(self.envelope[name], point[name]))
            for k, name in enumerate(self.cells.axes)
        )
        found = None if i is None or j is None else part.worst_near(self.errors[quantity], i, j)
        if found is None or film_ratio is None or self.by_film_ratio is None:
            return found
        alike = self.by_film_ratio.error_of(quantity, film_ratio)
        return found if alike is None else min(found, alike)

    def worst(self, quantity: str) -> float | None:
        """Return the largest error of a quantity over all cells."""
        table = self.errors[quantity].worst if quantity in self.errors else ()
        return max((e for row in table for e in row if e is not None), default=None)

    def shown_worst(self, quantity: str) -> str:
        """Return it as a person reads it, "-" if there is none."""
        found, errors = self.worst(quantity), self.errors.get(quantity)
        return "-" if found is None or not errors else shown_error(found, errors.kind, errors.unit)

    def stale(self, params: Any = None) -> str | None:
        """Return why the card does not hold here, with the command that renews it, or None.

        Without ``params`` only the kernels are looked at.
        """
        renew = f"renew it: {VERIFY} {self.model} {self.fidelity}"
        if self.params.name.startswith(OWN):
            renew = "renew it: thrustwasher cards PART.toml"
        if params is not None and params_digest(params) != self.params.sha256:
            return f"made for other parameters ({self.params.name}); {renew}"
        try:
            files = (*files_of(self.model, self.fidelity), *self.built)
            if sorted(files) != sorted(self.kernels.files):
                return f"the kernels are made of other files since {self.made}; {renew}"
            if kernel_digest(self.kernels.files) != self.kernels.sha256:
                return f"the kernels have changed since {self.made}; {renew}"
        except (KeyError, OSError) as error:
            return f"a source is not there ({error}); {renew}"
        return None

    @property
    def built(self) -> tuple[str, ...]:
        """Shipped files that would else have to be built before the first call."""
        return tuple(name for name in self.kernels.files if "/" in name)

    def as_json(self) -> str:
        """Return the text of the card's file, with a checksum as its last key."""
        text = json.dumps(sealed(asdict(self)), indent=1, allow_nan=False)
        innermost = re.compile(r"\[\s+([^][{}]*?)\s+\]")  # rows of numbers on one line each
        return innermost.sub(lambda m: f"[{' '.join(m[1].split())}]", text) + "\n"


def _size(axis: part.Axis, value: float) -> float:
    """Return the size of an input where the card knows sizes only: parts are odd or even in it."""
    return abs(value) if axis.min >= 0.0 else value


def read_card(path: Path) -> Card:
    """Return the card in a file, or raise ParameterError: none, changed, or of another version."""
    try:
        raw = json.loads(path.read_text("utf-8"))
        changed = not isinstance(raw, dict) or CHECK not in raw or is_broken(raw)
    except (OSError, ValueError, RecursionError) as error:
        raise ParameterError(f"{path.name}: cannot be read ({error})") from None
    if changed:
        raise ParameterError(
            f"{path.name}: was changed since it was written ({CHECK} does not fit); make it again: "
            f"{VERIFY}"
        )
    del raw[CHECK]
    try:
        if raw["schema"] == SCHEMA:
            card: Card = from_plain(Card, raw)
            return card
    except (KeyError, TypeError, AttributeError) as error:
        raise ParameterError(f"{path.name}: is no card of this version ({error})") from None
    raise ParameterError(
        f"{path.name}: schema = {raw['schema']}, this version reads {SCHEMA}; renew it: {VERIFY}"
    )


def own_folder() -> Path:
    """Return where the cards of the user's own parts lie; it need not exist."""
    return user_cache() / "cards"


def card_folders() -> list[Path]:
    """Return the folders that are searched: the package's, the user's, the environment's."""
    named = os.environ.get(FOLDER)
    return [DATA / "cards", own_folder(), *([Path(named)] if named else [])]


@cache
def _folder(folder: Path) -> tuple[tuple[Card, ...], tuple[tuple[str, str], ...]]:
    """Return the cards of a folder, and name and reason of each file that is none."""
    cards, refused = [], []
    for path in sorted(folder.rglob("*.json"), key=lambda path: path.name):
        try:
            cards.append(read_card(path))
        except ParameterError as error:
            refused.append((path.name, str(error)))
    return tuple(cards), tuple(refused)


def forget() -> None:
    """Read the folders again next time."""
    _folder.cache_clear()
    _fresh.cache_clear()


def load_cards(model: str, params: Any = None) -> list[Card]:
    """Return the readable cards of a model, for one parameter set if it is given.

    A stale card is among them: ask ``card.stale(params)``. Of two cards with one name the later
    folder's counts.
    """
    found = {c.name: c for folder in card_folders() for c in _folder(folder)[0]}
    digest = None if params is None else params_digest(params)
    return [c for c in found.values() if c.model == model and digest in (None, c.params.sha256)]


def refused_files() -> dict[str, str]:
    """Return name and reason of each file in the folders that is no card."""
    return {name: why for folder in card_folders() for name, why in _folder(folder)[1]}


def fresh_cards(model: str, fidelity: str, params: Any) -> tuple[Card, ...]:
    """Return the cards of a rung that hold for these parameters and these kernels."""
    return _fresh(model, fidelity, params, os.environ.get(FOLDER))


@lru_cache(maxsize=64)
def _fresh(model: str, fidelity: str, params: Any, folder: str | None) -> tuple[Card, ...]:
    cards = [c for c in load_cards(model, params) if c.fidelity == fidelity]
    return tuple(c for c in cards if c.stale(params) is None)


def error_estimate(
    model: str, fidelity: str, params: Any, point: Mapping[str, float],
    quantity: str = "friction_torque", branch: str | None = None, film_ratio: float | None = None,
) -> float | None:  # fmt: skip
    """Return the error to expect at a point, or None where no fresh card speaks.

    1.5 x the larger of the worst held-out error in the point's cell and the reference's own
    uncertainty; over all charts if the branch is not named. With the film ratio found at the point,
    the worst among points of such film ratios if that is less.
    """
    errors = []
    for card in fresh_cards(model, fidelity, params):
        if branch is None or card.branch in (None, branch):
            found = card.error_of(quantity, point, film_ratio)
            if found is not None:
                errors.append(max(found, card.reference.uncertainty.get(quantity, 0.0)))
    return SAFETY * max(errors) if errors else None


def files_of(model: str, fidelity: str) -> tuple[str, ...]:
    """Return the kernel modules of a rung, sorted: all it computes with, and the model's step.

    The step's module sends each rung to its kernels; what else it imports does not count, or every
    rung would hang on every other one. KeyError: no such rung; FileNotFoundError: a module is not
    there in this version.
    """
    found = find_model(model)
    if found.ladder is None:
        raise KeyError(model)
    return tuple(sorted({*closure(*found.ladder.kernels[fidelity]), found.spec.kernel}))
