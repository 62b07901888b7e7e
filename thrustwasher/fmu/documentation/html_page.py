"""documentation/index.html of an FMU: the template in fmu_src filled from the model's lists."""

from collections.abc import Sequence
from pathlib import Path

from ...errors import Status
from ...ladder.card import Card, load_cards
from ...ladder.formats import shown_error
from ...model.spec import ModelSpec
from ..description.interface import Variable, enumerations, variables
from ..model_kernels import package_version
from ..package.licences import listed_licences
from ..package.model_sources import source_folder
from .markup import data_uri, markup, table
from .reference_results import FOLDER
from .wiring import wiring

Rows = list[tuple[str, ...]]
QUANTITIES = ("friction_torque", "temperature", "film_thickness", "film_ratio")  # of the cards


def page(
    spec: ModelSpec, folder: Path, *, target: str, fmi: int, guid: str, platforms: Sequence[str],
    runs: bool = True,
) -> str:  # fmt: skip
    """Return the page.

    ``folder`` holds the model's icon and readme, whose first line is the title. With ``runs`` =
    False the model is not run for the slope of its torque, and need not be compiled for this
    Python.
    """
    from jinja2 import Environment, StrictUndefined  # late: what is built already needs none

    found = variables(spec)
    icon = folder / "icon.png"
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True)
    template = (source_folder() / "documentation" / "index.html").read_text("utf-8")
    return environment.from_string(template).render(
        spec=spec, target=target, fmi=fmi, guid=guid, platforms=platforms,
        version=package_version(), reference=FOLDER,
        table=table,
        icon=data_uri(icon) if icon.is_file() else "",
        inputs=_settable(found, "input"), parameters=_settable(found, "parameter"),
        outputs=[(v.name, _unit(v), v.help) for v in found if v.causality == "output"],
        enumerations=[(name, str(i.value), i.name, i.help)
                      for name, items in enumerations(spec).items() for i in items],
        wiring=wiring(spec, runs=runs), statuses=_statuses(),
        accuracy_head=("fidelity", "within", "points", *QUANTITIES, "measured with"),
        accuracy=accuracy(spec), equations=_equations(folder),
        licences=listed_licences(target, platforms),
    )  # fmt: skip


def _settable(found: tuple[Variable, ...], causality: str) -> Rows:
    shown = [v for v in found if v.causality == causality]
    return [(v.name, _unit(v), _allowed(v), f"{v.start:g}", v.help) for v in shown]


def _unit(v: Variable) -> str:
    return v.unit if v.type == "Real" else v.type_name or v.type


def _allowed(v: Variable) -> str:
    return f"{v.low:g} .. {v.high:g}" if v.low is not None and v.high is not None else ""


def _statuses() -> Rows:
    return [
        (str(int(s)), s.name, "failure" if s.is_failure else "advice" if s else "-", s.advice)
        for s in sorted(Status)
    ]


def accuracy(spec: ModelSpec) -> Rows:
    """Return what the model's cards say of the default parameters: a row for each card."""
    rungs = list(spec.fidelities)
    found = [card for card in load_cards(spec.key)
             if card.params.name == "default" and card.fidelity in rungs]  # fmt: skip
    found.sort(key=lambda card: (rungs.index(card.fidelity), card.chart or ""))
    return [
        (
            f"{card.fidelity} {card.chart or ''}".strip(),
            ", ".join(f"{n} {a.min:g} .. {a.max:g} {a.unit}" for n, a in card.envelope.items()),
            str(card.held_out.n),
            *(_worst(card, quantity) for quantity in QUANTITIES),
            f"version {card.package['version']}",
        )
        for card in found
    ]


def _worst(card: Card, quantity: str) -> str:
    """Return the largest error of a quantity in any cell of a card."""
    errors = card.errors.get(quantity)
    found = [e for row in errors.worst for e in row if e is not None] if errors else []
    return shown_error(max(found), errors.kind, errors.unit) if errors and found else "-"


def _equations(folder: Path) -> str:
    file = folder / "readme.md"
    readme = file.read_text("utf-8") if file.is_file() else ""
    title, _, rest = readme.partition("\n")
    return markup(rest if title.startswith("# ") else readme, folder, level=2)
