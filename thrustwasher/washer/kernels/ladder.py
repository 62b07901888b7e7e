"""Heat into and through the thickness of a body: a ladder of first-order terms per node.

The rise of a heated face is the sum of the ladder's terms, dM/dt = (R q - M)/tau with the heat flux
q into the face; the far face stays at oil temperature, or at one that is given. Shares and times
are fitted to the exact rise of a slab, 1 - sum of 8/(pi m)^2 exp(-(pi m/2)^2 Fo) over odd m: 0.3 %
off from Fo = 0.0081 on, 0.05 s for 10 mm of steel, and exact when steady. The thin washer has one
temperature.

Heat flow through the far face is the sum of c M/R over the terms. c gives the slab's slowest part,
the heat stored when steady and no jump; by reciprocity it is also how a face follows when all of a
slab is warmer than its far face. Before a slab is warmed through the heat stored is up to 6 % off.

A slab whose far face is insulated keeps all heat. Its first term is its mean rise, dM/dt = q over
the heat that warms it by 1 K; what its face is warmer is the sum of three more terms, fitted to
Fo + 1/3 - sum of 2/(pi n)^2 exp(-(pi n)^2 Fo): 0.12 % off from Fo = 0.0081 on, and exact later.

A step is taken in two stages (Alexander 1977): the flux at ``STAGE`` of it from one that is held so
far, then the flux at its end from one that is linear through both. A body of one temperature then
sees the same coefficient in both stages; others nearly.
"""

from typing import NamedTuple

import numpy as np

from ...numerics.arrays import clear, copy
from ...numerics.jit import Array, kernel
from ...tribology.lumped_body import exponential_weights
from . import layout as L
from .constants import WasherModel, of_body
from .heat import far_rise
from .workspace import Fields, Point, Workspace, fields_of, model_of

SHARES = (0.819646, 0.113430, 0.066924)  # R over thickness/conductivity
TIMES = (0.399510, 0.032111, 0.003693)  # tau over thickness^2/diffusivity
FAR_FIRST = (0.5 - TIMES[1]) / (TIMES[0] - TIMES[1])
FAR = (FAR_FIRST, 1.0 - FAR_FIRST, 0.0)  # c: sum 1, with the times 1/2
N_SLAB = 3
# Of an insulated slab, behind its mean rise.
KEPT_SHARES = (0.0, 1.0 / 3.0 - 0.122925, 0.068059, 0.054866)
KEPT_TIMES = (0.0, 0.0988596, 0.0176834, 0.00281619)
STAGE = 1.0 - 0.5**0.5  # where the first of two stages ends, as a share of a step
HELD = 1e10  # [W/(m^2 K)] conductance that lets no temperature move
LEAST_STEP = 1e-6  # [s] in which no temperature moves
BODIES = (L.OF_CARRIER, L.OF_WASHER, L.OF_GEAR)
WITH_LADDER = (L.OF_CARRIER, L.OF_GEAR)
# States of model exchange: bending [rad], energy [J], then mean temperatures [K]: of the faces of
# carrier and gear, each with what terms of the ladder after the first have of it; of the washer.
X_BEND, X_ENERGY, X_CARRIER, X_WASHER, X_GEAR, N_STATES = 0, 1, 2, 5, 6, L.N_STATES
REFERENCE = 293.15  # [K] of the far face, where a term's state is its rise


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
    is_insulated: bool  # at the far face


class Term(NamedTuple):
    """A term of a ladder: dM/dt = (R q - M)/tau, or of an insulated body's mean rise q/storage."""

    resistance: float  # R [m^2 K/W]; 0 of a mean rise
    time: float  # tau [s]; 0 of a mean rise
    far: float  # c/R [W/(m^2 K)]: heat through the far face over M
    holds: float  # [J/(m^2 K)] heat stored over M
    falls: float  # c: what M falls by as all outside becomes 1 K warmer
    settled: float  # M over the rise of a face that has been as warm for long


@kernel
def body_of(m: WasherModel, body: int) -> Body:
    """Return a body: OF_CARRIER, OF_WASHER or OF_GEAR."""
    at, step, first, weight = m.washer_at, m.washer_step, 0, m.weight1
    thickness, conductivity = m.washer_thickness, m.washer_conductivity
    if body == L.OF_CARRIER:
        at, step = m.carrier_at, m.carrier_step
        thickness, conductivity = m.carrier_thickness, m.carrier_conductivity
    elif body == L.OF_GEAR:
        at, step, first, weight = m.gear_at - m.i_g, m.gear_step, m.i_g, m.weight2
        thickness, conductivity = m.gear_thickness, m.gear_conductivity
    density = of_body(m.par, L.P_DENSITY, body)
    heat = of_body(m.par, L.P_SPECIFIC_HEAT, body)
    return Body(
        at=at,
        step=step,
        first=first,
        columns=m.n_t if step > 0 else 1,
        weight=weight,
        conductance=conductivity / thickness,
        storage=density * heat * thickness,
        is_lumped=m.par[L.P_BODY_STORAGE] == L.LUMPED,
        is_insulated=m.is_insulated and body == L.OF_GEAR,
    )


@kernel
def term(b: Body, k: int) -> Term:
    """Return a term of a body's ladder."""
    time = b.storage / b.conductance
    if b.is_insulated:
        if k == 0:
            return Term(0.0, 0.0, 0.0, b.storage, 1.0, 1.0)
        share = 0.0 if b.is_lumped else KEPT_SHARES[k]
        return Term(share / b.conductance, KEPT_TIMES[k] * time, 0.0, 0.0, 0.0, 0.0)
    if b.is_lumped or k == N_SLAB:
        share = 1.0 if k == 0 else 0.0
        far = share * b.conductance
        return Term(share / b.conductance, time, far, far * time, share, share)
    time *= TIMES[k]
    resistance, far = SHARES[k] / b.conductance, FAR[k] / SHARES[k] * b.conductance
    return Term(resistance, time, far, far * time, far * resistance, resistance * b.conductance)


@kernel
def start_terms(w: Workspace, pt: Point) -> None:
    """Fill the ladders for bodies that have been as warm as they are for long.

    Those that start as warm as the oil may have a warmer far face.
    """
    m, f = model_of(w), fields_of(w)
    from_oil = m.par[L.P_THERMAL_START] == L.FROM_OIL
    for k in range(L.N_TERMS):
        clear(f.ladder[k])
    for body in WITH_LADDER:
        b = body_of(m, body)
        outside = outside_of(pt, body)
        for k in range(L.N_TERMS):
            t = term(b, k)
            share = t.falls if from_oil else t.settled
            for j in range(b.columns):
                for i in range(b.first, m.n_r):
                    node = np.uintp(b.at + j * b.step + i)
                    f.ladder[k, node] = share * (f.temp[node] - outside)


@kernel
def shift_terms(w: Workspace, warmer: float, outside: float) -> None:
    """Let the oil be warmer by ``warmer`` and the gear's far face by ``outside`` [K].

    The bodies stay as warm as they are.
    """
    m, f = model_of(w), fields_of(w)
    for body in WITH_LADDER:
        b = body_of(m, body)
        far = outside if body == L.OF_GEAR else warmer
        for k in range(L.N_TERMS):
            falls = term(b, k).falls * far
            for j in range(b.columns):
                for i in range(b.first, m.n_r):
                    f.ladder[k, np.uintp(b.at + j * b.step + i)] -= falls
    for k in range(f.temp.size):
        f.temp[np.uintp(k)] -= warmer


@kernel
def weigh(b: Body, k: int, dt: float) -> tuple[float, float, float]:
    """Return what a term keeps in ``dt``, and what the flux at its end and at its stage add.

    For a flux that is linear over ``dt``; the latter two in m^2 K/W.
    """
    t = term(b, k)
    resistance, z = t.resistance, 0.0
    if t.time > 0.0:
        z = dt / t.time
    elif t.holds > 0.0:  # a mean rise
        resistance = dt / t.holds
    kept, mean, rest = exponential_weights(z)
    z = z if t.time > 0.0 else 1.0
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
def hold_bodies(w: Workspace) -> None:
    """Let no temperature of a body move."""
    f = fields_of(w)
    f.small[L.OUT_CARRIER], f.small[L.OUT_WASHER], f.small[L.OUT_GEAR] = HELD, HELD, HELD
    copy(f.temp, f.outward)


@kernel
def set_stage(w: Workspace, pt: Point, dt: float) -> None:
    """Set what bodies take up until the stage in a step of ``dt``, of a flux that is held.

    ``f.begin``: the rises at the start.
    """
    m, f = model_of(w), fields_of(w)
    clear(f.flux)
    clear(f.outward)
    part = STAGE * dt
    for body in WITH_LADDER:
        b = body_of(m, body)
        late, early = weigh_body(b, part)
        f.small[out_of(body)] = 1.0 / (late + early)
        _add_terms(m, b, outside_of(pt, body), part, f)
    washer = body_of(m, L.OF_WASHER)
    f.small[L.OUT_WASHER] = washer.storage / part
    _add_washer(m, washer, 0.0, f)


@kernel
def set_end(w: Workspace, pt: Point, dt: float) -> None:
    """Set what bodies take up in a step of ``dt`` that has been solved for until its stage.

    Fills ``f.flux`` with the flux there, and a guess of where the step ends.
    """
    m, f = model_of(w), fields_of(w)
    _take(m, f)
    clear(f.outward)
    for body in WITH_LADDER:
        b = body_of(m, body)
        late, _ = weigh_body(b, dt)
        f.small[out_of(body)] = 1.0 / late
        _add_terms(m, b, outside_of(pt, body), dt, f)
        _guess(m, b, late, f)
    washer = body_of(m, L.OF_WASHER)
    late = STAGE * dt / washer.storage
    f.small[L.OUT_WASHER] = 1.0 / late
    _add_washer(m, washer, (1.0 - STAGE) * dt / washer.storage, f)
    _guess(m, washer, late, f)


@kernel
def out_of(body: int) -> int:
    """Return the place of a body's conductance outwards in ``Fields.small``."""
    return L.OUT_CARRIER + body - L.OF_CARRIER


@kernel
def _take(m: WasherModel, f: Fields) -> None:
    """Fill the fluxes into the bodies at a solution."""
    for body in BODIES:
        b, out = body_of(m, body), f.small[out_of(body)]
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
def outside_of(pt: Point, body: int) -> float:
    """Return how much warmer than the oil a body's far face is kept [K]."""
    return far_rise(pt) if body == L.OF_GEAR else 0.0


@kernel
def _add_terms(m: WasherModel, b: Body, outside: float, dt: float, f: Fields) -> None:
    """Add up the rises outside of a body, whose far face is warmer than the oil by ``outside``."""
    if outside != 0.0:
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                f.outward[np.uintp(b.at + j * b.step + i)] += outside
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
def set_held(w: Workspace, dt: float) -> None:
    """Have derivatives be those of a change that lasts for a whole step, from its beginning on.

    The flux into a body counts as changed by the same amount all the while: right to first order
    in a short step, and in a long one.
    """
    m, f = model_of(w), fields_of(w)
    lasts = max(dt, LEAST_STEP)
    washer = body_of(m, L.OF_WASHER)
    f.small[L.OUT_WASHER], f.small[L.OUT_OIL + 1] = washer.storage / lasts, 1.0
    out, falls = _held(body_of(m, L.OF_CARRIER), lasts, f.small[L.FAR_CARRIER : L.FAR_GEAR])
    f.small[L.OUT_CARRIER], f.small[L.OUT_OIL] = out, falls
    out, falls = _held(body_of(m, L.OF_GEAR), lasts, f.small[L.FAR_GEAR : L.FAR_GEAR + 2])
    f.small[L.OUT_GEAR], f.small[L.OUT_OIL + 2] = out, falls


@kernel
def _held(b: Body, dt: float, through: Array) -> tuple[float, float]:
    """Return the conductance outwards and by what the rise outside falls per kelvin of the oil.

    ``through`` (2,): slopes of the mean heat through the far face, see the layout.
    """
    gain, falls, part, by_oil = 0.0, 0.0, 1.0, 0.0
    for k in range(L.N_TERMS):
        t = term(b, k)
        kept, late, early = weigh(b, k, dt)
        gain += late + early
        falls += t.falls * kept
        part -= t.holds / dt * (late + early)
        by_oil -= t.holds / dt * t.falls * (1.0 - kept)
    through[0] = part / gain
    through[1] = part / gain * falls + by_oil
    return 1.0 / gain, falls


@kernel
def error_of_flux(w: Workspace) -> tuple[float, float]:
    """Return how far rises would be off had the flux been held, and the largest rise [K]."""
    m, f = model_of(w), fields_of(w)
    error, largest = 0.0, 0.0
    for body in BODIES:
        b, out = body_of(m, body), f.small[out_of(body)]
        for j in range(b.columns):
            for i in range(b.first, m.n_r):
                node = np.uintp(b.at + j * b.step + i)
                error = max(error, abs(f.temp[node] - f.outward[node] - f.flux[node] / out))
                largest = max(largest, abs(f.temp[node]))
    return error, largest


@kernel
def advance_terms(w: Workspace, dt: float) -> None:
    """Bring ladders and ``f.flux`` to the end of a step that has been solved for."""
    m, f = model_of(w), fields_of(w)
    for body in WITH_LADDER:
        b, out = body_of(m, body), f.small[out_of(body)]
        for k in range(L.N_TERMS):
            kept, late, early = weigh(b, k, dt)
            for j in range(b.columns):
                for i in range(b.first, m.n_r):
                    node = np.uintp(b.at + j * b.step + i)
                    gain = late * out * (f.temp[node] - f.outward[node]) + early * f.flux[node]
                    f.ladder[k, node] = kept * f.ladder[k, node] + gain
    _take(m, f)


@kernel
def angle_of(m: WasherModel, b: Body, j: int) -> float:
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
    carrier, _ = _through(m, body_of(m, L.OF_CARRIER), f)
    gear, _ = _through(m, body_of(m, L.OF_GEAR), f)
    return carrier + gear


@kernel
def stored_heat(w: Workspace) -> float:
    """Return the heat that the bodies hold above the temperature at their far faces [J].

    Of an insulated one above oil temperature, as of the washer.
    """
    m, f = model_of(w), fields_of(w)
    washer = body_of(m, L.OF_WASHER)
    _, carrier = _through(m, body_of(m, L.OF_CARRIER), f)
    _, gear = _through(m, body_of(m, L.OF_GEAR), f)
    stored = carrier + gear
    for j in range(washer.columns):
        angle = angle_of(m, washer, j)
        for i in range(m.n_r):
            node = np.uintp(washer.at + j * washer.step + i)
            stored += m.weight1[i] * angle * washer.storage * f.temp[node]
    return stored


@kernel
def _through(m: WasherModel, b: Body, f: Fields) -> tuple[float, float]:
    """Return heat flow through the far face [W] and heat stored [J] of a body."""
    flow, stored = 0.0, 0.0
    for k in range(L.N_TERMS):
        t, part = term(b, k), 0.0
        for j in range(b.columns):
            angle = angle_of(m, b, j)
            for i in range(b.first, m.n_r):
                part += b.weight[i] * angle * f.ladder[k, np.uintp(b.at + j * b.step + i)]
        flow += t.far * part
        stored += t.holds * part
    return flow, stored


@kernel
def state_of(body: int) -> int:
    """Return the place of a body's mean temperature among the states."""
    if body == L.OF_WASHER:
        return X_WASHER
    return X_CARRIER if body == L.OF_CARRIER else X_GEAR


@kernel
def terms_of(body: int) -> int:
    """Return how many states a body has."""
    if body == L.OF_WASHER:
        return 1
    return 3 if body == L.OF_CARRIER else L.N_TERMS


@kernel
def far_of(pt: Point, body: int) -> float:
    """Return the temperature at a body's far face [K]."""
    return pt.far_face if body == L.OF_GEAR else pt.oil_temperature


@kernel
def mean_of(m: WasherModel, b: Body, values: Array) -> tuple[float, float]:
    """Return the mean of values (n_temp,) over a body's face, and the face [m^2]."""
    total, area = 0.0, 0.0
    for j in range(b.columns):
        angle = angle_of(m, b, j)
        for i in range(b.first, m.n_r):
            weight = b.weight[i] * angle
            total += weight * values[np.uintp(b.at + j * b.step + i)]
            area += weight
    return total / area, area


@kernel
def fill_means(w: Workspace, pt: Point, cont: Array) -> None:
    """Fill the states of model exchange that ladders and temperatures in ``w`` stand for."""
    m, f = model_of(w), fields_of(w)
    for body in BODIES:
        b, place = body_of(m, body), state_of(body)
        mean, _ = mean_of(m, b, f.temp)
        cont[place] = pt.oil_temperature + mean
        for k in range(1, terms_of(body)):
            part, _ = mean_of(m, b, f.ladder[k])
            cont[np.uintp(place + k)] = part + term(b, k).falls * (far_of(pt, body) - REFERENCE)
