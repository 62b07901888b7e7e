"""Put a card together and write its file."""

import math
from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from ..errors import ParameterError
from ..ladder.card import SCHEMA, Card, files_of
from ..ladder.card_parts import Cost, HeldOut, ParameterSet, Reference, Sources
from ..model.prepare import tables_of
from ..storage.digests import DATA, changed_fields, kernel_digest, params_digest
from ..storage.whole_files import whole_file
from .card_cases import SAMPLING, Case
from .costs import Timing
from .error_tables import by_film_ratio, error_tables, fold_part, uncertainties
from .reference_cache import source_of
from .reference_values import FAILED, OK, OUTSIDE, Answer, ReferencePoint
from .surroundings import this_machine, this_package

MESHED = ("coarse", "field", "fine")


def make_card(
    case: Case, rung: str, chart: str | None, pairs: Sequence[tuple[ReferencePoint, Answer]],
    timing: Timing, first: float,
) -> Card:  # fmt: skip
    """Return the card of one chart from reference values and a rung's answers to them."""
    errors, cells = error_tables(pairs, case.verified)
    away = [a for t, a in pairs if not t.beside_fold]
    verdicts = [a.verdict for a in away]
    known = [t for t, _ in pairs]
    source = source_of(case.spec.key)
    built = _built(case, rung)
    files = list(files_of(case.spec.key, rung))
    files += [built.path.relative_to(DATA.resolve()).as_posix()] if built else []
    return Card(
        schema=SCHEMA, model=case.spec.key, fidelity=rung, chart=chart,
        branch=known[0].branch if known else None, fold=fold_part(pairs),
        params=ParameterSet(case.name, params_digest(case.params), changed_fields(case.params)),
        kernels=Sources(tuple(files), kernel_digest(files)),
        package=this_package(), made=datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ"),
        envelope=dict(case.verified), errors=errors, cells=cells,
        by_film_ratio=by_film_ratio(pairs),
        held_out=HeldOut(verdicts.count(OK), verdicts.count(FAILED), verdicts.count(OUTSIDE),
                         case.seed, SAMPLING),
        reference=Reference("reference", source.grid, source.routes, uncertainties(known)),
        cost=_cost(rung, timing, first, away, built),
        machine=this_machine(),
    )  # fmt: skip


def _built(case: Case, rung: str) -> Any:
    """Return the shipped file that a rung's answers come from; None for rungs that need none."""
    tables = tables_of(case.spec, rung)
    found = tables and tables.find(case.params)
    if found and not found.path.is_relative_to(DATA.resolve()):
        raise ParameterError(
            f"{rung} for the {case.name} parameters = {found.path}, allowed: one that is "
            "shipped; a card speaks for a file below thrustwasher/data"
        )
    return found


def _cost(rung: str, timing: Timing, first: float, answers: Sequence[Answer], built: Any) -> Cost:
    """Return a card's cost part; times have three digits."""
    done = [a.work for a in answers if a.verdict == OK]
    count = float(f"{sum(done) / max(len(done), 1):.4g}") or None  # None: nothing is iterated
    what = "iterations x mesh nodes, from nothing" if rung in MESHED else "iterations"
    build = float(built.card.get("build_s") or 0.0) if built else 0.0
    solves = math.prod(built.card.get("nodes") or (0,)) if built else 0
    return Cost(*_seconds(timing, first), build, solves, count, what if count else None)


def _seconds(timing: Timing, first: float) -> tuple[float, float, float, float]:
    times = (timing.median, timing.iqr, timing.least, first)
    median, iqr, least, once = (float(f"{t:.3g}") for t in times)
    return median, iqr, least, once


def timed_card(card: Card, timing: Timing, first: float) -> Card:
    """Return a card with times measured anew, on this machine."""
    c = card.cost
    cost = Cost(*_seconds(timing, first), c.build_s, c.build_solves, c.count, c.count_of)
    return replace(card, cost=cost, machine=this_machine())


def write_card(card: Card, folder: Path) -> Path:
    """Write a card's file; return its path."""
    path = folder / f"{card.model}-{card.params.name}" / f"{card.name}.json"
    with whole_file(path) as draft:
        draft.write_text(card.as_json(), "utf-8")
    return path
