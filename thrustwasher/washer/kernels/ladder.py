"""Heat into and through the thickness of a body: a ladder of first-order terms per node.

The rise of a heated face is the sum of the ladder's terms, dM/dt = (R q - M)/tau with the heat flux
q into the face; the far face stays at oil temperature. Shares and times are fitted to the exact
rise of a slab, 1 - sum of 8/(pi m)^2 exp(-(pi m/2)^2 Fo) over odd m: 0.3 % off from Fo = 0.0081 on,
0.05 s for 10 mm of steel, and exact when steady. The thin washer has one temperature.

Heat flow through the far face is the sum of c M/R over the terms. c gives the slab's slowest part,
the heat stored when steady and no jump; by reciprocity it is also how a face follows when all of a
slab is warmer than its far face. Before a slab is warmed through the heat stored is up to 6 % off.

A step is taken in two stages (Alexander 1977): the flux at ``STAGE`` of it from one that is held so
far, then the flux at its end from one that is linear through both. A body of one temperature then
sees the same coefficient in both stages; others nearly.
"""

from typing import NamedTuple

import numpy as np

from ...numerics.jit import Array, kernel
from ...tribology.lumped_body import exponential_weights
from . import layout as L
from .constants import WasherModel, of_body
from .workspace import Fields, clear, copy

SHARES = (0.819646, 0.113430, 0.066924)  # R over thickness/conductivity
TIMES = (0.399510, 0.032111, 0.003693)  # tau over thickness^2/diffusivity
FAR_FIRST = (0.5 - TIMES[1]) / (TIMES[0] - TIMES[1])
FAR = (FAR_FIRST, 1.0 - FAR_FIRST, 0.0)  # c: sum 1, with the times 1/2
STAGE = 1.0 - 0.5**0.5  # where the first of two stages ends, as a share of a step
HELD = 1e10  # [W/(m^2 K)] conductance that lets no temperature move


class Body(NamedTuple):
    """Nodes and material of a body."""

    at: int  # node (i, j) at ``at`` + j ``step`` + i
    step: int
    first: int  # radial nodes first..n_r - 1
    columns: int
    weight: Array  # (n_r,) of the radial nodes [m^2]
    conductance: float  # conductivity over thickness [W/(m^2 K)]
    storage: float  # density x specific heat x thickness [J/(m^2 K)]
    is_lumped: bool


@kernel
def _body(
    m: WasherModel, body: int, at: int, step: int, first: int, weight: Array, thickness: float,
    conductivity: float,
) -> Body:  # fmt: skip
    columns = m.n_t if step > 0 else 1
    density = of_body(m.par, L.P_DENSITY, body)
    heat = of_body(m.par, L.P_SPECIFIC_HEAT, body)
    return Body(
        at=at,
        step=step,
        first=first,
        columns=columns,
        weight=weight,
        conductance=conductivity / thickness,
        storage=density * heat * thickness,
        is_lumped=m.par[L.P_BODY_STORAGE] == L.LUMPED,
    )


@kernel
def carrier_of(m: WasherModel) -> Body:
    """Return the carrier."""
    return _body(
        m, L.OF_CARRIER, m.carrier_at, m.carrier_step, 0, m.weight1, m.carrier_thickness,
        m.carrier_conductivity,
    )  # fmt: skip


@kernel
def washer_of(m: WasherModel) -> Body:
    """Return the washer."""
    return _body(
        m, L.OF_WASHER, m.washer_at, m.washer_step, 0, m.weight1, m.washer_thickness,
        m.washer_conductivity,
    )  # fmt: skip


@kernel
def gear_of(m: WasherModel) -> Body:
    """Return the gear."""
    return _body(
        m, L.OF_GEAR, m.gear_at - m.i_g, m.gear_step, m.i_g, m.weight2, m.gear_thickness,
        m.gear_conductivity,
    )  # fmt: skip


@kernel
def term(b: Body, k: int) -> tuple[float, float, float]:
    """Return R [m^2 K/W] and tau [s] of a term, and c/R [W/(m^2 K)]."""
    time = b.storage / b.conductance
    if not b.is_lumped:
        return SHARES[k] / b.conductance, TIMES[k] * time, FAR[k] / SHARES[k] * b.conductance
    if k == 0:
        return 1.0 / b.conductance, time, b.conductance
    return 0.0, time, 0.0


@kernel
def start_terms(m: WasherModel, f: Fields) -> None:
    """Fill the ladders for bodies that have been as warm as they are for long."""
    for k in range(L.N_TERMS):
        clear(f.ladder[k])
    _start(m, carrier_of(m), f)
    _start(m, gear_of(m), f)


@kernel
def _start(m: WasherModel, b: Body, f: Fields) -> None:
    for k in range(L.N_TERMS):
        resistance, _, _ = term(b, k)
        share = resistance * b.conductance
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                node = np.uintp(b.at + j * b.step + i)
                f.ladder[k, node] = share * f.temp[node]


@kernel
def shift_terms(m: WasherModel, warmer: float, f: Fields) -> None:
    """Let all of the bodies be less warm than the oil by ``warmer`` [K] more."""
    _shift(m, carrier_of(m), warmer, f)
    _shift(m, gear_of(m), warmer, f)
    for k in range(f.temp.size):
        f.temp[np.uintp(k)] -= warmer


@kernel
def _shift(m: WasherModel, b: Body, warmer: float, f: Fields) -> None:
    for k in range(L.N_TERMS):
        resistance, _, far = term(b, k)
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                f.ladder[k, np.uintp(b.at + j * b.step + i)] -= far * resistance * warmer


@kernel
def weigh(b: Body, k: int, dt: float) -> tuple[float, float, float]:
    """Return what a term keeps in ``dt``, and what the flux at its end and at its stage add.

    For a flux that is linear over ``dt``; the latter two in m^2 K/W.
    """
    resistance, time, _ = term(b, k)
    z = dt / time
    kept, mean, rest = exponential_weights(z)
    late, early = z * rest, z * (mean - rest)  # by the fluxes at the end and at the beginning
    early /= 1.0 - STAGE
    return kept, resistance * (late - STAGE * early), resistance * early


@kernel
def weigh_body(b: Body, dt: float) -> tuple[float, float]:
    """Return what a face gains in ``dt`` by the flux at the end and at the stage [m^2 K/W]."""
    late, early = 0.0, 0.0
    for k in range(L.N_TERMS):
        _, one, two = weigh(b, k, dt)
        late += one
        early += two
    return late, early


@kernel
def hold_bodies(m: WasherModel, f: Fields) -> None:
    """Let no temperature of a body move."""
    f.small[L.OUT_CARRIER], f.small[L.OUT_WASHER], f.small[L.OUT_GEAR] = HELD, HELD, HELD
    copy(f.temp, f.outward)


@kernel
def set_stage(m: WasherModel, dt: float, f: Fields) -> None:
    """Set what bodies take up until the stage in a step of ``dt``, of a flux that is held.

    ``f.begin``: the rises at the start.
    """
    clear(f.flux)
    clear(f.outward)
    part = STAGE * dt
    carrier, washer, gear = carrier_of(m), washer_of(m), gear_of(m)
    late, early = weigh_body(carrier, part)
    f.small[L.OUT_CARRIER] = 1.0 / (late + early)
    late, early = weigh_body(gear, part)
    f.small[L.OUT_GEAR] = 1.0 / (late + early)
    f.small[L.OUT_WASHER] = washer.storage / part
    _add_terms(m, carrier, part, f)
    _add_terms(m, gear, part, f)
    _add_washer(m, washer, 0.0, f)


@kernel
def set_end(m: WasherModel, dt: float, f: Fields) -> None:
    """Set what bodies take up in a step of ``dt`` that has been solved for until its stage.

    Fills ``f.flux`` with the flux there, and a guess of where the step ends.
    """
    carrier, washer, gear = carrier_of(m), washer_of(m), gear_of(m)
    _take(m, carrier, f.small[L.OUT_CARRIER], f)
    _take(m, washer, f.small[L.OUT_WASHER], f)
    _take(m, gear, f.small[L.OUT_GEAR], f)
    clear(f.outward)
    late, _ = weigh_body(carrier, dt)
    f.small[L.OUT_CARRIER] = 1.0 / late
    _add_terms(m, carrier, dt, f)
    _guess(m, carrier, late, f)
    late, _ = weigh_body(gear, dt)
    f.small[L.OUT_GEAR] = 1.0 / late
    _add_terms(m, gear, dt, f)
    _guess(m, gear, late, f)
    late = STAGE * dt / washer.storage
    f.small[L.OUT_WASHER] = 1.0 / late
    _add_washer(m, washer, (1.0 - STAGE) * dt / washer.storage, f)
    _guess(m, washer, late, f)


@kernel
def _take(m: WasherModel, b: Body, out: float, f: Fields) -> None:
    """Fill the flux into a body at a solution."""
    for j in range(b.columns):
        for i in range(b.first, m.n_r):
            node = np.uintp(b.at + j * b.step + i)
            f.flux[node] = out * (f.temp[node] - f.outward[node])


@kernel
def _guess(m: WasherModel, b: Body, late: float, f: Fields) -> None:
    """Let the rises be those of a flux that stays."""
    for j in range(b.columns):
        for i in range(b.first, m.n_r):
            node = np.uintp(b.at + j * b.step + i)
            f.temp[node] = f.outward[node] + late * f.flux[node]


@kernel
def _add_terms(m: WasherModel, b: Body, dt: float, f: Fields) -> None:
    """Add up the rises outside of a body."""
    for k in range(L.N_TERMS):
        kept, _, early = weigh(b, k, dt)
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                node = np.uintp(b.at + j * b.step + i)
                f.outward[node] += kept * f.ladder[k, node] + early * f.flux[node]


@kernel
def _add_washer(m: WasherModel, b: Body, early: float, f: Fields) -> None:
    for j in range(b.columns):
        for i in range(m.n_r):
            node = np.uintp(b.at + j * b.step + i)
            f.outward[node] = f.begin[node] + early * f.flux[node]


@kernel
def set_held(m: WasherModel, dt: float, f: Fields) -> None:
    """Set what a change of flux that lasts for ``dt`` brings, for derivatives."""
    b = washer_of(m)
    f.small[L.OUT_WASHER], f.small[L.OUT_OIL + 1] = b.storage / dt, 1.0
    out, falls = _held(carrier_of(m), dt, f.small[L.FAR_CARRIER : L.FAR_CARRIER + 2])
    f.small[L.OUT_CARRIER], f.small[L.OUT_OIL] = out, falls
    out, falls = _held(gear_of(m), dt, f.small[L.FAR_GEAR : L.FAR_GEAR + 2])
    f.small[L.OUT_GEAR], f.small[L.OUT_OIL + 2] = out, falls


@kernel
def _held(b: Body, dt: float, through: Array) -> tuple[float, float]:
    """Return the conductance outwards and by what the rise outside falls per kelvin of the oil.

    ``through`` (2,): slopes of the mean heat through the far face, see the layout.
    """
    gain, falls, part, by_oil = 0.0, 0.0, 1.0, 0.0
    for k in range(L.N_TERMS):
        resistance, time, far = term(b, k)
        kept, late, early = weigh(b, k, dt)
        gain += late + early
        falls += far * resistance * kept
        part -= far * time / dt * (late + early)
        by_oil -= far * far * resistance * (time / dt) * (1.0 - kept)
    through[0] = part / gain
    through[1] = part / gain * falls + by_oil
    return 1.0 / gain, falls


@kernel
def error_of_flux(m: WasherModel, f: Fields) -> tuple[float, float]:
    """Return how far rises would be off had the flux been held, and the largest rise [K]."""
    error, largest = _error(m, carrier_of(m), f.small[L.OUT_CARRIER], f)
    one, two = _error(m, washer_of(m), f.small[L.OUT_WASHER], f)
    error, largest = max(error, one), max(largest, two)
    one, two = _error(m, gear_of(m), f.small[L.OUT_GEAR], f)
    return max(error, one), max(largest, two)


@kernel
def _error(m: WasherModel, b: Body, out: float, f: Fields) -> tuple[float, float]:
    error, largest = 0.0, 0.0
    for j in range(b.columns):
        for i in range(b.first, m.n_r):
            node = np.uintp(b.at + j * b.step + i)
            error = max(error, abs(f.temp[node] - f.outward[node] - f.flux[node] / out))
            largest = max(largest, abs(f.temp[node]))
    return error, largest


@kernel
def advance_terms(m: WasherModel, dt: float, f: Fields) -> None:
    """Bring ladders and ``f.flux`` to the end of a step that has been solved for."""
    carrier, washer, gear = carrier_of(m), washer_of(m), gear_of(m)
    _advance(m, carrier, f.small[L.OUT_CARRIER], dt, f)
    _advance(m, gear, f.small[L.OUT_GEAR], dt, f)
    _take(m, carrier, f.small[L.OUT_CARRIER], f)
    _take(m, washer, f.small[L.OUT_WASHER], f)
    _take(m, gear, f.small[L.OUT_GEAR], f)


@kernel
def _advance(m: WasherModel, b: Body, out: float, dt: float, f: Fields) -> None:
    for k in range(L.N_TERMS):
        kept, late, early = weigh(b, k, dt)
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                node = np.uintp(b.at + j * b.step + i)
                gain = late * out * (f.temp[node] - f.outward[node]) + early * f.flux[node]
                f.ladder[k, node] = kept * f.ladder[k, node] + gain


@kernel
def _angle(m: WasherModel, b: Body, j: int) -> float:
    """Return the angle that a node of column j stands for; of a ring, all."""
    if b.step > 0:
        return float(m.weight_t[j])
    total = 0.0
    for other in range(m.n_t):
        total += m.weight_t[other]
    return total


@kernel
def far_heat(m: WasherModel, f: Fields) -> float:
    """Return the heat that flows through the far faces of carrier and gear [W]."""
    carrier, _ = _through(m, carrier_of(m), f)
    gear, _ = _through(m, gear_of(m), f)
    return carrier + gear


@kernel
def stored_heat(m: WasherModel, f: Fields) -> float:
    """Return the heat that the bodies hold above oil temperature [J]."""
    washer = washer_of(m)
    _, carrier = _through(m, carrier_of(m), f)
    _, gear = _through(m, gear_of(m), f)
    stored = carrier + gear
    for j in range(washer.columns):
        angle = _angle(m, washer, j)
        for i in range(m.n_r):
            node = np.uintp(washer.at + j * washer.step + i)
            stored += m.weight1[i] * angle * washer.storage * f.temp[node]
    return stored


@kernel
def _through(m: WasherModel, b: Body, f: Fields) -> tuple[float, float]:
    """Return heat flow through the far face [W] and heat stored [J] of a body."""
    flow, stored = 0.0, 0.0
    for k in range(L.N_TERMS):
        _, time, far = term(b, k)
        part = 0.0
        for j in range(b.columns):
            angle = _angle(m, b, j)
            for i in range(b.first, m.n_r):
                part += b.weight[i] * angle * f.ladder[k, np.uintp(b.at + j * b.step + i)]
        flow += far * part
        stored += far * time * part
    return flow, stored
