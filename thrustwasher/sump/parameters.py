"""Parameters, inputs and outputs of the oil sump: the one list of all interfaces."""

from dataclasses import dataclass
from typing import Any

from ..model.parameters import check_ranges, extended, quantity
from ..model.spec import Exchange, ModelSpec, Signal, Terminal, output

PORTS = range(1, 8)


@dataclass(frozen=True, kw_only=True)
class _SumpParams:
    """Oil and housing of one temperature; the defaults are estimates of a car's transmission.

    6 l of oil hold 10.46 kJ/K, the housing as much again.
    """

    volume: float = quantity(6e-3, "m3", 1e-6, 100.0, "oil in the sump")
    oil_density: float = quantity(850.0, "kg/m3", 500.0, 1500.0, "density of the oil")
    oil_heat_capacity: float = quantity(2050.0, "J/(kg.K)", 500.0, 5e3, "heat capacity of the oil")
    housing_capacity: float = quantity(
        1.08e4, "J/K", 0.0, 1e8, "heat capacity of the housing", belongs_to=("volume",)
    )
    conductance: float = quantity(
        25.0, "W/K", 0.0, 1e6, "from the sump to the surroundings", belongs_to=("volume",)
    )
    initial_temperature: float = quantity(
        358.15, "K", 233.15, 473.15, "temperature of oil and housing at the start"
    )

    def __post_init__(self) -> None:
        check_ranges(self)


_FACTORS: dict[str, Any] = {
    f"factor_{i}": quantity(1.0, "1", 0.0, 1e4, f"equal parts that send heat_{i} or energy_{i}")
    for i in PORTS
}
SumpParams = extended(_SumpParams, "SumpParams", _FACTORS)


def _heat(i: int) -> Signal:
    return Signal(
        name=f"heat_{i}",
        unit="W",
        help=f"heat into the oil from one part of kind {i}",
        low=-1e9,
        high=1e9,
        nominal=1e3,
        start=0.0,
    )


def _energy(i: int) -> Signal:
    return Signal(
        name=f"energy_{i}",
        unit="J",
        help=f"heat since the start from one part of kind {i}, in place of heat_{i}; model "
        "exchange takes heat alone",
        low=-1e15,
        high=1e15,
        nominal=1e4,
        start=0.0,
        late=True,
    )


def _temperature(name: str, start: float, text: str) -> Signal:
    return Signal(
        name=name, unit="K", help=text, low=173.15, high=573.15, nominal=300.0, start=start
    )


_HEATS = ("received_heat", "ambient_heat", "cooler_heat")
EXCHANGE = Exchange(
    kernel="thrustwasher.sump.kernels.exchange",
    states=(
        output("temperature", "K", 300.0, "temperature of the oil"),
        *(output(name, "J", 1e4, "heat since the start") for name in _HEATS),
    ),
    needs={
        "temperature": ("temperature",),
        "stored_heat": ("temperature",),
        **{name: (name,) for name in _HEATS},
        "der(temperature)": (
            *(f"heat_{i}" for i in PORTS),
            "ambient_temperature",
            "cooler_flow",
            "cooler_temperature",
            "temperature",
        ),
        "der(received_heat)": tuple(f"heat_{i}" for i in PORTS),
        "der(ambient_heat)": ("ambient_temperature", "temperature"),
        "der(cooler_heat)": ("cooler_flow", "cooler_temperature", "temperature"),
    },
)
SPEC = ModelSpec(
    key="sump",
    name="OilSump",
    help="Oil sump: temperature of the oil under the parts' heat, surroundings and a cooler",
    params=SumpParams,
    fidelities={"lumped": "one temperature of oil and housing, exact for heat held over a step"},
    default_fidelity="lumped",
    inputs=(
        *map(_heat, PORTS),
        _temperature("ambient_temperature", 298.15, "temperature of the surroundings"),
        Signal(
            name="cooler_flow",
            unit="m3/s",
            help="oil through the cooler",
            low=0.0,
            high=1.0,
            nominal=1e-4,
            start=0.0,
        ),
        _temperature("cooler_temperature", 338.15, "temperature of the oil from the cooler"),
        *map(_energy, PORTS),
    ),
    outputs=(
        output("temperature", "K", 300.0, "temperature of the oil"),
        output("received_heat", "J", 1e4, "heat from the parts since the start"),
        output("stored_heat", "J", 1e4, "heat in oil and housing since the start"),
        output("ambient_heat", "J", 1e4, "heat into the surroundings since the start"),
        output("cooler_heat", "J", 1e4, "heat into the cooler since the start"),
        Signal(
            name="solver_status",
            unit="1",
            kind="enumeration",
            type="SolverStatus",
            help="how the last step was solved",
        ),
    ),
    kernel="thrustwasher.sump.kernels.step",
    exchange=EXCHANGE,
    terminals=(
        *(
            Terminal(
                name=f"part_{i}",
                kind="thrustwasher.HeatPort",
                help="Heat from a kind of part in, temperature of its oil out",
                members=((f"heat_{i}", "Q_flow", "inflow"), ("temperature", "T", "signal")),
            )
            for i in PORTS
        ),
        *(
            Terminal(
                name=f"part_{i}_by_energy",
                kind="thrustwasher.HeatEnergyPort",
                help="Heat since the start from a kind of part in, temperature of its oil out",
                members=((f"energy_{i}", "E", "inflow"), ("temperature", "T", "signal")),
            )
            for i in PORTS
        ),
    ),
    stop_time=600.0,
    step_size=1.0,
    # 2 kW for ten minutes, the cooler from half of it on.
    profile=tuple(
        (t, *[2e3 if i == 1 else 0.0 for i in PORTS], 298.15, flow, 338.15, *[0.0 for _ in PORTS])
        for t, flow in ((0.0, 0.0), (300.0, 0.0), (301.0, 5e-5), (600.0, 5e-5))
    ),
)
