"""The series of the charts: every rung, meshes and tolerances, rivals at their best setting."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial

from ...model.record import resolve
from ...model.registry import ladder_of, spec_of
from ...model.spec import ModelSpec
from .methods import ClutchMethod, KernelMethod, Method, Method2006


@dataclass(frozen=True)
class Configuration:
    """One method at one setting of its knob."""

    family: str  # series of the chart
    label: str
    knob: str  # what changes along the series: "grid", "tolerance", "rung"
    value: str
    make: Callable[[], Method]
    count_of: str = ""
    is_rival: bool = False


@dataclass(frozen=True)
class Quantity:
    """What is judged: relative errors have a floor, absolute ones a unit."""

    name: str
    relative: bool
    floor: float = 0.0  # least size an error is referred to
    unit: str = "1"

    def error(self, found: float, true: float) -> float:
        """Return the error of a value."""
        size = max(abs(true), self.floor) if self.relative else 1.0
        return abs(found - true) / size


USUAL_STEP = 1e-3
STEPS = (2e-2, 1e-2, 5e-3, 2e-3, 5e-4)
GRIDS = ((7, 20), (9, 24), (10, 32), (13, 40), (16, 48), (19, 64), (28, 96))
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6)
GRIDS_2006 = ((13, 67), (17, 67), (17, 134))
Settings = Iterable[tuple[str, str, Callable[[], Method]]]  # label, value of the knob, method


def _series(
    family: str, knob: str, settings: Settings, count_of: str, *, is_rival: bool = False
) -> list[Configuration]:
    return [
        Configuration(family, label, knob, value, make, count_of, is_rival)
        for label, value, make in settings
    ]


def _rungs(spec: ModelSpec, *, quick: bool = False) -> list[Configuration]:
    """Return every named fidelity that the kernel knows."""
    rungs = ((name, name, partial(KernelMethod, spec, name)) for name in spec.fidelities)
    return _series("rungs", "rung", rungs, spec.counts[0][0] if spec.counts else "calls")


def _washer(spec: ModelSpec, *, quick: bool = False) -> list[Configuration]:
    """Return rungs, meshes from coarse to fine, and the method of 2006.

    That goes over its tolerance, and over its mesh at the best tolerance.
    """
    meshes: Settings = (
        (f"{r} x {t}", f"{r}x{t}", partial(KernelMethod, spec, "field", (r, t)))
        for r, t in (GRIDS[::3] if quick else GRIDS)
    )
    tolerances: Settings = (
        (f"2006, 9 x 67, {t:g}", f"{t:g}", partial(Method2006, tolerance=t))
        for t in (TOLERANCES[1:2] if quick else TOLERANCES)
    )
    meshes_2006: Settings = (
        (f"2006, mesh {r} x {t}", f"{r}x{t}", partial(Method2006, tolerance=1e-5, grid=(r, t)))
        for r, t in (() if quick else GRIDS_2006)
    )
    swept = "sweeps x nodes"
    return [
        *_rungs(spec),
        *_series("mesh of the package", "grid", meshes, "Newton iterations x nodes"),
        *_series("2006, 9 x 67, tolerance", "tolerance", tolerances, swept, is_rival=True),
        *_series("2006, 1e-5, mesh", "grid", meshes_2006, swept, is_rival=True),
    ]


def _clutch(spec: ModelSpec, *, quick: bool = False) -> list[Configuration]:
    """Return every rung, and those with a moving film over the communication step."""
    rungs = ((name, name, partial(ClutchMethod, name, USUAL_STEP)) for name in spec.fidelities)
    found = _series("rungs", "rung", rungs, "steps")
    for name in ("field", "fine"):
        steps: Settings = (
            (f"{name}, {1e3 * h:g} ms", f"{1e3 * h:g} ms", partial(ClutchMethod, name, h))
            for h in (STEPS[::2] if quick else STEPS)
        )
        found += _series(f"{name} over the step", "step", steps, "steps")
    return found


@dataclass(frozen=True)
class Chart:
    """What a model's chart shows."""

    quantities: tuple[Quantity, Quantity]
    cost_of: str  # its axis
    series: Callable[..., list[Configuration]]


WARM = "warm call, 1 % away [s]"
KELVIN = Quantity("temperature", False, unit="K")
WASHER = Chart((Quantity("friction_torque", True, 1e-3), KELVIN), WARM, _washer)
CLUTCH = Chart(
    (Quantity("slip_energy", True), Quantity("end_temperature", False, unit="K")),
    "engagement of 0.6 s [s]", _clutch,
)  # fmt: skip
GEARMESH = Chart((Quantity("friction_torque", True, 1e-4), KELVIN), WARM, _rungs)


def chart_of(model: str) -> Chart:
    """Return what a model's chart shows."""
    found: Chart = resolve(ladder_of(model).chart)
    return found


def series_of(model: str, *, quick: bool = False) -> list[Configuration]:
    """Return everything that is measured for a model."""
    return chart_of(model).series(spec_of(model), quick=quick)
