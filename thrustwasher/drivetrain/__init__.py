"""Scenes, connected instances, masters and what a shift run leaves.

=================  ================================================================================
``scene``          what is simulated: scenes, their files (``scenes/``), connections
``cosim``          connected instances and the loop over communication points
``masters``        who steps when, with which inputs
``run``            ``run_shift``: one run, and the result
``result``         ``ShiftResult``
``key_figures``    events, phases, energy balance and key figures of a run
``oscillation``    judder and chatter
``thermal_need``   which thermal mode the washer of a scene needs
``tolerance``      ``run_auto``: rungs chosen for a tolerance, checked after the run
``ssp``            a shift as a package for other tools
``macro_steps``    a study: error, cost and failures over step, master and coupling
=================  ================================================================================
"""

from .key_figures.events_and_phases import Event, Phase
from .key_figures.figure_list import FIGURES, KeyFigure
from .result import Cost, ShiftResult
from .run import run_shift
from .scene.fidelity_option import with_fidelities
from .scene.scene import Part, Published, Scene
from .scene.scene_file import builtin_scenes, load_scene
from .tolerance.run_to_tolerance import run_auto

__all__ = [
    "FIGURES", "Cost", "Event", "KeyFigure", "Part", "Phase", "Published", "Scene", "ShiftResult",
    "builtin_scenes", "load_scene", "run_auto", "run_shift", "with_fidelities",
]  # fmt: skip
