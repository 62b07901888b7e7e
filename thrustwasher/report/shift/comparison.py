"""Two shifts over each other: their plots, energies and key figures on one page."""

from collections.abc import Mapping, Sequence
from typing import Any

from ...units import format_quantity as say
from ..html import Page, Plot, Section, Table
from .shift_data import page_data
from .shift_report import SCRIPTS

NAMES = ("A", "B")
SAME = 1e-6  # relative difference that is none
Run = Mapping[str, Any]


def comparison_page(runs: Sequence[Run], pictures: Sequence[Any]) -> Page:
    """Return the page of two runs as ``run_data`` gives them; ``pictures``: each shift's overview.

    A picture is a figure or the content of a PNG.
    """
    named = list(zip(NAMES, runs, strict=True))
    stills = [
        Plot(f"overview_{name}", picture, f"{name}: {run['title']}", bitmap=True, still=True)
        for (name, run), picture in zip(named, pictures, strict=True)
    ]
    friction = [Section("friction", "Friction over slip", widgets=["slip"])]
    happened = [f"{name}: {' '.join(run['summary'])}" for name, run in named]
    return Page(
        title=" / ".join(f"{name}: {run['title']}" for name, run in named),
        subtitle=f"Scenes {runs[0]['name']} and {runs[1]['name']}, A drawn solid, B dashed; made "
        "by thrustwasher",
        warnings=[f"{name}: {text}" for name, run in named for text in run["warnings"]],
        sections=[
            Section("compared", "What is compared", tables=settings_tables(runs)),
            Section("said", "What happened", texts=happened),
            Section("course", "Both shifts over time", widgets=["plots"], plots=stills),
            *(friction if any(run["slip"] for run in runs) else []),
            Section("energy", "Energy", widgets=["flow"]),
            Section("key-figures", "Key figures", tables=[difference_table(runs)]),
        ],
        footer="One file, readable offline.",
        scripts=SCRIPTS,
        data=page_data(runs),
    )


ALWAYS = ("from", "scene", "communication step", "master", "rungs")


def settings_tables(runs: Sequence[Run]) -> list[Table]:
    """Return where both runs come from, how they were stepped, and which parameters differ."""
    ours, theirs = (run["settings"] for run in runs)
    rows = [(name, ours.get(name, ""), theirs.get(name, "")) for name in ours | theirs]
    differ = [row for row in rows if row[0] not in ALWAYS and row[1] != row[2]]
    head, title = ("", *NAMES), f"Parameters that differ: {len(differ)}"
    more = [Table(head, differ, title=title, folded=len(differ) > 12)] if differ else []
    return [Table(head, [row for row in rows if row[0] in ALWAYS]), *more]


def difference_table(runs: Sequence[Run]) -> Table:
    """Return the key figures of both runs, and by how much the second one is larger."""
    ours, theirs = ({f["name"]: f for f in run["figures"]} for run in runs)
    rows = []
    for name, figure in (theirs | ours).items():
        a, b = (found.get(name, {}).get("value") for found in (ours, theirs))
        if a or b:
            more = None if a is None or b is None else b - a if abs(b - a) > SAME * abs(b) else 0.0
            less = _words(figure, more, digits=3, difference=True)
            rows.append((figure["text"], _words(figure, a), _words(figure, b), less))
    return Table(("", *NAMES, "B less A"), rows, numbers=(1, 2, 3))


def _words(figure: Run, value: float | None, digits: int = 5, difference: bool = False) -> str:
    if value is None:
        return ""
    return say(value, figure["unit"], digits=digits, difference=difference or figure["difference"])
