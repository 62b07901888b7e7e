"""What the gear mesh shows to the outside: inputs, outputs, plugs."""

from typing import Any

from ._spec import ModelSpec, Signal, Terminal
from .gearmesh_rules import RULES

LOAD = Signal(name="load", unit="N.m", help="torque on the pinion, its sign does not matter",
              low=-1e5, high=1e5, nominal=40.0, start=0.0)  # fmt: skip
SPEED = Signal(name="speed", unit="rad/s", help="speed of the pinion, either sign",
               low=-5000.0, high=5000.0, nominal=180.0, start=0.0)  # fmt: skip
OIL = Signal(name="oil_temperature", unit="K", help="temperature of oil and gear bodies",
             low=233.15, high=473.15, nominal=300.0, start=299.85)  # fmt: skip
_ALL = ("load", "speed", "oil_temperature")


def _out(name: str, unit: str, nominal: float, text: str, **extra: Any) -> Signal:
    return Signal(**{"depends": _ALL, **extra}, name=name, unit=unit, nominal=nominal, help=text)


OUTPUTS = (
    _out("friction_torque", "N.m", 1.0, "mesh loss as a torque on the pinion, sign of speed"),
    _out("temperature", "K", 300.0, "temperature of the pinion's asperities where contact starts"),
    _out("film_thickness", "m", 1e-6, "least film thickness where contact starts"),
    _out("surface_temperature", "K", 300.0, "temperature of the flank where contact starts"),
    _out("contact_stress", "Pa", 2e8, "Hertz contact stress where contact starts",
         depends=("load",)),
    _out("thermal_stress", "Pa", 1e8, "stress from the asperity's temperature rise"),
    _out("modification_factor", "1", 1.0, "squared thermal over contact stress, each by its limit"),
    _out("allowable_ratio", "1", 1.0, "share of contact stress allowed beside thermal stress"),
    _out("film_temperature", "K", 300.0, "highest temperature of the oil film"),
    _out("flash_rise", "K", 10.0, "temperature rise by friction over the nominal area",
         relative=True),
    _out("film_ratio", "1", 1.0, "film thickness over composite RMS roughness"),
    _out("friction_coefficient", "1", 0.1, "coefficient of friction of the flanks"),
    _out("friction_power", "W", 100.0, "heat made by the mesh, torque times speed"),
    _out("modification_factor_aisi1020", "1", 1.0, "modification factor for low-carbon AISI 1020"),
    _out("modification_factor_aisi4340", "1", 1.0, "modification factor for high-carbon AISI 4340"),
    _out("allowable_ratio_aisi1020", "1", 1.0, "share of contact stress allowed for AISI 1020"),
    _out("allowable_ratio_aisi4340", "1", 1.0, "share of contact stress allowed for AISI 4340"),
    _out("stress_utilization_aisi1020", "1", 1.0, "combined stress over endurance of AISI 1020"),
    _out("stress_utilization_aisi4340", "1", 1.0, "combined stress over endurance of AISI 4340"),
    Signal(name="regime", unit="1", kind="enumeration", type="Regime", depends=_ALL,
           help="lubrication regime where contact starts"),
    Signal(name="solver_status", unit="1", kind="enumeration", type="SolverStatus", depends=_ALL,
           help="how the last solution was obtained"),
)  # fmt: skip


def gearmesh_spec(params: type[Any]) -> ModelSpec:
    """Return the model around its parameter dataclass."""
    return ModelSpec(
        key="gearmesh",
        name="GearMesh",
        help="Spur gear mesh: loss torque, contact, flank and asperity temperature, endurance",
        params=params,
        fidelities={
            "closed": "Hertz contact, Blok flash temperature, constant friction, oil as supplied",
            "stribeck": "the same as field, viscosity and flank's temperature in closed form",
            "field": "friction over the film, viscosity found with the flank's temperature",
            "fine": "the same at every position of the line of action, the loss their sum",
        },
        default_fidelity="field",
        inputs=(LOAD, SPEED, OIL),
        outputs=OUTPUTS,
        kernel="gear_step",
        rules=RULES,
        terminals=(
            Terminal(name="shaft", kind="thrustwasher.MeshFlange",
                     help="Speed and torque of the pinion in, its friction torque out",
                     members=(("speed", "w", "signal"), ("friction_torque", "tau", "inflow"),
                              ("load", "load", "signal"))),
            Terminal(name="oil", kind="thrustwasher.HeatPort",
                     help="Oil temperature in, friction power out",
                     members=(("oil_temperature", "T", "signal"),
                              ("friction_power", "Q_flow", "outflow"))),
        ),
        # Run up under torque, work, coast down through standstill into reverse.
        course=((0.0, 0.0, 0.0, 300.0), (0.3, 40.0, 180.0, 300.0), (0.6, 60.0, 120.0, 330.0),
                (0.9, 20.0, 0.0, 330.0), (1.0, -20.0, -30.0, 330.0)),
        counts=(("viscosity iterations", "gear_layout:F_ITERATIONS"),),
    )  # fmt: skip
