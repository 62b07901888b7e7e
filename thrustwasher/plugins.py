"""What lies above the core and is called from it: the one list.

Models, FMUs and shifts run without reports, pages, plots, sweeps, studies and fits. What they, or
their commands, call of these they name here; it is imported when it is used. Where its folder is
missing, ``EnvironmentProblem`` says so in one line.
"""

from importlib import import_module
from types import ModuleType
from typing import Any

from .errors import EnvironmentProblem

PLOT, STUDY = "--plot", "a study of scatter"
REPORT = "the report (a run without one: --no-report)"
# Command -> its module.
COMMANDS = {
    "calibrate": "thrustwasher.studio.commands.calibrate",
    "explore": "thrustwasher.studio.commands.explore",
    "efficiency": "thrustwasher.studio.commands.efficiency",
    "compare": "thrustwasher.studio.commands.compare",
    "sweep": "thrustwasher.studio.commands.sweep",
    "optimise": "thrustwasher.studio.commands.optimise",
    "scatter": "thrustwasher.studio.commands.scatter",
    "fidelity": "thrustwasher.studio.commands.fidelity",
}
# Name -> where it is, and in words what it is for.
CALLED = {
    "figure_of": ("thrustwasher.studio.report.result_plots:figure_of", "a plot"),
    "point_figures": ("thrustwasher.studio.report.model_plots:FIGURES", PLOT),
    "ranking_figure": ("thrustwasher.studio.report.model_plots:ranking_figure", PLOT),
    "curve_figure": ("thrustwasher.studio.report.model_plots.washer_plots:curve_figure", PLOT),
    "engagement_figure": (
        "thrustwasher.studio.report.model_plots.clutch_plot:engagement_figure",
        PLOT,
    ),
    "load_report": ("thrustwasher.studio.commands._shift_report:load", REPORT),
    "write_report": ("thrustwasher.studio.commands._shift_report:write", REPORT),
    "write_reducer_report": (
        "thrustwasher.studio.commands._reducer_report:write",
        "--report of a gear train",
    ),
    "shown_progress": ("thrustwasher.studio.jobs.progress:shown", "progress = True"),
    "runs_of_study": ("thrustwasher.studio.scatter.propagate:runs_of_study", STUDY),
    "propagate": ("thrustwasher.studio.scatter.propagate:propagate", STUDY),
    "kept_runs": ("thrustwasher.studio.commands.scatter:kept_runs", STUDY),
    "write_study": ("thrustwasher.studio.commands.scatter:write_files", STUDY),
    "say_study": ("thrustwasher.studio.commands.scatter:say", STUDY),
    "scene_sensitivities": (
        "thrustwasher.studio.scatter.scene_sensitivities:scene_sensitivities",
        "--sensitivities of a shift",
    ),
}


def command(name: str) -> ModuleType:
    """Return the module of a command."""
    return _module(COMMANDS[name], f"the command {name}")


def called(name: str) -> Any:
    """Return what is called by this name."""
    where, words = CALLED[name]
    module, _, attribute = where.partition(":")
    return getattr(_module(module, words), attribute)


def _module(name: str, words: str) -> ModuleType:
    try:
        return import_module(name)
    except ModuleNotFoundError as problem:
        if problem.name and f"{name}.".startswith(f"{problem.name}."):  # it, or its folder
            folder = ".".join(name.split(".")[:2])
            text = f"{words} is part of {folder}, which is missing here"
            raise EnvironmentProblem(text) from None
        raise
