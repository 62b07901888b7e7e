from dataclasses import dataclass

from thrustwasher.model.parameters import check_ranges, quantity
from thrustwasher.model.spec import ModelSpec, Signal

STATUS = Signal(
    name="solver_status",
    unit="1",
    kind="enumeration",
    type="SolverStatus",
    help="how the last solution was obtained",
)
LEVELS = {"exact": "linear, in closed form"}


@dataclass(frozen=True, slots=True, kw_only=True)
class BodyParams:
    inertia: float = quantity(1.0, "kg", 1e-6, 1e6, "what the force moves")
    leak: float = quantity(0.0, "1", 0.0, 1e6, "force that resists one unit of speed")
    start_position: float = quantity(0.0, "m", -1e6, 1e6, "position at the start")
    start_speed: float = quantity(1.0, "m/s", -1e6, 1e6, "speed at the start")

    def __post_init__(self):
        check_ranges(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class LawParams:
    stiffness: float = quantity(0.0, "N/m", -1e9, 1e9, "force that resists one unit of position")
    slope: float = quantity(1.0, "1", -1e9, 1e9, "force that resists one unit of speed")

    def __post_init__(self):
        check_ranges(self)


def _signal(name, unit, **more):
    return Signal(name=name, unit=unit, help=f"{name} of the loop", nominal=1.0, **more)


def _in(name, unit):
    return _signal(name, unit, low=-1e300, high=1e300, start=0.0)


BODY = ModelSpec(
    key="loops.specs:BODY",
    name="Body",
    help="A body that a force moves",
    params=BodyParams,
    fidelities=LEVELS,
    default_fidelity="exact",
    inputs=(_in("force", "N"),),
    outputs=(_signal("position", "m"), _signal("speed", "m/s"), STATUS),
    kernel="loops.body",
)
LAW = ModelSpec(
    key="loops.specs:LAW",
    name="Law",
    help="A force that answers motion",
    params=LawParams,
    fidelities=LEVELS,
    default_fidelity="exact",
    inputs=(_in("position", "m"), _in("speed", "m/s")),
    outputs=(_signal("force", "N", depends=("position", "speed")), STATUS),
    kernel="loops.law",
)
