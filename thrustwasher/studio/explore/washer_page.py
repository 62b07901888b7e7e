"""The thrust washer's page: load curve, discs, Stribeck curve."""

from ...washer.solve import RANGES
from ...washer.washer_result import SLIPS
from ..report.shift.live_washer import LOADS, WORKER
from .view import View

SPEEDS = tuple(float(f"{2.0 * 1000.0 ** (i / 35):.6g}") for i in range(36))  # [rad/s]

VIEW = View(
    worker=WORKER,
    page="washer",
    main=("roughness", "washer_thickness", "asperity_radius", "viscosity_exponent", "heat_split"),
    figures="friction_torque temperature film_thickness film_ratio branch distress "
    "temperature_max friction_coefficient".split(),
    solve="solve_washer",
    params="WasherParams",
    terms="Film 1 lies between carrier and washer, gap 2 between washer and gear.",
    more={"slips": SLIPS, "loads": LOADS, "speeds": SPEEDS},
    spans={
        "load": (10.0, 3000.0),
        "speed": (0.0, 1500.0),
        "tilt": (0.0, 0.005),
        "oil_temperature": (253.15, 423.15),
    },
    least={name: low for name, _, low, _ in RANGES},
)
