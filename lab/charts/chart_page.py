"""All charts as one page, as Markdown, and as drawings; made from the JSON record alone."""

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from lab.charts import chart_text as text
from lab.charts.chart_cost import cost_figure, count_figure, mark_of
from lab.macro_steps import WAYS
from thrustwasher.model.registry import find_spec
from thrustwasher.model.toml_tables import table_beside
from thrustwasher.studio.report.html import Page, Plot, Section, Table
from thrustwasher.studio.report.palette import BLUE, GREY
from thrustwasher.studio.report.style import label, new_figure, styled
from thrustwasher.templates import template

TITLE = "Speed against accuracy"
SAME_EVERYWHERE = Path(__file__).with_name("same_everywhere.json")
WORDS = {
    "ok": "correct",
    "slow": "correct, but costly",
    "says": "fails and reports it",
    "LIES": "silently wrong",
}
LABELS = {"ok": "ok", "slow": "slow", "says": "reported", "LIES": "**wrong**", "-": "-"}
SCRIPTS = ("chart.css", "chart.js")
OF_PACKS = "--fidelity clutch={level} --fidelity brake={level}"
OPTIONS = {  # of commands, by what changes along a series
    "level": "--fidelity {value}",
    "grid": "--grid {value}",
    "step": '--fidelity {level} --step "{value}"',
    "macro step": f'--step "{{value}}" {OF_PACKS}',
}
HOW = (
    "Errors are measured against converged values on a fixed list of operating points with the "
    "hard corners in it, times on warm calls one per cent away; filled marks are the worst case, "
    "hollow ones the root mean square. Crosses are failures. Points in the grey band cannot be "
    "told apart."
)


def sections(record: Mapping[str, Any], fronts: Mapping[str, Any]) -> list[Section]:
    """Return the chapters of what was measured."""
    found = [_model_section(model, s, fronts[model]) for model, s in record["models"].items()]
    if "macro_steps" in record:
        found.append(_steps_section(record["macro_steps"], fronts["macro_steps"]))
    if "corrections" in record:
        found.append(corrections_section(record["corrections"]))
    if "stability" in record:
        found.append(_stability_section(record["stability"]))
    return found


def _stability_section(groups: Sequence[Mapping[str, Any]]) -> Section:
    heads = ["method", "hazard", "verdict", "figure", "in words"]
    rows = [
        [method, hazard, cell["verdict"], cell["figure"], cell["words"]]
        for g in groups
        for method, row in zip(g["methods"], g["cells"], strict=True)
        for hazard, cell in zip(g["hazards"], row, strict=True)
    ]
    lies = sum(row[2] == "LIES" for row in rows)
    words = (
        f"Each cell was run: {lies} of {len(rows)} results are silently wrong. Most methods are "
        "small ones written for this comparison; the package's own are named so."
    )
    return Section(
        "stability",
        "Where methods fail",
        widgets=["map"],
        texts=[words],
        tables=[Table(heads, rows, title="All cells", folded=True)],
    )


def _points(study: Mapping[str, Any], model: str) -> dict[str, list[list[str]]]:
    """Return the words of every mark in a study's drawing: way, errors, worst case, command."""
    found: dict[str, list[list[str]]] = {}
    levels = find_spec(model).levels if "cases" in study else {}
    per = "a call" if levels else "a simulated second"
    for q in study["quantities"]:
        for s in study["samples"]:
            errors = s["errors"].get(q["name"], {})
            if s["call_median"] and errors.get("worst") is not None:
                words = [
                    f"{s['family']}: {s['label']}",
                    f"{q['name']}: worst {text.error_text(errors['worst'], q)}, rms "
                    f"{text.error_text(errors['rms'], q)}",
                    f"{text.seconds(s['call_median'])} {per}, fails in {s['n_failed']} of "
                    f"{s['n_cases']} cases",
                    f"worst case: {study.get('scene', errors['case'])}",
                    *command_lines(study, model, s, errors["case"]),
                ]
                if s["knob"] == "level":
                    words.insert(1, f"{s['value']}: {levels.get(s['value'], '')}")
                found.setdefault(mark_of(q["name"], s["family"]), []).append(words)
    return found


def command_lines(
    study: Mapping[str, Any], model: str, sample: Mapping[str, Any], worst: str
) -> list[str]:
    """Return the command that solves the worst case this way, else what reproduces it."""
    given = table_beside(__file__, "cases.toml")[model]
    case = next((c for c in study.get("cases", ()) if c["name"] == worst), None)
    way = next((w for w in WAYS if w.name == sample["family"]), None)
    values = {"level": sample["label"].partition(",")[0], "value": sample["value"]}
    if case and not sample["is_rival"]:
        values |= dict(zip((s.name for s in find_spec(model).inputs), case["point"], strict=False))
        values["power"] = values["load"] * values["speed"]
    elif way and way.coupling == "capacity" and way.extrapolation:
        values |= {"level": way.level, "master": way.master}
    else:
        return [f"no command goes this way; reproduced by: {given['without']}"]
    template = (
        f"{given['command']} {given.get('more', {}).get(worst, '')} {OPTIONS[sample['knob']]}"
    )
    note = [f"note: {given['note']}"] if "note" in given else []
    return [f"command: thrustwasher {' '.join(template.format(**values).split())}", *note]


def _data(record: Mapping[str, Any]) -> dict[str, Any]:
    """Return what the page's script tells of marks and cells."""
    points: dict[str, Any] = {}
    for model, survey in record["models"].items():
        points[f"chart-{model}"] = points[f"chart-{model}-count"] = _points(survey, model)
    if "macro_steps" in record:
        points["chart-shift"] = _points(record["macro_steps"], "shift")
    return {"points": points, "stability": record.get("stability", []), "verdicts": WORDS}


def _steps_section(study: Mapping[str, Any], fronts: Mapping[str, Sequence[int]]) -> Section:
    heads = [
        "way",
        "step",
        "wall time per simulated second",
        *(q["name"] for q in study["quantities"]),
        "what was wrong",
    ]
    rows = [
        [
            s["family"],
            s["value"],
            text.seconds(s["call_median"]),
            *(text.error_text(s["errors"][q["name"]]["worst"], q) for q in study["quantities"]),
            "; ".join(s["failures"].values()),
        ]
        for s in study["samples"]
    ]
    words = (
        f"The scene is {study['scene']}. Errors are those of quantities that a shift does not "
        "forget, against the limit that gauss-seidel and jacobi tend to. Where friction torques "
        "are handed over, H T/(J w) is "
        "34 for each ms of step H, with the clutch's torque T at lock-up, its smoothing w and "
        "the inertia J that it sees: held torques are stable below 2, without oscillation "
        "below 1, late ones below 1 and 1/4."
    )
    caption = (
        "Each line goes from large steps to small ones. Red crosses: the run ended silently, "
        "but chatters or does not lock."
    )
    return Section(
        "macro-steps",
        "A shift: error against cost over step, master, coupling and fidelity level",
        texts=[words, *text.order_sentences(study)],
        plots=[Plot("chart-shift", cost_figure("", study, fronts, heads[2]), caption)],
        tables=[Table(heads, rows, numbers=(2, 3, 4, 5), title="All runs", folded=True)],
    )


def _model_section(
    model: str, survey: Mapping[str, Any], fronts: Mapping[str, Sequence[int]]
) -> Section:
    texts = [text.verdict(survey, fronts[q["name"]], q) for q in survey["quantities"]]
    texts += text.failure_sentences(survey)
    heads, rows = text.sample_rows(survey)
    even_heads, even_rows = text.break_even_rows(survey, "field")
    cases = [[c["name"], ", ".join(f"{v:g}" for v in c["point"])] for c in survey["cases"]]
    figure = cost_figure(f"{model}: ", survey, fronts, survey["cost_of"])
    count_caption = "The same errors over counts that need no machine."
    return Section(
        model,
        f"{model}: error against cost",
        texts=[t for t in texts if t],
        plots=[
            Plot(f"chart-{model}", figure, HOW),
            Plot(f"chart-{model}-count", count_figure(model, survey), count_caption),
        ],
        tables=[
            Table(heads, rows, (1, 2, 3, 5), title="All samples (! : spread above 10 %)"),
            Table(even_heads, even_rows, (1, 2, 3, 4), title="What set-up is worth"),
            Table(("case", "inputs"), cases, title="Cases", folded=True),
        ],
    )


def corrections_section(rows: Sequence[Mapping[str, Any]]) -> Section:
    """Return what the corrections of the physics moved, and by which factor."""
    table = [
        [
            r["part"],
            r["figure"],
            r["unit"],
            f"{r['before']:.3g}{'*' if r['recorded'] else ''}",
            f"{r['after']:.3g}",
            f"{r['after'] / r['before']:.2g}",
        ]
        for r in rows
    ]
    heads = ["correction", "figure", "unit", "before", "after", "times"]
    words = (
        'Before is the preset "paper" of a model or the former scene, computed now; * is what '
        "version 0.5.0 gave. The two scenes are two shifts: their figures differ by design."
    )
    caption = "After over before: bars to the right grew, bars to the left shrank."
    return Section(
        "corrections",
        "What the corrections moved",
        texts=[words],
        plots=[Plot("chart-corrections", corrections_figure(rows), caption)],
        tables=[Table(heads, table, numbers=(3, 4, 5))],
    )


@styled
def corrections_figure(rows: Sequence[Mapping[str, Any]]) -> Figure:
    """Return a bar for each figure: after over before, on a logarithmic axis."""
    figure, (axes,) = new_figure(9.0, 1.4 + 0.25 * len(rows), left=3.3)
    times = [r["after"] / r["before"] for r in rows]
    colours = [GREY if r["part"].startswith("default scene") else BLUE for r in rows]
    places = list(range(len(rows)))
    axes.barh(places, [t - 1.0 for t in times], left=1.0, color=colours, height=0.7)
    axes.set(xscale="log")
    axes.set_yticks(places, [f"{r['part'].partition(':')[0]}: {r['figure']}" for r in rows])
    axes.invert_yaxis()
    axes.axvline(1.0, color="black", lw=0.8)
    label(axes, "", "after over before", "")
    return figure


def page_of(record: Mapping[str, Any], fronts: Mapping[str, Any]) -> Page:
    """Return the whole page."""
    warnings = []
    if (record["machine"]["load"] or 0.0) > 0.5 * record["machine"]["cores"]:
        warnings.append("The machine was busy when this was measured: compare ratios, no seconds.")
    if record["quick"]:
        warnings.append("A quick look: few cases and repeats, coarser reference values.")
    return Page(
        title=TITLE,
        subtitle="how far each way to solve the models is off, and what a call of it costs",
        summary=[HOW],
        warnings=warnings,
        cards=[],
        sections=sections(record, fronts),
        footer=text.machine_sentence(record),
        scripts=SCRIPTS,
        data=_data(record),
    )


def markdown(page: Page) -> Any:
    """Return the page as Markdown next to its drawings."""
    return template(Path(__file__).with_name("chart.md.jinja")).render(vars(page))


def same_everywhere() -> dict[str, Any]:
    """Return what ``lab/benchmarks/same_everywhere.py`` measured: no machine changes it."""
    return dict(json.loads(SAME_EVERYWHERE.read_text("utf-8")))


def _worst(figures: Sequence[str]) -> str:
    """Return figures that are words, and the largest of those that are numbers."""

    def size(figure: str) -> float:
        number = re.search(r"\d[\d.]*(?:e[+-]?\d+)?", figure)
        return (1.0 if "%" in figure else 100.0) * float(number[0]) if number else -1.0

    words = sorted({figure for figure in figures if size(figure) < 0.0})
    numbers = sorted({figure for figure in figures if size(figure) >= 0.0}, key=size)
    to = "to " if len(numbers) > 1 else ""
    return " or ".join(words + [to + one for one in numbers[-1:]])


def _verdicts(hazards: Sequence[str], row: Sequence[Mapping[str, Any]]) -> str:
    """Return what a method gives where it is not ok, the largest figure and the hazards."""
    named: dict[str, list[tuple[str, str]]] = {}
    for hazard, cell in zip(hazards, row, strict=True):
        if cell["verdict"] == "ok":
            continue
        label = LABELS[cell["verdict"]] if cell["verdict"] != "-" else "does not apply"
        status = cell["words"].split(":")[0] if cell["verdict"] == "says" else ""
        named.setdefault(label, []).append((cell["figure"] or status, hazard))
    parts = []
    for label, found in named.items():
        words = f"{label} {_worst([figure for figure, _ in found])}".strip()
        where = "; ".join(hazard for _, hazard in found)
        if len(found) == len(hazards):
            where = "every case"
        elif len(found) > 3 or (label == LABELS["slow"] and len(found) > 1):
            where = f"{len(found)} cases"
        parts.append(f"{words} ({where})")
    return "; ".join(parts)


def _notes(group: Mapping[str, Any]) -> list[str]:
    """Return a line for all methods of a group that give the same."""
    methods: dict[str, list[str]] = {}
    before = ""
    for method, row in zip(group["methods"], group["cells"], strict=True):
        name = method.replace("the same", before) if method.startswith("the same") else method
        methods.setdefault(_verdicts(group["hazards"], row), []).append(name)
        before = name
    right = "; ".join(methods.pop("", []))
    lines = [f"{'; '.join(names)}: {words}" for words, names in methods.items()]
    return lines + ([f"ok in every case: {right}"] if right else [])


def stability_markdown(record: Mapping[str, Any]) -> Any:
    """Return the page for a record with ``stability`` and ``limits``."""
    groups: Sequence[Mapping[str, Any]] = record["stability"]
    return template(Path(__file__).with_name("stability.md.jinja")).render(
        words=WORDS,
        labels=LABELS,
        groups=groups,
        notes=_notes,
        limits=record.get("limits", []),
        verdicts=[cell["verdict"] for g in groups for row in g["cells"] for cell in row],
        machine=text.machine_sentence(record),
    )
