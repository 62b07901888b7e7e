"""The report of a reducer: loss map, losses by source, safeties, lives, what limits it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...shown import text_of
from ...train.solve import hours
from ...train.train_map import train_map
from ...units import format_quantity as say
from .html import Card, Page, Plot, Section, Table
from .model_plots.reducer_plots import life_figure, loss_map_figure, source_figure
from .model_plots.train_plot import SOURCES
from .palette import RPM
from .scatter.study_data import Study

if TYPE_CHECKING:
    from ...train.train_file import TrainScene

GRID = 33  # torques and speeds of the map
BEYOND = 1.25  # times the operating point: the map of a reducer without [box]
NO_LIMIT = 1000.0  # what a safety is where no limit is given
LOW, HIGH = 0.05, 0.95
SAFETIES = {"pitting_safety": "pitting", "root_safety": "root", "scuffing_safety": "scuffing"}
MAP_TEXT = (
    "Lines of equal loss over speed and torque of the input, in W; numbers: operating points."
)
BAND_TEXT = "In brackets: 5 to 95 % of {} runs with the scatter of the inputs, point {}."
NO_BAND = "Without bands: the file has no [scatter]."
LIFE_TEXT = "Basic rating life L10h of ISO 281: nine of ten bearings reach it. Bars: 5 to 95 %."
LIMIT_TEXT = "The margin is a safety, or a life over the required one; the smallest limits first."


@dataclass(frozen=True)
class OperatingPoint:
    """A point of a report and what is there; ``study``: the scatter about it, if there is any."""

    inputs: Mapping[str, float]
    figures: Mapping[str, float]
    """By the names of the file [SI]."""
    study: Study | None = None

    @property
    def loss_share(self) -> float:
        """Loss over power in, NaN where nothing comes out."""
        efficiency = self.figures["efficiency"]
        return 1.0 - efficiency if efficiency > 0.0 else float("nan")

    def band(self, name: str) -> tuple[float, float] | None:
        """Return the 5 and 95 % quantile of a figure [SI]."""
        if self.study is None or name not in self.study.figures:
            return None
        quantiles = self.study.figures[name].quantiles
        return quantiles[LOW], quantiles[HIGH]

    def ending(self, end: str) -> dict[str, float]:
        """Return the figures of single meshes or bearings by the name of what they are of."""
        known = {n: x for n, x in self.figures.items() if n.endswith(end) and x is not None}
        own = {n.removesuffix(end).rstrip("._"): x for n, x in known.items() if n != end}
        return {n: x for n, x in own.items() if n and n != "bearing" and np.isfinite(x)}


def reducer_page(
    scene: "TrainScene",
    points: Sequence[Mapping[str, float]],
    *,
    study: Study | None = None,
    optimum: Any = None,
    progress: Any = None,
) -> Page:
    """Return the report of a reducer.

    Parameters
    ----------
    scene : of ``load_train``
    points : operating points, each torque [N m], speed [rad/s], oil_temperature [K]
    study : of the scatter about the first point
    optimum : what a search has found, whose design the scene is
    progress : called with points of the map done and in all
    """
    found = [_solved(scene, point, None if i else study) for i, point in enumerate(points)]
    first = found[0]
    whole = train_map(scene, **_axes(scene, points), progress=progress)
    places = [(p.inputs["torque"], p.inputs["speed"]) for p in found]
    limits = _limits(scene, found)
    names = [str(i) for i in range(1, len(found) + 1)]
    oil = say(first.inputs["oil_temperature"], "K")
    plots = [
        Plot("loss-map", loss_map_figure(whole, places), MAP_TEXT, tiles=2),
        Plot(
            "sources",
            source_figure(names, [p.figures for p in found]),
            "Losses of each operating point by source.",
            tiles=2,
        ),
    ]
    lives = first.ending("life")
    known = {n: band for n in lives if (band := first.band(_figure(first, n, "life")))}
    life = life_figure(lives, known, scene.part.params.required_life)
    note = BAND_TEXT.format(first.study.runs, 1) if first.study else NO_BAND
    warnings = dict.fromkeys((*scene.part.oil_warnings, *_doubts(scene, points)))
    sections = [
        *([_design_section(optimum)] if optimum else []),
        Section("points", "Operating points", tables=[_point_table(found)]),
        Section("losses", "Losses by source", tables=_loss_tables(found)),
        Section("safeties", "Safeties", texts=[note], tables=[_safety_table(found)]),
        Section(
            "lives",
            "Lives",
            texts=[LIFE_TEXT],
            plots=[Plot("life", life, "Lives at operating point 1.", tiles=2)],
            tables=[_life_table(found)],
        ),
        Section("limits", "What limits", texts=[LIMIT_TEXT], tables=[_limit_table(limits)]),
        *_scatter_section(first),
    ]
    return Page(
        title=scene.title,
        subtitle=f"Gear train, oil {oil}, made by thrustwasher",
        summary=[_sentence(first, limits)],
        warnings=list(warnings),
        cards=_cards(first),
        first=Section("map", "Loss map", plots=plots),
        sections=sections,
        footer="One file, readable offline. Rigid shafts; load factors stand for tooth dynamics.",
    )


def _map_at(scene: "TrainScene", point: Mapping[str, float]) -> Any:
    torque, speed, oil = ([point[name]] for name in ("torque", "speed", "oil_temperature"))
    return train_map(scene, torque, speed, oil)


def _solved(scene: "TrainScene", point: Mapping[str, float], study: Study | None) -> OperatingPoint:
    found = _map_at(scene, point)
    figures = {name: float(column[0]) for name, column in found.columns.items()}
    return OperatingPoint(dict(point), figures, study)


def _axes(scene: "TrainScene", points: Sequence[Mapping[str, float]]) -> dict[str, Any]:
    """Return torques and speeds of the map: the box, speeds of one sign; one oil temperature."""
    axes: dict[str, Any] = {"oil_temperature": [points[0]["oil_temperature"]]}
    for name in ("torque", "speed"):
        most = max(abs(p[name]) for p in points) or 1.0
        low, high = scene.part.box.get(name, (0.0, BEYOND * most))
        high = max(high, most)
        backwards = any(p[name] < 0.0 for p in points)
        if name == "speed" or not backwards:
            low = high / GRID if low <= 0.0 else low
        axes[name] = np.linspace(min(low, *(p[name] for p in points)), high, GRID).tolist()
    return axes


def _doubts(scene: "TrainScene", points: Sequence[Mapping[str, float]]) -> list[str]:
    found = []
    for number, point in enumerate(points, 1):
        lines = _map_at(scene, point).doubts[0]
        found += [f"Point {number}: {text}" for text in lines]
    return found


def _figure(point: OperatingPoint, of: str, end: str) -> str:
    """Return the column of a mesh's or bearing's figure, "" where it has none."""
    return next((n for n in point.figures if n.removesuffix(end).rstrip("._") == of), "")


def _rpm(speed: float) -> str:
    value = RPM * speed
    return f"{value:.0f} rpm" if abs(value) >= 100.0 else f"{value:.3g} rpm"


def _percent(share: float) -> str:
    return f"{100.0 * share:.3g} %" if np.isfinite(share) else "no power comes out"


def _limits(
    scene: "TrainScene", found: Sequence[OperatingPoint]
) -> list[tuple[float, str, str, int]]:
    """Return margin, what it is of, its value in words and the point; the smallest first."""
    rows, required = [], scene.part.params.required_life
    for number, point in enumerate(found, 1):
        for end, words in SAFETIES.items():
            for of, value in point.ending(end).items():
                if value < NO_LIMIT:
                    rows.append((value, f"{of}: {words}", f"{value:.3g}", number))
        for of, life in point.ending("life").items():
            if required > 0.0:
                rows.append((life / required, f"{of}: life", hours(life), number))
    return sorted(rows)


def _sentence(first: OperatingPoint, limits: Sequence[tuple[float, str, str, int]]) -> str:
    torque, speed = say(first.inputs["torque"], "N.m"), _rpm(first.inputs["speed"])
    lost = f"At {torque} and {speed} it loses {_percent(first.loss_share)} of the power in."
    lives = first.ending("life")
    weakest = min(lives, key=lambda name: lives[name])
    text = f"{lost} The weakest bearing is {weakest} with {hours(lives[weakest])}."
    if limits:
        margin, what, _, number = limits[0]
        text += f" What limits: {what}, margin {margin:.3g} at point {number}."
    return text


def _cards(first: OperatingPoint) -> list[Card]:
    lives = first.ending("life")
    weakest = min(lives, key=lambda name: lives[name])
    cards = [
        Card("loss, of the power in", _percent(first.loss_share), _span(first, "efficiency")),
        Card("loss", say(first.figures["loss"], "W", digits=3), _span(first, "loss")),
        Card(
            f"life L10h, {weakest}",
            hours(lives[weakest]),
            _span(first, _figure(first, weakest, "life")),
        ),
    ]
    for name, words in SAFETIES.items():
        least = first.figures.get(name, NO_LIMIT)  # absent where no mesh has its limit
        if least < NO_LIMIT:
            cards.append(Card(f"minimum {words} safety", f"{least:.3g}", _span(first, name)))
    return cards


def _span(point: OperatingPoint, name: str) -> str:
    """Return the band of a figure in words, "" without one."""
    band = point.band(name)
    if band is None:
        return ""
    low, high = band
    if name == "efficiency":
        return f"5 .. 95 %: {100 * (1 - high):.3g} .. {100 * (1 - low):.3g} %"
    if name.endswith("life"):
        return f"5 .. 95 %: {low / 3600.0:.0f} .. {high / 3600.0:.0f} h"
    if name == "loss":
        return f"5 .. 95 %: {say(low, 'W', digits=3)} .. {say(high, 'W', digits=3)}"
    return f"5 .. 95 %: {low:.3g} .. {high:.3g}"


def _point_table(found: Sequence[OperatingPoint]) -> Table:
    heads = ["point", "torque", "speed", "oil temperature", "output torque", "output speed"]
    rows = [
        [
            str(i),
            say(p.inputs["torque"], "N.m"),
            _rpm(p.inputs["speed"]),
            say(p.inputs["oil_temperature"], "K"),
            say(p.figures["output_torque"], "N.m"),
            _rpm(p.figures["output_speed"]),
            _percent(p.loss_share),
            say(p.figures["loss"], "W", digits=4),
        ]
        for i, p in enumerate(found, 1)
    ]
    return Table([*heads, "loss of the power", "loss"], rows, range(1, 8))


def _loss_tables(found: Sequence[OperatingPoint]) -> list[Table]:
    """Return the losses by source, which add up, and those of single meshes and bearings."""
    heads = [f"point {i}" for i in range(1, len(found) + 1)]
    whole = {name.removesuffix("_loss") for name in SOURCES}
    single = [name for name in found[0].ending("loss") if name not in whole]
    sources = [
        [words, *(_part_of(p.figures[name], p.figures["loss"]) for p in found)]
        for name, (words, _) in SOURCES.items()
    ]
    parts = [
        [name, *(_part_of(p.ending("loss")[name], p.figures["loss"]) for p in found)]
        for name in single
    ]
    numbers = range(1, len(heads) + 1)
    return [
        Table(["source", *heads], sources, numbers),
        Table(["mesh, bearing", *heads], parts, numbers),
    ]


def _part_of(loss: float, whole: float) -> str:
    share = f" ({100.0 * loss / whole:.1f} %)" if whole > 0.0 else ""
    return say(loss, "W", digits=3) + share


def _safety_table(found: Sequence[OperatingPoint]) -> Table:
    heads = ["mesh", *(f"{w}, {i}" for i in range(1, len(found) + 1) for w in SAFETIES.values())]
    rows = []
    for mesh in found[0].ending("pitting_safety"):
        row = [mesh]
        for point in found:
            for end in SAFETIES:
                value = point.ending(end).get(mesh, np.nan)
                span = _span(point, _figure(point, mesh, end)).partition(": ")[2]
                text = f"{value:.3g}" if value < NO_LIMIT else "no limit given"
                row.append(f"{text} ({span})" if span and value < NO_LIMIT else text)
        rows.append(row)
    return Table(heads, rows, range(1, len(heads)))


def _life_table(found: Sequence[OperatingPoint]) -> Table:
    heads = ["bearing", *(f"life, {i} [h]" for i in range(1, len(found) + 1)), "band of 1 [h]"]
    first, rows = found[0], []
    for name in first.ending("life"):
        lives = [f"{p.ending('life')[name] / 3600.0:.0f}" for p in found]
        span = _span(first, _figure(first, name, "life")).partition(": ")[2].removesuffix(" h")
        rows.append([name, *lives, span])
    return Table(heads, rows, range(1, len(heads)))


def _limit_table(limits: Sequence[tuple[float, str, str, int]]) -> Table:
    rows = [[what, value, f"{margin:.3g}", str(at)] for margin, what, value, at in limits[:12]]
    return Table(["limit", "value", "margin", "point"], rows, range(1, 4))


def _design_section(optimum: Any) -> Section:
    """Return what a search has changed."""
    from .model_plots.optimum_plot import optimum_figure

    problem, best = optimum.problem, optimum.best
    rows = [
        [v.name, v.text(float(v.nominal)), v.text(best.values[v.name])] for v in problem.variables
    ]
    rows += [
        [f.name, optimum.before(f), text_of(best.figures[f.name], f.unit, f.relative, 4)]
        for f in problem.every_figure
    ]
    texts = [
        f"{', '.join([*(g.words for g in problem.goals), *(x.words for x in problem.limits)])}."
    ]
    if optimum.binding:
        texts.append(f"What binds: {', '.join(optimum.binding)}.")
    table = Table(["", "before", "best"], rows, (1, 2))
    plot = Plot("designs", optimum_figure(optimum), "All designs tried, and the result.", tiles=2)
    return Section("design", "Design", texts=texts, plots=[plot], tables=[table])


def _scatter_section(first: OperatingPoint) -> list[Section]:
    if first.study is None:
        return []
    from .scatter.study_page import source_section

    return [source_section(first.study)]
