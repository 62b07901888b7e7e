"""What the charts' errors are measured against: the reference rungs, at the charts' cases."""

from __future__ import annotations

from ..models.clutch_params import ClutchParams
from ..models.gearmesh_params import GearMeshParams
from ..models.washer import solve_washer
from ..models.washer_params import WasherParams
from .cases import Case
from .measure import Truth
from .reference_clutch import reference_engagement
from .reference_gearmesh import reference_gearmesh
from .reference_values import ReferenceValues
from .reference_washer import reference_washer
from .ways_clutch import corners


def washer_truth(case: Case) -> Truth:
    """Return converged values of a washer case, on the branch that the way to it leads to."""
    params, result = WasherParams(), None
    for load, speed, tilt, oil in (*case.before, case.point):
        result = solve_washer(
            params, load=load, speed=speed, tilt=tilt, oil_temperature=oil, start=result
        )
    load, speed, tilt, oil = case.point
    branch = result.branch if result else None
    found = reference_washer(
        params, load=load, speed=speed, tilt=tilt, oil_temperature=oil, branch=branch
    )
    return _kept(found, ("friction_torque", "temperature"))


def gearmesh_truth(case: Case) -> Truth:
    """Return loss and asperity temperature of a case, resolved along the line of action."""
    load, speed, oil = case.point
    found = reference_gearmesh(
        GearMeshParams(), power=load * speed, speed=speed, oil_temperature=oil
    )
    return _kept(found, ("friction_torque", "temperature"))


def clutch_truth(case: Case) -> Truth:
    """Return slip energy and temperature at the end of an engagement, resolved over the radius."""
    time, load, speed = corners(case)
    found = reference_engagement(
        ClutchParams(), time=time, load=load, speed=speed, oil_temperature=case.point[2]
    )
    values = {"slip_energy": found.values["energy"],
              "end_temperature": found.values["temperature"]}  # fmt: skip
    apart = {"slip_energy": found.uncertainty["energy"],
             "end_temperature": found.uncertainty["temperature"]}  # fmt: skip
    return Truth(values, apart)


def _kept(found: ReferenceValues, names: tuple[str, ...]) -> Truth:
    values = {name: found.values[name] for name in names}
    return Truth(values, {name: found.uncertainty[name] for name in names})
