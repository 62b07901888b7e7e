from dataclasses import dataclass

from thrustwasher.model.parameters import check_ranges, check_rules, choice, count, flag, quantity
from thrustwasher.model.spec import ModelSpec, Rule, Signal, Terminal

RULES = (
    Rule("inner_radius = {inner_radius} m, allowed: below outer_radius ({outer_radius} m)"),
    Rule("law = {law} with dry = {dry} and discs = {discs}, allowed: 'viscous' only with oil"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ToyParams:
    inner_radius: float = quantity(0.05, "m", 1e-6, 1e7, "inner radius of the toy disc")
    outer_radius: float = quantity(0.1, "m", 1e-6, 1e7, "outer radius of the toy disc")
    heat_capacity: float = quantity(
        100.0, "J/K", 1.0, 1e6, "heat capacity of the toy disc", tunable=True
    )
    discs: int = count(2, 1, 20, "number of discs in the toy (13: cannot be used)")
    dry: bool = flag(False, "no oil between the toy discs")
    law: str = choice(
        "viscous",
        {"viscous": "grows with the speed", "dry": "does not grow"},
        "ToyLaw",
        "law of the toy friction",
    )

    def __post_init__(self):
        check_ranges(self)
        from .kernel import broken_rule

        check_rules(self, RULES, broken_rule)


def _counted():
    from .kernel import SUBSTEPS

    return (("substeps", SUBSTEPS),)


SPEC = ModelSpec(
    key="toy.spec:SPEC",
    name="ToyClutch",
    help="A disc that warms up by friction, for tests of FMUs",
    params=ToyParams,
    fidelities={"coarse": "one explicit step", "fine": "ten explicit steps"},
    default_fidelity="coarse",
    inputs=(
        Signal(
            name="load",
            unit="N",
            help="axial force on the toy discs",
            low=0.0,
            high=1e4,
            nominal=1e3,
            start=100.0,
        ),
        Signal(
            name="speed",
            unit="rad/s",
            help="slip speed of the toy discs",
            low=-1e3,
            high=1e3,
            nominal=100.0,
            start=10.0,
        ),
        Signal(
            name="oil_temperature",
            unit="K",
            help="temperature of the toy oil",
            low=233.15,
            high=473.15,
            nominal=300.0,
            start=300.0,
        ),
    ),
    outputs=(
        Signal(
            name="friction_torque",
            unit="N.m",
            nominal=10.0,
            depends=("load", "speed"),
            help="friction torque of the toy discs",
        ),
        Signal(
            name="temperature",
            unit="K",
            nominal=300.0,
            depends=("oil_temperature",),
            help="temperature of the toy discs",
        ),
        Signal(
            name="temperature_rise",
            unit="K",
            nominal=10.0,
            relative=True,
            help="temperature of the discs above the oil",
        ),
        Signal(name="energy", unit="J", nominal=1e3, help="friction work done so far"),
        Signal(
            name="film_ratio",
            unit="1",
            nominal=1.0,
            depends=("load",),
            help="film over roughness of the toy",
        ),
        Signal(
            name="regime",
            unit="1",
            kind="enumeration",
            type="Regime",
            low=1,
            high=4,
            depends=("speed",),
            help="lubrication regime of the toy",
        ),
        Signal(
            name="hot",
            unit="1",
            kind="boolean",
            help="warmer than the toy allows",
            events=("too hot", "cool again"),
        ),
        Signal(name="steps", unit="1", kind="integer", help="number of steps the toy has made"),
        Signal(
            name="solver_status",
            unit="1",
            kind="enumeration",
            type="SolverStatus",
            depends=("load",),
            help="how the last solution was obtained",
        ),
    ),
    kernel="toy.kernel",
    counted=_counted,
    rules=RULES,
    terminals=(
        Terminal(
            name="shaft",
            kind="thrustwasher.Toy",
            help="Slip speed in, friction torque out",
            members=(("speed", "w", "signal"), ("friction_torque", "tau", "inflow")),
        ),
    ),
    stop_time=0.1,
)
