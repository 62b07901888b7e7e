"""The energy balance of a shift, read from its signals."""

import numpy as np
from numpy.typing import NDArray

Signals = dict[str, NDArray[np.float64]]


def energy_balance(signals: Signals) -> dict[str, float]:
    """Return every entry of the energy balance [J] and its errors with their shares.

    ``residual`` is the energy that no entry accounts for; its share is of the engine's work or, in
    a run without engine, of the kinetic energy that changed hands. ``coupling_difference`` is the
    clutch's heat on the mechanical side minus the heat its thermal side has booked: the error of
    exchanging signals once per step; its share is of that heat. Likewise for the brake.
    """

    def last(name: str) -> float:
        return float(signals[name][-1]) if name in signals else 0.0

    balance = {
        "engine_work": last("transmission.engine_work"),
        "kinetic": last("transmission.kinetic_change"),
        "load_work": last("transmission.load_work"),
        "clutch": last("transmission.clutch_heat"),
        "brake": last("transmission.brake_heat"),
        "washers": last("transmission.washer_heat"),
        "meshes": last("transmission.mesh_heat"),
        "shaft": last("transmission.shaft_heat"),
        "spring": last("transmission.shaft_energy"),
        "residual": last("transmission.energy_residual"),
    }
    whole = abs(balance["engine_work"]) or abs(balance["kinetic"])
    balance["residual_share"] = abs(balance["residual"]) / whole if whole else 0.0
    for pack, prefix in (("clutch", ""), ("brake", "brake_")):
        difference = balance[pack] - last(f"{pack}.energy")
        share = abs(difference) / balance[pack] if balance[pack] else 0.0
        balance[f"{prefix}coupling_difference"] = difference
        balance[f"{prefix}coupling_difference_share"] = share
    return balance
