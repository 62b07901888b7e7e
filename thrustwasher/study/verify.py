"""Write cards: each rung's error at random held-out points against a reference, and its cost.

python -m thrustwasher.study.verify [MODEL] [FIDELITY] [--sample N] [--params NAME] [--out DIR]

Without FIDELITY only cards that are stale or missing are made; a run that is stopped goes on where
it was, because reference values and finished cards are kept.
"""

import argparse
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from ..errors import ParameterError, SolveError
from ..ladder.card import VERIFY, Card, forget, fresh_cards
from ..model.prepare import tables_of
from ..model.registry import ladder_of, models_with_cards
from ..model.spec import ModelSpec
from ..storage.digests import DATA
from .card_cases import POINTS_IN_PART, Case, cases
from .card_writer import make_card, write_card
from .costs import call_cost, first_call
from .reference_cache import answer, reference_points, source_of
from .reference_values import ReferencePoint

HELP = "measure the rungs against the reference and write their cards"


def main(argv: Sequence[str] | None = None) -> int:
    """Make the cards asked for; return 0, or 1 if some could not be made."""
    parser = argparse.ArgumentParser(VERIFY, description=HELP)
    parser.add_argument("model", nargs="?", choices=list(models_with_cards()), help="default: all")
    parser.add_argument("fidelity", nargs="?", help="rung; default: all whose cards are not fresh")
    parser.add_argument("--sample", type=int, metavar="N", help="held-out points; default: 500")
    parser.add_argument("--params", metavar="NAME", help="parameter set; default: all")
    parser.add_argument("--out", type=Path, default=DATA / "cards", metavar="DIR")
    options = parser.parse_args(argv)
    rungs = ladder_of(options.model).kernels if options.model else {}
    if options.fidelity and options.fidelity not in rungs:
        parser.error(f"fidelity = {options.fidelity!r}, allowed: {', '.join(rungs)}")
    failed = 0
    for model in [options.model] if options.model else list(models_with_cards()):
        for case in cases(model):
            if options.params in (None, case.name):
                failed += _case(case, options.fidelity, options.sample or case.n, options.out)
    return 1 if failed else 0


def _case(case: Case, only: str | None, n: int, out: Path) -> int:
    """Make the cards of one parameter set; return how many rungs failed."""
    spec, params = case.spec, case.params
    usable = [rung for rung in ladder_of(spec.key).kernels if holds(spec, rung, params)]
    wanted = [only] if only else [r for r in usable if not fresh_cards(spec.key, r, params)]
    if not wanted:
        _say(f"{case.spec.key} {case.name}: nothing to do")
        return 0
    began = time.perf_counter()
    known = known_points(case, n)
    _say(f"\r{case.spec.key} {case.name}: {len(known)} reference values at {n} points, "
         f"{time.perf_counter() - began:.0f} s")  # fmt: skip
    failed = 0
    for rung in wanted:
        try:
            its_case = case_of(case, rung)
            mine = known if its_case is case else known_points(its_case, n)
            for card in rung_cards(its_case, rung, mine):
                write_card(card, out)
                _say(summary(card))
        except (SolveError, ParameterError, OSError, ValueError) as error:
            failed += 1
            _say(f"{case.spec.key} {case.name} {rung}: no card: {error}")
    forget()
    return failed


def known_points(case: Case, n: int) -> list[ReferencePoint]:
    """Return the reference values of a case, of a part of its box fewer."""
    n = n if case.part is None else min(n, POINTS_IN_PART)

    def show(k: int) -> None:
        if sys.stderr.isatty() or k % 50 == 0:
            end = "" if sys.stderr.isatty() else "\n"
            text = f"\r{case.spec.key} {case.name}: reference {k}/{n}"
            print(text, end=end, file=sys.stderr, flush=True)

    return reference_points(case, source_of(case.spec.key), n, show)


def holds(spec: ModelSpec, rung: str, params: Any) -> bool:
    """Tell if a rung can be used with a parameter set at all; a map may not be there."""
    try:
        tables = tables_of(spec, rung)
        return tables is None or tables.find(params) is not None
    except ParameterError:
        return False


def case_of(case: Case, rung: str) -> Case:
    """Return the case for a rung: a map is verified where it lies."""
    tables = tables_of(case.spec, rung)
    return case.within(tables.box(case.params)) if tables else case


def rung_cards(case: Case, rung: str, known: list[ReferencePoint]) -> Iterator[Card]:
    """Yield the cards of a rung, one per chart, from the reference values."""
    blank = ReferencePoint(case.point(0), None, None, {}, {})
    answer(case.spec.key, case.params, rung, blank)  # compiled from now on
    once = first_call(case.spec.key, rung)
    for chart in dict.fromkeys(t.chart for t in known):
        mine = [t for t in known if t.chart == chart]
        pairs = [(t, answer(case.spec.key, case.params, rung, t)) for t in mine]
        timing = call_cost(case.spec, case.params, rung, mine)
        yield make_card(case, rung, chart, pairs, timing, once)


def summary(card: Card) -> str:
    """Return a line of what a card says."""
    text = ", ".join(f"{q} {card.shown_worst(q)}" for q in card.errors)
    h = card.held_out
    return (
        f"  {card.name}: n {h.n}, failed {h.failed}, outside {h.outside}; {text}; "
        f"{1e6 * card.cost.call_median_s:.3g} us"
    )


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
