"""A gear shift: parts that run together through FMI.

==================  =========================================================================
``account``         what is said of a finished shift: its record, sentences, warnings
``checks``          what a finished run is worth: its step, its steady washers
``cosim``           connected instances and the loop over communication points
``from_fmus``       a scene run from FMUs of its own: built, freed
``key_figures``     what is read from the signals of a finished shift
``masters``         co-simulation masters
``oscillation``     oscillations, and whether they are the driveline's or the master's
``run``             living instances of a scene: connect, step to the end, read the result
``scene``           what is simulated
``several_shifts``  several shifts in one run, with long steps between them
``shift_result``    what a run leaves: time series, events, key figures, cost
``steady_points``   efficiency and losses in a gear, nothing accelerating
``ssp``             a shift as an SSP 1.0 package, for any SSP master
``expressions``     expressions over a run, for Python and for pages
``warning_texts``   a shift's warnings by ``warnings.toml``, for Python and for pages
``whole_shift``     a shift from its scene alone
``tolerance``       a shift with the cheapest levels that hold a tolerance
``sequence_rows``   what a run of several shifts keeps of its points
==================  =========================================================================
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .key_figures.events_and_phases import Event, Phase
    from .key_figures.figure_list import FIGURES, KeyFigure
    from .run import cosimulate
    from .scene.scene import Part, Published, Scene, with_fidelities
    from .scene.scene_file import builtin_scenes, load_scene
    from .several_shifts import SequenceResult, run_sequence
    from .shift_result import Cost, ShiftResult
    from .tolerance.run_to_tolerance import run_auto
    from .whole_shift import run_shift

_HOMES = {
    "key_figures.events_and_phases": ("Event", "Phase"),
    "key_figures.figure_list": ("FIGURES", "KeyFigure"),
    "run": ("cosimulate",),
    "scene.scene": ("Part", "Published", "Scene", "with_fidelities"),
    "scene.scene_file": ("builtin_scenes", "load_scene"),
    "several_shifts": ("SequenceResult", "run_sequence"),
    "shift_result": ("Cost", "ShiftResult"),
    "tolerance.run_to_tolerance": ("run_auto",),
    "whole_shift": ("run_shift",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}
__all__ = [
    "FIGURES",
    "Cost",
    "Event",
    "KeyFigure",
    "Part",
    "Phase",
    "Published",
    "Scene",
    "SequenceResult",
    "ShiftResult",
    "builtin_scenes",
    "cosimulate",
    "load_scene",
    "run_auto",
    "run_sequence",
    "run_shift",
    "with_fidelities",
]


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: its parts can be had without the whole."""
    if name not in _HOME_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_HOME_OF[name]}", __name__), name)


def __dir__() -> list[str]:
    return sorted(__all__)
