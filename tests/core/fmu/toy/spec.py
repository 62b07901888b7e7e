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


def given(name, unit, help, low, high, nominal, start):
    return Signal(name=name, unit=unit, help=help, low=low, high=high, nominal=nominal, start=start)


def told(name, unit, help, *depends, **more):
    return Signal(name=name, unit=unit, help=help, depends=depends, **more)


SPEC = ModelSpec(
    key="toy.spec:SPEC",
    name="ToyClutch",
    help="A disc that warms up by friction, for tests of FMUs",
    params=ToyParams,
    fidelities={"coarse": "one explicit step", "fine": "ten explicit steps"},
    default_fidelity="coarse",
    inputs=(
        given("load", "N", "axial force on the toy discs", 0.0, 1e4, 1e3, 100.0),
        given("speed", "rad/s", "slip speed of the toy discs", -1e3, 1e3, 100.0, 10.0),
        given("oil_temperature", "K", "temperature of the toy oil", 233.15, 473.15, 300.0, 300.0),
    ),
    outputs=(
        told("friction_torque", "N.m", "torque of the toy discs", "load", "speed", nominal=10.0),
        told("temperature", "K", "temperature of the toy discs", "oil_temperature", nominal=300.0),
        told("temperature_rise", "K", "discs above the toy oil", nominal=10.0, relative=True),
        told("energy", "J", "friction work done so far", nominal=1e3),
        told("film_ratio", "1", "film over roughness of the toy", "load", nominal=1.0),
        told(
            "regime",
            "1",
            "lubrication regime of the toy",
            "speed",
            kind="enumeration",
            type="Regime",
            low=1,
            high=4,
        ),
        told(
            "hot",
            "1",
            "warmer than the toy allows",
            kind="boolean",
            events=("too hot", "cool again"),
        ),
        told("steps", "1", "number of steps the toy has made", kind="integer"),
        told(
            "solver_status",
            "1",
            "how the last solution was obtained",
            "load",
            kind="enumeration",
            type="SolverStatus",
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
            members=(("speed", "w", "signal"), ("friction_torque", "tau", "outflow")),
        ),
    ),
    stop_time=0.1,
)
