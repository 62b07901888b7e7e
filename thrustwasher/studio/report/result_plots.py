"""The picture of a result, by its class: what ``plot()`` of results returns."""

from collections.abc import Callable, Sequence
from inspect import signature
from typing import Any

from matplotlib.figure import Figure

from ...errors import ParameterError
from ...shift.account.shift_record import record_of
from .model_plots import FIGURES
from .model_plots.clutch_plot import engagement_figure
from .model_plots.comparison_plot import comparison_figure
from .model_plots.efficiency_plot import efficiency_figure
from .model_plots.fit_plot import calibration_figure
from .model_plots.optimum_plot import optimum_figure
from .model_plots.sweep_plot import sweep_figure
from .model_plots.trace_plot import trace_figure
from .model_plots.washer_plots import curve_figure, history_figure
from .scatter.scatter_plots import study_figure
from .scatter.study_page import main_figures
from .shift.overview_plot import SHOWN, overview_figure
from .shift.sequence_report import sequence_figure
from .target import chosen, drawn_on

MOST_DISTRIBUTIONS = 6


def _point_figure(result: Any) -> Figure:
    """Return the picture of a result at an operating point, as ``--plot`` of its command draws."""
    key, params, point = result.request()
    inputs = {name: value for name, value in point.items() if name != "fidelity"}
    return FIGURES[key](result, inputs, params)


def _load_figure(curve: Any, *, outputs: str | Sequence[str] = ()) -> Figure:
    first = curve.points[0]
    point = {n: getattr(first, n) for n in ("speed", "tilt", "oil_temperature")}
    return curve_figure(curve, point, outputs)


def _study_figure(result: Any, *, outputs: str | Sequence[str] = ()) -> Figure:
    there = [name for name in result.figures if name in result.sample]
    names = chosen("outputs", outputs, there)
    names = names or [n for n in main_figures(result, MOST_DISTRIBUTIONS) if n in there]
    if not names:
        raise ParameterError(f"{result.target}: no figure of this study scatters: nothing to draw")
    return study_figure(result, names)


def _shift_figure(result: Any, *, panels: str | Sequence[str] = SHOWN) -> Figure:
    return overview_figure(record_of(result, result.scatter), panels)


# By the name of a class, so that drawing one result loads none of the others.
FIGURE_OF: dict[str, Callable[..., Figure]] = {
    "AtPoint": _point_figure,
    "Calibration": calibration_figure,
    "Comparison": comparison_figure,
    "EfficiencyMap": efficiency_figure,
    "Engagement": engagement_figure,
    "LoadCurve": _load_figure,
    "Optimum": optimum_figure,
    "ScatterResult": _study_figure,
    "SequenceResult": sequence_figure,
    "ShiftResult": _shift_figure,
    "SweepTable": sweep_figure,
    "TrainMap": efficiency_figure,
    "TraceCalibration": trace_figure,
    "WasherHistory": history_figure,
}


def figure_of(result: object, ax: object = None, fig: object = None, **options: object) -> Any:
    """Return the picture of a result, or the caller's axes or figure that it was drawn on."""
    kinds = (kind.__name__ for kind in type(result).__mro__)
    draw = next(FIGURE_OF[kind] for kind in kinds if kind in FIGURE_OF)
    known = list(signature(draw).parameters.values())[1:]
    names = [p.name for p in known if p.kind is p.KEYWORD_ONLY]
    if not any(p.kind is p.VAR_KEYWORD for p in known):
        for name in options:
            if name not in names:
                allowed = ", ".join(["ax", "fig", *names])
                raise ParameterError(f"plot({name}=..): no such option, allowed: {allowed}")
    with drawn_on(ax, fig):
        figure = draw(result, **options)
    return figure if ax is None else ax
