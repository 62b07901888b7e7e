"""documentation/index.html of an FMU: one page without scripts and outside links."""

import base64
from collections.abc import Sequence
from html import escape

from ..errors import Status
from ..models._spec import ModelSpec
from . import page_text as said
from .accuracy import CARDS, NOTE
from .curve import curve
from .icon import icon
from .interface import Variable, enumerations, variables
from .markup import markup
from .reference import FOLDER
from .registry import package_version
from .tags import table
from .wiring import wiring

Parts = list[str]


def page(
    spec: ModelSpec, *, target: str, fmi: int, guid: str, equations: str, platforms: Sequence[str],
    runs: bool = True,
) -> str:  # fmt: skip
    """Return the page.

    ``equations`` is the model's readme, its first line the title. With ``runs`` = False the model
    is not run for it, and need not be compiled for this Python: no curve, no slope.
    """
    found = variables(spec)
    parts = [
        *_head(spec), curve(spec) if runs else "", *_needs(target, platforms),
        "<h2>Inputs</h2>", _variables(found, "input"),
        "<h2>Outputs</h2>", _outputs(found),
        "<h2>How to wire it</h2>", wiring(spec, runs=runs),
        "<h2>Parameters</h2>", _variables(found, "parameter"),
        "<h2>Enumerations</h2>", _enumerations(spec),
        "<h2>When something goes wrong</h2>", said.FAILS[target], _statuses(),
        "<h2>To check an installation</h2>", said.CHECK.format(folder=FOLDER, model=spec.name),
        *_accuracy(spec), "<h2>Equations and validity</h2>", _equations(equations),
        *_origin(target, fmi, guid),
    ]  # fmt: skip
    title = f"<title>{escape(spec.name)}</title><style>{said.STYLE}</style>"
    head = f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">{title}</head>'
    return head + "<body>\n" + "\n".join(parts) + "\n</body></html>\n"


def _head(spec: ModelSpec) -> Parts:
    picture = base64.b64encode(icon(spec.name)).decode("ascii")
    return [
        f"<h1>{escape(spec.name)}</h1><p>{escape(spec.help)}.</p>",
        f'<p><img alt="icon" width="120" height="120" src="data:image/png;base64,{picture}"></p>',
    ]


def _needs(target: str, platforms: Sequence[str]) -> Parts:
    needs = said.NEEDS[target].format(
        version=escape(package_version()), platforms=escape(", ".join(platforms))
    )
    hosts = table(("host", "state"), said.HOSTS[target])
    unsigned = said.UNSIGNED if target == "native" else ""
    return ["<h2>What it needs</h2>", needs, "<h2>Tested on, not tested on</h2>", hosts, unsigned]


def _variables(found: tuple[Variable, ...], causality: str) -> str:
    shown = [v for v in found if v.causality == causality]
    rows = [(v.name, _unit(v), _allowed(v), f"{v.start:g}", v.help) for v in shown]
    return (
        "<p>None.</p>" if not rows else table(("name", "unit", "allowed", "start", "meaning"), rows)
    )


def _outputs(found: tuple[Variable, ...]) -> str:
    outputs = [(v.name, _unit(v), v.help) for v in found if v.causality == "output"]
    return table(("name", "unit", "meaning"), outputs)


def _unit(v: Variable) -> str:
    return v.unit if v.type == "Real" else v.type_name or v.type


def _allowed(v: Variable) -> str:
    return f"{v.low:g} .. {v.high:g}" if v.low is not None and v.high is not None else ""


def _enumerations(spec: ModelSpec) -> str:
    found = enumerations(spec).items()
    rows = [(name, str(i.value), i.name, i.help) for name, items in found for i in items]
    return table(("enumeration", "number", "item", "meaning"), rows)


def _statuses() -> str:
    rows = [
        (str(int(s)), s.name, "failure" if s.is_failure else "advice" if s else "-", s.advice)
        for s in sorted(Status)
    ]
    head = ("solver_status", "name", "kind", "what it means, what to do")
    told = "<p>Advice comes with a solution and one warning; a failure with an error.</p>"
    return told + table(head, rows)


def _accuracy(spec: ModelSpec) -> Parts:
    card = CARDS.get(spec.name)
    if not card:
        return []
    rows = [(m.quantity, m.against, m.worst) for m in card]
    head = ("quantity", "measured against", "largest difference")
    return ["<h2>Accuracy</h2>", table(head, rows), f"<p>{escape(NOTE)}</p>"]


def _equations(readme: str) -> str:
    title, _, rest = readme.partition("\n")
    return markup(rest if title.startswith("# ") else readme, level=2)


def _origin(target: str, fmi: int, guid: str) -> Parts:
    version = escape(package_version())
    return [
        "<h2>Origin</h2>",
        f"<p>thrustwasher {version}, target {target}, FMI {fmi}.0 co-simulation, GUID {guid}. "
        "Licences of everything inside: the folder licenses beside this page.</p>",
    ]
