"""What every answer that calls itself a solution has to satisfy."""

import dataclasses
import math

SLACK = 1e-9


def washer(r):
    """Balances, signs and order of temperatures of a washer's result."""
    p = r.params
    sigma = r.film_thickness / r.film_ratio if r.film_ratio else 0.0
    roughest = math.hypot(p.roughness_carrier or p.roughness, p.roughness_washer or p.roughness)
    return {
        "film and contact carry the load": close(r.fluid_load + r.contact_load, r.load, 1e-5),
        "film_ratio is film over sigma": r.film_ratio == 0.0 or close(sigma, roughest, 1e-9),
        "friction takes power": r.friction_torque * r.speed >= 0.0,
        "no friction at rest": r.speed != 0.0 or r.friction_torque == 0.0,
        "nothing is colder than the oil": r.temperature_max
        >= r.temperature - 1e-7
        >= r.oil_temperature - 2e-7,
        "nothing pulls": r.fluid_load >= -SLACK * r.load and r.contact_load >= 0.0,
        "the error is a share": r.error_estimate is None or r.error_estimate >= 0.0,
    }


def clutch(r, params, load, speed, oil):
    """Balances, signs and order of temperatures of a pack's result."""
    parts = r.contact_torque + r.viscous_torque
    return {
        "torque is contact and shear": close(r.friction_torque, parts, 1e-12),
        "friction takes power": r.friction_torque * speed >= 0.0 and r.friction_power >= 0.0,
        "no friction at rest": speed != 0.0 or r.friction_torque == 0.0,
        "film_ratio is film over roughness": close(
            r.film_thickness, r.film_ratio * params.roughness, 1e-12
        ),
        "the interface is not colder than the oil": r.temperature >= oil * (1.0 - 1e-12),
        "the capacity bears the torque": abs(r.friction_torque) <= r.torque_capacity * (1 + 1e-12),
        "contact is a share": 0.0 <= r.contact_share <= 1.0,
        "power is torque times slip": close(r.friction_power, r.friction_torque * speed, 1e-12),
    }


def gearmesh(r, speed, oil):
    """Signs, shares and order of temperatures of a mesh's result."""
    return {
        "friction takes power": r.friction_torque * speed >= 0.0 and r.friction_power >= 0.0,
        "no friction at rest": speed != 0.0 or r.friction_torque == 0.0,
        "flank, film and asperities are not colder than the oil": min(
            r.surface_temperature, r.film_temperature, r.asperity_temperature
        )
        >= oil * (1.0 - 1e-12),
        "stresses press": r.contact_stress >= 0.0 and r.hertz_pressure >= 0.0,
        "the film is there": r.film_thickness >= 0.0 and r.film_ratio >= 0.0,
        "thermal stress takes of the allowable": r.allowable_ratio is None
        or 0.0 < r.allowable_ratio <= 1.0,
        "power is torque times speed": close(r.friction_power, r.friction_torque * speed, 1e-12),
    }


def outputs(spec, inp, out, tolerance=1e-11):
    """What the outputs of a model's FMU satisfy, whatever its memory.

    The transmission's energy balance closes to some times the ``tolerance`` of its integration. A
    pack that has found a driveline with a delay acts on the slip to come, not on that of now.
    """
    found = {"finite": all(map(math.isfinite, out.values()))}
    if "friction_torque" in out:
        speed = inp["speed"]
        opposes = out["friction_torque"] * speed >= 0.0
        found["friction takes power"] = opposes or out.get("plant_age", 0.0) >= 1.0
        if "friction_power" in out:
            power = out["friction_torque"] * speed
            found["power is torque times speed"] = close(out["friction_power"], power, 1e-9, 1e-9)
    for signal in spec.outputs:
        low, high = signal.low, signal.high
        value = out[signal.name]
        found[f"{signal.name} is in its range"] = (low is None or value >= low) and (
            high is None or value <= high
        )
    if "fluid_load_share" in out:
        found["the film carries a share"] = -SLACK <= out["fluid_load_share"] <= 1.0 + SLACK
    if "energy_residual" in out:
        moved = [abs(out[name]) for name in out if name.endswith(("_work", "_heat", "_change"))]
        missing, share = abs(out["energy_residual"]), max(1e-6, 100.0 * tolerance)
        found["the energy balance is closed"] = missing <= share * (1.0 + max(moved))
    for pack in ("clutch", "brake"):
        if f"{pack}_locked" in out:
            held = out[f"{pack}_locked"] == 0.0 or abs(out[f"{pack}_speed"]) < 1e-9
            found[f"a {pack} that sticks does not slip"] = held
    return found


def finite(result):
    """Tell if all numbers of a result are finite."""
    values = [getattr(result, f.name) for f in dataclasses.fields(result)]
    return all(math.isfinite(v) for v in values if isinstance(v, float))


def close(a, b, share, least=0.0):
    """Tell if two numbers agree to a share of the larger."""
    return a == b or abs(a - b) <= max(share * max(abs(a), abs(b)), least)


def broken(claims):
    """Return the claims that do not hold."""
    return [text for text, holds in claims.items() if not holds]
