"""The wet clutch's page: an engagement under a ramp of load that one draws."""

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np

from ...clutch.engagement import engage_clutch
from ...clutch.kernels import layout
from ...clutch.parameters import DRUM, LOAD, OIL, SPEC, SPEED
from ...errors import Status
from ...model.spec import Signal
from ..report.web_worker import WebWorker, numbers_of
from .view import View

POINTS, HANDLES = 248, 9  # a point at every handle
LARGEST, RISING = 5000.0, 0.25  # N; share of the time in which the load rises to it at the start
RAMP = [LARGEST * min(i / (HANDLES - 1) / RISING, 1.0) for i in range(HANDLES)]
DURATION = Signal(
    name="duration",
    unit="s",
    help="time from the start to zero slip",
    low=1e-3,
    high=3600.0,
    start=0.5,
)
USUAL = {SPEED.name: 100.0, OIL.name: 353.15}


def _result(params: Any, point: Mapping[str, float], level: str) -> Any:
    end = point["duration"]
    time = np.linspace(0.0, end, POINTS + 1)
    found = engage_clutch(
        params,
        time=time,
        load=np.interp(time, np.linspace(0.0, end, HANDLES), RAMP),
        speed=point["speed"] * (1.0 - time / end),
        oil_temperature=point[OIL.name],
        drum_speed=point[DRUM.name],
        fidelity=level,
    )
    thin = np.flatnonzero(found.film_ratio < 1.0)
    return SimpleNamespace(
        profile=found,
        friction_torque_max=float(np.abs(found.friction_torque).max()),
        power_max=float(np.abs(found.friction_power).max()),
        temperature_max=float(found.temperature.max()),
        film_ratio_min=float(found.film_ratio.min()),
        heat_flux_max=float(found.heat_flux.max()),
        energy=float(found.energy[-1]),
        stored_heat=float(found.stored_heat[-1]),
        boundary_from=float(found.time[thin[0]]) if thin.size else float("nan"),
    )


VIEW = View(
    worker=WebWorker(
        script="clutch_worker",
        calls="broken_rule derive load_memory settle_film advance fill_outputs mean_surface "
        "stored_heat".split(),
        layout=numbers_of(layout, HOT=Status.HOT, EXTRAPOLATED=Status.EXTRAPOLATED, POINTS=POINTS),
        levels={n: {"code": k} for k, n in enumerate(SPEC.fidelities, 1) if n in SPEC.levels},
    ),
    page="clutch",
    main=("faces", "roughness", "initial_film", "permeability", "steel_thickness"),
    figures="friction_torque_max temperature_max energy power_max film_ratio_min "
    "boundary_from".split(),
    solve="engage_clutch",
    params="ClutchParams",
    result=_result,
    inputs=(SPEED, OIL, DRUM, DURATION),
    usual=USUAL,
    outputs={
        "friction_torque_max": ("N.m", "largest friction torque"),
        "temperature_max": ("K", "highest temperature of the interface"),
        "energy": ("J", "heat made in the engagement"),
        "power_max": ("W", "largest friction power"),
        "film_ratio_min": ("1", "minimum film thickness over roughness"),
        "boundary_from": ("s", "when the asperities carry (film ratio below 1)"),
        "heat_flux_max": ("W/m2", "largest heat flux into a face"),
        "stored_heat": ("J", "heat in the steel at the end"),
    },
    load="ramp",
    verified_point=lambda point: {**point, "load": LARGEST},
    more={"ramp": RAMP, "largest_load": LOAD.high, "points": POINTS},
    spans={
        "speed": (0.0, 600.0),
        "drum_speed": (-600.0, 600.0),
        "duration": (0.05, 5.0),
        "oil_temperature": (253.15, 423.15),
        "permeability": (1e-15, 1e-10),
    },
)
