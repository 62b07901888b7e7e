"""Points and runs of the washer that the stability tests share."""

import math

from thrustwasher import WasherParams, solve_washer


def solve(load=300.0, speed=545.0, tilt=0.002, **more):
    return solve_washer(WasherParams(), load=load, speed=speed, tilt=tilt, **more)


def followed(points, start=None):
    """Solve a list of points (dicts), each from the one before."""
    results = []
    for point in points:
        start = solve(**point, start=start)
        results.append(start)
    return results


def is_sound(r):
    """Tell if a result is a solution that obeys what every solution must."""
    numbers = (r.friction_torque, r.temperature, r.temperature_max, r.film_thickness, r.fluid_load)
    return (
        not r.status.is_failure
        and all(math.isfinite(x) for x in numbers)
        and r.friction_torque * r.speed >= 0.0
        and r.temperature_max >= r.temperature >= r.oil_temperature - 1e-9
        and abs(r.fluid_load + r.contact_load - r.load) <= 1e-5 * r.load
    )
