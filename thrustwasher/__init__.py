"""Friction units for drivetrain simulation: thrust washer, wet clutch, gear mesh.

>>> from thrustwasher import WasherParams, solve_washer
>>> result = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002)
>>> round(result.friction_torque, 3)
0.258
"""

import logging
from typing import TYPE_CHECKING, Any

__version__ = "0.27.0"
logging.getLogger(__name__).addHandler(logging.NullHandler())

if TYPE_CHECKING:
    from .clutch.engagement import Engagement, engage_clutch
    from .clutch.release import Release, release_clutch
    from .clutch.solve import ClutchParams, ClutchResult, boundary_friction, solve_clutch
    from .errors import BranchError, ParameterError, SolveError, Status
    from .fmu.build import build_fmu
    from .gearmesh.solve import GearMeshParams, GearMeshResult, solve_gearmesh
    from .ladder.choose import Choice, choose
    from .losses.solve import LossesParams, LossesResult, solve_losses
    from .model.oil import Oil, oil
    from .model.part_file import PartFile, load_part
    from .shift.scene.scene_file import load_scene
    from .shift.several_shifts import SequenceResult
    from .shift.shift_result import ShiftResult
    from .shift.whole_shift import run_shift
    from .studio.calibration.engagement.trace_fit import calibrate_traces
    from .studio.calibration.estimates import Calibration
    from .studio.calibration.model_fit import ModelCalibration
    from .studio.calibration.run_calibration import calibrate
    from .studio.evaluators.make import engagements
    from .studio.optimisation.optimum import Optimum
    from .studio.optimisation.whole_search import optimise
    from .studio.scatter.propagate import propagate
    from .studio.scatter.result import ScatterResult
    from .studio.sweep.run_sweep import run_sweep
    from .studio.sweep.sweep_table import SweepTable
    from .train.solve import TrainParams, TrainResult, solve_train
    from .washer.follow import WasherHistory, follow_washer
    from .washer.load_curve import LoadCurve, load_curve
    from .washer.solve import WasherParams, WasherResult, solve_washer

_HOMES = {
    "ladder.choose": ("Choice", "choose"),
    "model.oil": ("Oil", "oil"),
    "model.part_file": ("PartFile", "load_part"),
    "studio.optimisation.whole_search": ("optimise",),
    "studio.optimisation.optimum": ("Optimum",),
    "fmu.build": ("build_fmu",),
    "errors": ("BranchError", "ParameterError", "SolveError", "Status"),
    "clutch.solve": ("ClutchParams", "ClutchResult", "boundary_friction", "solve_clutch"),
    "studio.calibration.estimates": ("Calibration",),
    "studio.calibration.model_fit": ("ModelCalibration",),
    "studio.calibration.run_calibration": ("calibrate",),
    "studio.calibration.engagement.trace_fit": ("calibrate_traces",),
    "gearmesh.solve": ("GearMeshParams", "GearMeshResult", "solve_gearmesh"),
    "clutch.engagement": ("Engagement", "engage_clutch"),
    "clutch.release": ("Release", "release_clutch"),
    "losses.solve": ("LossesParams", "LossesResult", "solve_losses"),
    "studio.evaluators.make": ("engagements",),
    "studio.scatter.propagate": ("propagate",),
    "studio.scatter.result": ("ScatterResult",),
    "shift.whole_shift": ("run_shift",),
    "shift.scene.scene_file": ("load_scene",),
    "shift.several_shifts": ("SequenceResult",),
    "shift.shift_result": ("ShiftResult",),
    "train.solve": ("TrainParams", "TrainResult", "solve_train"),
    "washer.solve": ("WasherParams", "WasherResult", "solve_washer"),
    "washer.follow": ("WasherHistory", "follow_washer"),
    "washer.load_curve": ("LoadCurve", "load_curve"),
    "studio.sweep.run_sweep": ("run_sweep",),
    "studio.sweep.sweep_table": ("SweepTable",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}
__all__ = [
    "BranchError",
    "Calibration",
    "Choice",
    "ClutchParams",
    "ClutchResult",
    "Engagement",
    "GearMeshParams",
    "GearMeshResult",
    "LoadCurve",
    "LossesParams",
    "LossesResult",
    "ModelCalibration",
    "Oil",
    "Optimum",
    "ParameterError",
    "PartFile",
    "Release",
    "ScatterResult",
    "SequenceResult",
    "ShiftResult",
    "SolveError",
    "Status",
    "SweepTable",
    "TrainParams",
    "TrainResult",
    "WasherHistory",
    "WasherParams",
    "WasherResult",
    "boundary_friction",
    "build_fmu",
    "calibrate",
    "calibrate_traces",
    "choose",
    "engage_clutch",
    "engagements",
    "follow_washer",
    "load_curve",
    "load_part",
    "load_scene",
    "oil",
    "optimise",
    "propagate",
    "release_clutch",
    "run_shift",
    "run_sweep",
    "solve_clutch",
    "solve_gearmesh",
    "solve_losses",
    "solve_train",
    "solve_washer",
]


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: ``import thrustwasher`` stays quick."""
    if name not in _HOME_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module
    from types import FunctionType

    value = getattr(import_module(f".{_HOME_OF[name]}", __name__), name)
    if isinstance(value, FunctionType):
        from .logs import warning

        value = warning(value, __name__)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
