"""Put a card together and write its file."""

from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from ..errors import ParameterError
from ..ladder.card import OWN, SCHEMA, Card, files_of
from ..ladder.card_parts import Cost, HeldOut, ParameterSet, Reference, Sources
from ..model.prepare import tables_of
from ..storage.digests import DATA, changed_fields, kernel_digest, params_digest
from ..storage.whole_files import whole_file
from .card_cases import Case
from .costs import Timing
from .error_tables import by_film_ratio, error_tables, fold_part, uncertainties
from .reference_cache import source_of
from .reference_values import FAILED, OK, OUTSIDE, Answer, ReferencePoint
from .surroundings import this_machine, this_package


def make_card(
    case: Case, rung: str, chart: str | None, pairs: Sequence[tuple[ReferencePoint, Answer]],
    timing: Timing, first: float,
) -> Card:  # fmt: skip
    """Return the card of one chart from reference values and a rung's answers to them."""
    errors, cells = error_tables(pairs, case.verified)
    verdicts = [a.verdict for t, a in pairs if not t.beside_fold]
    known = [t for t, _ in pairs]
    source = source_of(case.spec.key)
    built = _built(case, rung)
    files = list(files_of(case.spec.key, rung))
    files += [_name_of(built.path)] if built else []
    return Card(
        schema=SCHEMA, model=case.spec.key, fidelity=rung, chart=chart,
        branch=known[0].branch if known else None, fold=fold_part(pairs),
        params=ParameterSet(case.name, params_digest(case.params), changed_fields(case.params)),
        kernels=Sources(tuple(files), kernel_digest(files)),
        package=this_package(), made=datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ"),
        envelope=dict(case.verified), errors=errors, cells=cells,
        by_film_ratio=by_film_ratio(pairs),
        held_out=HeldOut(verdicts.count(OK), verdicts.count(FAILED), verdicts.count(OUTSIDE),
                         case.seed),
        reference=Reference("reference", source.grid, source.routes, uncertainties(known)),
        cost=Cost(*seconds_of(timing, first), (built and built.card.get("build_s")) or 0.0),
        machine=this_machine(),
    )  # fmt: skip


def _built(case: Case, rung: str) -> Any:
    """Return the file that a rung's answers come from; None for rungs that need none."""
    tables = tables_of(case.spec, rung)
    found = tables and tables.find(case.params)
    if found and not (found.path.is_relative_to(DATA.resolve()) or case.name.startswith(OWN)):
        raise ParameterError(
            f"{rung} for the {case.name} parameters = {found.path}, allowed: one that is "
            "shipped; a card speaks for a file below thrustwasher/data"
        )
    return found


def _name_of(file: Path) -> str:
    """Return a file as a card names it: from ``data`` if it is shipped."""
    home = DATA.resolve()
    return (file.relative_to(home) if file.is_relative_to(home) else file).as_posix()


def seconds_of(timing: Timing, first: float) -> tuple[float, float, float]:
    """Return a call's seconds as a card has them: median, spread, first call."""
    median, iqr, once = (float(f"{t:.3g}") for t in (timing.median, timing.iqr, first))
    return median, iqr, once


def write_card(card: Card, folder: Path) -> Path:
    """Write a card's file; return its path."""
    path = folder / f"{card.model}-{card.params.name}" / f"{card.name}.json"
    with whole_file(path) as draft:
        draft.write_text(card.as_json(), "utf-8")
    return path
