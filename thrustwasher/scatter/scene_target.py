"""A gear shift as what a study runs: figures, outcomes and signals over time at other inputs.

**Costly** figures are those of the washers: ``target.costly``; with them, in runs that do not ask
for them, the outcome ``film_lost`` and the series ``washer.*`` are NaN. NaN in a run with code 0
says that this run has no such figure: a shift that does not lock has no lock-up time.

The shortcut of ``scene_runs`` is compared with full runs when the target is made:
``target.shortcut`` has its largest error by figure, ``target.warnings`` says it. Where it errs by
more than a tenth of a figure's band all runs are full ones; then nothing is costly.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, SolveError, suggestion
from ..fmu.fmu_cache import fmu_paths
from ..fmu.stepper import Instance
from ..model.scatter import Scatter
from ..processes import usable_cores
from ..report.shift.usual import ranges
from ..shift.checks.step_error import recorded_parts, step_error
from ..shift.key_figures.events_and_phases import find_events, turning
from ..shift.key_figures.figure_list import FIGURES, KeyFigure
from ..shift.key_figures.key_figures import key_figures
from ..shift.run import run_shift
from ..shift.scene.connections import DIRECT, MESHES
from ..shift.scene.scene import Part, Scene
from ..shift.scene.variation import varied_scene
from ..shift.shift_result import ShiftResult
from .scene_runs import Loop, Signals, followed
from .target import Array, Figure, Flags

FULL_RUNS = 16
SHARE = 0.1  # of a figure's band: an error of the shortcut that is too large
STILL = 1e-6  # of a figure: a band below is none
N_TIME = 131  # instants of the series
REASONS = (
    "the values do not go together",
    "the shift could not be run",
    "the washers could not be followed",
)
# Parameters of the transmission that decide on the washers alone.
OF_WASHERS = ("transmission.thrust_share", "transmission.planet_tilt", "transmission.washer_radius")
WASHER_SERIES = ("washer.friction_torque", "washer.film_ratio")
SERIES = (
    "transmission.clutch_reaction",
    "transmission.brake_reaction",
    "vehicle.acceleration",
    "transmission.output_torque",
    "transmission.engine_speed",
    "clutch.temperature",
    *WASHER_SERIES,
)
# As the shift begins: name -> signal, words, unit.
AT_START = {
    "washer_torque": ("washer.friction_torque", "washer, friction torque as the shift begins", "N.m"),
    "washer_film_ratio": ("washer.film_ratio", "washer, film ratio as the shift begins", "1"),
}
SAFETIES = ("pitting_safety", "scuffing_safety", "micropitting_safety")
# Key figure -> figure of ``report.shift.usual``, where the names differ.
USUAL = {"least_pitting_safety": "pitting_safety", "least_scuffing_safety": "scuffing_safety"}
