"""A pack on a test rig that records over time: parameters of the pack and of the test rig."""

from dataclasses import dataclass, fields, replace

from ....clutch.parameters import SPEC, ClutchParams
from ....model.parameters import check_ranges, quantity
from ....model.spec import Signal


@dataclass(frozen=True, slots=True, kw_only=True)
class TracedPack(ClutchParams):
    """A pack with the test rig that it was recorded on."""

    fill_time: float = quantity(
        0.0, "s", 0.0, 1.0, "time by which the force on the plates is later than recorded"
    )
    kiss_pressure: float = quantity(
        0.0, "Pa", 0.0, 2e6, "pressure that the piston's springs take before the plates touch"
    )
    piston_area: float = quantity(0.0, "m2", 0.0, 1.0, "area that pressure acts on")
    inertia: float = quantity(
        0.0,
        "kg.m2",
        0.0,
        1e4,
        "inertia that the pack stops, as its slip sees it (0: slip is given)",
    )
    drag_torque: float = quantity(
        0.0, "N.m", -1e4, 1e4, "torque in addition to the pack's that slows the slip"
    )
    inertia_between: float = quantity(
        0.0, "kg.m2", 0.0, 1e3, "inertia between the faces and where torque is measured"
    )
    torque_offset: float = quantity(
        0.0, "N.m", -1e4, 1e4, "torque that the sensor shows in addition to the true one"
    )

    def __post_init__(self) -> None:
        check_ranges(self)
        self.pack()

    def pack(self) -> ClutchParams:
        """Return the pack alone; ParameterError if its parameters cannot be used together."""
        return ClutchParams(**{f.name: getattr(self, f.name) for f in fields(ClutchParams)})


OF_RIG = tuple(f.name for f in fields(TracedPack) if f.name not in ClutchParams.__slots__)
SLIP = Signal(name="slip", unit="rad/s", help="slip that comes out of the balance of torques")
TRACED = replace(SPEC, params=TracedPack, outputs=(*SPEC.outputs, SLIP))


def traced_pack(pack: ClutchParams) -> TracedPack:
    """Return a pack on a test rig of which nothing is known yet."""
    return TracedPack(**{f.name: getattr(pack, f.name) for f in fields(ClutchParams)})
