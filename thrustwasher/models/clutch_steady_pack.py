"""Steady state of a pack that slips for ever, lumped over the radius or ring by ring."""

from __future__ import annotations

from typing import Any, NamedTuple

from ..kernels import clutch_friction, clutch_layout, clutch_rates, clutch_steady


class SteadyPack(NamedTuple):
    """Torques [N m >= 0], temperatures [K] and friction of a pack."""

    contact: float
    viscous: float
    temperature: float  # mean by area
    hottest: float
    coefficient: float
    shear_ratio: float
    status: int
    iterations: int


def steady_pack(par: Any, load: float, slip: float, oil: float, ratio: float) -> SteadyPack:
    """Return the steady state at a settled film of ``ratio`` roughnesses."""
    if par[clutch_layout.P_FIDELITY] != clutch_layout.FINE:
        return _part(par, load, slip, oil, ratio)
    shares, parts = [], []
    for k in range(int(par[clutch_layout.D_RINGS])):
        ring = clutch_rates.ring_of(par, k)
        shares.append(float(ring[clutch_layout.D_AREA] / par[clutch_layout.D_AREA]))
        parts.append(_part(ring, load * shares[-1], slip, oil, ratio))
    levers = [s * float(clutch_rates.ring_of(par, k)[clutch_layout.D_RADIUS])
              for k, s in enumerate(shares)]  # fmt: skip

    def mean(name: str, weights: list[float]) -> float:
        pairs = zip(weights, parts, strict=True)
        return sum(w * float(getattr(p, name)) for w, p in pairs) / sum(weights)

    return SteadyPack(
        contact=sum(p.contact for p in parts),
        viscous=sum(p.viscous for p in parts),
        temperature=mean("temperature", shares),
        hottest=max(p.hottest for p in parts),
        coefficient=mean("coefficient", levers),
        shear_ratio=mean("shear_ratio", levers),
        status=max(p.status for p in parts),
        iterations=sum(p.iterations for p in parts),
    )


def _part(par: Any, load: float, slip: float, oil: float, ratio: float) -> SteadyPack:
    temperature, status, rounds = clutch_steady.steady_temperature(par, load, slip, oil, ratio)
    contact, viscous, _ = clutch_steady.steady_torques(par, load, slip, ratio, temperature)
    return SteadyPack(
        float(contact), float(viscous), float(temperature), float(temperature),
        float(clutch_friction.coefficient_of(par, slip, temperature)[0]),
        float(clutch_friction.shear_of(par, slip, temperature)[0]), int(status), int(rounds),
    )  # fmt: skip
