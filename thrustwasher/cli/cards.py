"""``thrustwasher cards``: each rung's verified error, where, its cost; of one's own part too."""

import argparse
from typing import Any

from ..errors import ParameterError
from ..ladder.card import VERIFY
from ..model.part_file import is_part, load_part
from ..model.registry import ladder_of, models_with_cards, spec_of
from ..units import format_quantity, parse_quantity
from . import _output

HELP = "list the verified errors of all rungs, or verify those of a part file"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    models = ", ".join(models_with_cards())
    parser.add_argument(
        "model",
        nargs="?",
        metavar="MODEL|FILE",
        help=f"list only {models}; a part file (.toml): verify its rungs in its box, half a minute "
        "or less",
    )
    group = parser.add_argument_group("of a part file")
    group.add_argument(
        "--tol",
        metavar="X",
        default="0.01",
        help="relative error of the map's torque allowed, default 0.01",
    )
    group.add_argument(
        "--points", default=60, metavar="N", type=int, help="held-out points, default 60"
    )
    group.add_argument("--workers", type=int, metavar="N", help="processes; default: all cores")
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")


def run(arguments: argparse.Namespace) -> int:
    """List the cards, fresh or not; files that are no cards come last."""
    from ..ladder.card import load_cards, refused_files

    if arguments.model and is_part(arguments.model):
        return _verify(arguments)
    if arguments.model and arguments.model not in models_with_cards():
        ladder_of(arguments.model)  # says which there are
    wanted = [arguments.model] if arguments.model else list(models_with_cards())
    found = {m: sorted(load_cards(m), key=_order(m)) for m in wanted}
    begin = f"{arguments.model}-" if arguments.model else ""
    refused = {name: why for name, why in refused_files().items() if name.startswith(begin)}
    if arguments.json:
        records = [_record(card) for cards in found.values() for card in cards]
        _output.print_json({"cards": records, "refused": refused})
        return 0
    for model, cards in found.items():
        _print_model(model, cards)
    for name, why in refused.items():
        print(f"{name}: refused: {why}")
    return 0


def _verify(arguments: argparse.Namespace) -> int:
    """Verify the rungs of a part file and list what was found."""
    part = load_part(arguments.model)
    ladder_of(part.spec.key)  # ParameterError where no rung has a card
    if arguments.workers is not None and arguments.workers < 1:
        raise ParameterError(f"--workers = {arguments.workers}, allowed: 1 or more")
    tol = parse_quantity(arguments.tol, "1", "tol")

    from ..study.own_cards import make_own_cards

    cards = make_own_cards(part.spec, part.params, part.box, tol=tol, points=arguments.points,
                           workers=arguments.workers, progress=_output.time_left)  # fmt: skip
    if arguments.json:
        _output.print_json({"cards": [_record(card) for card in cards], "refused": {}})
        return 0
    _print_model(part.spec.key, cards)
    print(f"  {arguments.points} points and none beyond: with 95 % confidence at most "
          f"{3.0 / arguments.points:.0%} of the box is worse")  # fmt: skip
    return 0


def _order(model: str) -> Any:
    """Return the key that sorts cards by parameter set, then by rung as in the ladder."""
    place = {rung: k for k, rung in enumerate(spec_of(model).fidelities)}
    return lambda card: (card.params.name, place.get(card.fidelity, 99), card.chart or "")


def _print_model(model: str, cards: list[Any]) -> None:
    """Print a table per parameter set."""
    if not cards:
        print(f"{model}: no cards; make them: {VERIFY} {model}")
    for name in dict.fromkeys(card.params.name for card in cards):
        mine = [card for card in cards if card.params.name == name]
        spans = ", ".join(
            f"{n} {a.min:g} .. {a.max:g} {a.unit}" for n, a in mine[0].envelope.items()
        )
        print(f"{model}, {name} parameters: {spans}")
        rows = []
        for card in mine:
            errors = [card.shown_worst(q) for q in ("friction_torque", "temperature")]
            time = format_quantity(card.cost.call_median_s, "s", digits=2)
            rung = f"{card.fidelity} {card.chart or ''}".strip()
            told = f"{card.held_out.n} points; {card.stale() or 'fresh'}"
            rows.append((rung, f"{errors[0]:>10} {errors[1]:>10} {time:>8}", told))
        _output.print_rows([("rung", f"{'torque':>10} {'temp.':>10} {'a call':>8}", ""), *rows])


def _record(card: Any) -> dict[str, Any]:
    """Return what a program wants to know of a card."""
    return {
        "name": card.name, "model": card.model, "fidelity": card.fidelity, "chart": card.chart,
        "parameters": card.params.name, "made": card.made, "stale": card.stale(),
        "points": card.held_out.n, "failed": card.held_out.failed,
        "outside": card.held_out.outside,
        "envelope": {n: [a.min, a.max, a.unit] for n, a in card.envelope.items()},
        "worst": {q: card.worst(q) for q in card.errors},
        "reference_uncertainty": dict(card.reference.uncertainty),
        "call_median_s": card.cost.call_median_s, "call_iqr_s": card.cost.call_iqr_s,
        "first_call_s": card.cost.first_call_s,
    }  # fmt: skip
