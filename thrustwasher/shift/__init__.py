"""A gear shift: parts that run together through FMI.

================  ===============================================================================
``cosim``         Co-simulation: connected instances and the loop over communication points
``key_figures``   What is read from the signals of a finished shift
``masters``       Co-simulation masters
``oscillation``   Oscillations of a shift, and whether they are the driveline's or the master's
``run``           Run a shift: connect the instances of a scene, step them to the end, and read
                  the result
``scene``         What is simulated
``shift_result``  What a shift run leaves: time series, events, energy balance, key figures, cost
``ssp``           A shift as a System Structure and Parameterization (SSP 1.0) package, for any
                  SSP master
``thermal_need``  Which thermal mode the washer of a scene needs: its time constants beside the
                  scene's
``tolerance``     A shift with the cheapest rungs that hold a tolerance
================  ===============================================================================
"""

from .key_figures.events_and_phases import Event, Phase
from .key_figures.figure_list import FIGURES, KeyFigure
from .run import run_shift
from .scene.fidelity_option import with_fidelities
from .scene.scene import Part, Published, Scene
from .scene.scene_file import builtin_scenes, load_scene
from .shift_result import Cost, ShiftResult
from .tolerance.run_to_tolerance import run_auto

__all__ = [
    "FIGURES", "Cost", "Event", "KeyFigure", "Part", "Phase", "Published", "Scene", "ShiftResult",
    "builtin_scenes", "load_scene", "run_auto", "run_shift", "with_fidelities",
]  # fmt: skip
