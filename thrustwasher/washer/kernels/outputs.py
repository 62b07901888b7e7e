"""From a converged state to the numbers a user sees, and how they change with it."""

import math

import numpy as np

from ...numerics.arrays import are_finite
from ...numerics.jit import Array, inlined, kernel
from ...numerics.smoothing import sign_of
from ...numerics.status import NOT_FINITE, OK
from . import layout as L
from .constants import WasherModel
from .gap import dry_friction, film_change
from .heat import contact_change, far_rise
from .ladder import far_heat
from .layout import TILT_X, TILT_Y, Z_GEAR, Z_WASHER
from .newton import tilt_of
from .throughflow import find_flows, flows_change, supply_rise
from .workspace import Fields, Point, Workspace, fields_of, model_of, vector, workspace_of

MOST_MARGIN = 1000.0  # of `stick_margin`: nothing is to be held
BY_HEAT = (  # outputs in proportion to the torque
    L.O_TORQUE,
    L.O_POWER,
    L.O_COEFFICIENT,
    L.O_OIL_HEAT,
    L.O_THROUGHFLOW_HEAT,
)
RISES = (L.O_MEAN, L.O_PEAK, L.O_FILM_TEMPERATURE, L.O_OUTLET)  # over the oil as well


@kernel
def coefficient_per_torque(inner: float, outer: float, load: float) -> float:
    """Return the friction coefficient that a torque of 1 N m stands for."""
    return 1.5 * (outer**2 - inner**2) / (load * (outer**3 - inner**3))


@kernel
def stick_margin(m: WasherModel, f: Fields, torque: float) -> float:
    """Return the torque that gap 2 can hold by dry friction over the friction torque."""
    hold = 0.0
    for j in range(m.n_t):
        for i in range(m.i_g, m.n_r):
            k = np.uintp(j * m.n_r + i)
            hold += m.weight2[i] * m.weight_t[j] * f.pc2[k] * m.r[i]
    hold *= f.small[L.FRICTION2]
    if not abs(torque) * MOST_MARGIN > hold:
        return MOST_MARGIN
    return float(hold / abs(torque))


@kernel
def _through_faces(m: WasherModel, pt: Point, f: Fields) -> float:
    """Return the heat that leaves through the far faces in steady state [W]."""
    out_c = m.carrier_conductivity / m.carrier_thickness
    out_g = 0.0 if m.is_insulated else m.gear_conductivity / m.gear_thickness
    outside = far_rise(pt)
    total = 0.0
    for j in range(m.n_t):
        carrier = m.carrier_at + j * m.carrier_step
        gear = m.gear_at + j * m.gear_step - m.i_g
        for i in range(m.n_r):
            total += m.weight1[i] * m.weight_t[j] * out_c * f.temp[np.uintp(carrier + i)]
            if i >= m.i_g:
                over = f.temp[np.uintp(gear + i)] - outside
                total += m.weight2[i] * m.weight_t[j] * out_g * over
    return total


@kernel
def outputs_at(w: Workspace, pt: Point) -> bool:
    """Fill the outputs of ``w`` from its fields at the solution; return True if finite.

    Source: Jackson & Green Eq 39-43 for film 1, with the weights of the balances.
    """
    m, f, q, out = model_of(w), fields_of(w), w.q, w.outputs
    n_r, n_t = m.n_r, m.n_t
    if m.film_step == 0:
        find_flows(m, pt, q, f)
    viscous, rubbing, mean, area, hottest = 0.0, 0.0, 0.0, 0.0, -1e300
    fluid, film, flow, gone = 0.0, 0.0, 0.0, 0.0
    dry = sign_of(pt.speed) * f.small[L.FRICTION]
    per_speed = m.pressure_shear / pt.speed if pt.speed != 0.0 else 0.0
    warmer = supply_rise(m, pt)
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        own = m.film_at + j * m.film_step
        at = m.carrier_at + j * m.carrier_step
        below = m.washer_at + j * m.washer_step
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            weight = m.weight1[i] * m.weight_t[j]
            r = m.r[i]
            part = 1.0
            if m.only_liquid:
                part = f.liquid[k]
            viscous += weight * r * part * f.mu[k] * pt.speed * r / f.ht[k]
            viscous += per_speed * f.wedge[k] * (f.p[np.uintp(jn * n_r + i)] - f.p[k])
            rubbing += weight * r * dry * f.pc[k]
            carrier, washer = f.temp[np.uintp(at + i)], f.temp[np.uintp(below + i)]
            mean += 0.5 * weight * (carrier + washer)
            hottest = max(hottest, max(carrier, washer))
            fluid += weight * f.p[k]
            area += weight
            flow += f.rim[k] * f.liquid[k]
            if m.film_step > 0:
                film += weight * f.temp[np.uintp(own + i)]
                gone += m.oil_storage * f.rim[k] * f.liquid[k] * f.edge[k]
    if m.film_step == 0:
        film = mean
    torque = f.small[L.GIVEN] * (viscous + rubbing)
    power = torque * pt.speed
    kept_out = (1.0 - m.film_heat_fraction) * f.small[L.GIVEN] * viscous * pt.speed
    storage = m.par[L.P_OIL_DENSITY] * m.par[L.P_OIL_HEAT_CAPACITY]
    out[L.O_TORQUE] = torque
    out[L.O_MEAN] = pt.oil_temperature + mean / area
    out[L.O_PEAK] = pt.oil_temperature + max(hottest, mean / area)
    out[L.O_RATIO] = (q[Z_WASHER] - m.outer_radius * tilt_of(q)) / m.sigma1
    out[L.O_FILM] = out[L.O_RATIO] * m.sigma1
    out[L.O_FLUID_LOAD], out[L.O_CONTACT_LOAD] = fluid, f.small[L.CONTACT]
    out[L.O_FLUID_SHARE] = fluid / (fluid + f.small[L.CONTACT])
    per_torque = coefficient_per_torque(m.inner_radius, m.outer_radius, pt.load)
    out[L.O_COEFFICIENT] = per_torque * abs(torque)
    out[L.O_POWER] = power
    out[L.O_OIL_FLOW] = flow
    out[L.O_THROUGHFLOW_HEAT] = gone + kept_out
    if m.par[L.P_THERMAL_MODE] == L.TRANSIENT:
        faces = far_heat(m, f)
    else:
        faces = _through_faces(m, pt, f)
    out[L.O_OIL_HEAT] = out[L.O_THROUGHFLOW_HEAT] + faces
    out[L.O_OUTLET] = pt.oil_temperature + warmer
    if flow > 0.0:
        out[L.O_OUTLET] += gone / (storage * flow)
    out[L.O_FILM_TEMPERATURE] = pt.oil_temperature + film / area
    out[L.O_STICK_MARGIN] = stick_margin(m, f, torque)
    out[L.O_ENERGY], out[L.O_STORED_HEAT] = 0.0, 0.0  # of a step, not of a point
    out[L.O_OIL_ENERGY], out[L.O_ADVISED] = 0.0, 0.0
    return are_finite(out)


@kernel
def _hold_change(m: WasherModel, change: Point, dq: Array, f: Fields) -> tuple[float, float]:
    """Return the torque of `stick_margin` over its friction coefficient [N m] and its change."""
    hold, dhold = 0.0, 0.0
    for j in range(m.n_t):
        for i in range(m.i_g, m.n_r):
            k = np.uintp(j * m.n_r + i)
            x, y = m.r[i] * m.cos[j], m.r[i] * m.sin[j]
            dh2 = dq[Z_GEAR] - dq[Z_WASHER] - y * dq[TILT_X] + x * (dq[TILT_Y] - change.tilt)
            arm = m.weight2[i] * m.weight_t[j] * m.r[i]
            hold += arm * f.pc2[k]
            dhold += arm * f.dpc2[k] * dh2
    return hold, dhold


@kernel
def film_thickness_change(ro: float, q: Array, dq: Array) -> float:
    """Return the change of the least film thickness [m]; a level washer's tilt has no slope."""
    tilt = tilt_of(q)
    if tilt == 0.0:
        return float(dq[Z_WASHER])
    dip = ro * (q[TILT_X] * dq[TILT_X] + q[TILT_Y] * dq[TILT_Y]) / tilt
    return float(dq[Z_WASHER] - dip)


@inlined
def change_of_outputs(
    m: WasherModel, pt: Point, change: Point, w: Workspace, f: Fields, dout: Array
) -> int:
    """Fill ``dout`` from the change of the state, CHANGE and ``f.keep[: n_temp]``; see `sens`."""
    n_r, n_t = m.n_r, m.n_t
    out, dq, dtemp = w.outputs, vector(f.small, L.CHANGE), f.keep[: f.temp.size]
    if m.film_step == 0:
        flows_change(m, pt, w.q, dq, f)
    side, dcontact = sign_of(pt.speed), contact_change(f.small, dq)
    friction = side * f.small[L.FRICTION]
    dfriction = side * f.small[L.FRICTION_SLOPE] * dcontact
    torque, mean, area, hottest, dhottest = 0.0, 0.0, 0.0, -1e300, 0.0
    film, flow, faces, kept_out = 0.0, 0.0, 0.0, 0.0
    per_speed = m.pressure_shear / pt.speed if pt.speed != 0.0 else 0.0
    fraction = 1.0 - m.film_heat_fraction
    far_c, far_g = vector(f.small, L.FAR_CARRIER), vector(f.small, L.FAR_GEAR)
    by_oil_c = far_c[1] * change.oil_temperature
    by_oil_g = far_g[0] * (change.oil_temperature - change.far_face) + far_g[1] * change.far_face
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        at = m.carrier_at + j * m.carrier_step
        below = m.washer_at + j * m.washer_step
        gear = m.gear_at + j * m.gear_step - m.i_g
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            r = m.r[i]
            weight = m.weight1[i] * m.weight_t[j]
            dh = dq[Z_WASHER] + r * m.sin[j] * dq[TILT_X] - r * m.cos[j] * dq[TILT_Y]
            carrier, washer = f.temp[np.uintp(at + i)], f.temp[np.uintp(below + i)]
            dcarrier, dwasher = dtemp[np.uintp(at + i)], dtemp[np.uintp(below + i)]
            dfilm = film_change(m, dtemp, j, i)
            film += weight * dfilm
            dmu = f.dmu[k] * (dfilm + change.oil_temperature)
            shear = pt.speed * r / f.ht[k]
            part, dpart = 1.0, 0.0
            if m.only_liquid:
                part, dpart = f.liquid[k], f.dliquid[k]
            viscous = (
                part * shear * (dmu - f.mu[k] * f.dht[k] * dh / f.ht[k])
                + part * f.mu[k] * change.speed * r / f.ht[k]
                + dpart * f.mu[k] * shear
            )
            viscous *= weight * r
            across = m.sin[j] * dq[TILT_X] - m.cos[j] * dq[TILT_Y]
            dpc = f.dpc[k] * (dq[Z_WASHER] + f.arm_pc[k] * across)
            torque += weight * r * (friction * dpc + dfriction * f.pc[k])
            # pressure flow through the face j..j+1
            o = np.uintp(jn * n_r + i)
            across = m.sin_face[j] * dq[TILT_X] - m.cos_face[j] * dq[TILT_Y]
            dh = dq[Z_WASHER] + m.middle[i] * across
            viscous += per_speed * (
                f.dwedge[k] * dh * (f.p[o] - f.p[k]) + f.wedge[k] * (f.dp[o] - f.dp[k])
            )
            torque += viscous
            kept_out += fraction * viscous * pt.speed
            mean += 0.5 * weight * (dcarrier + dwasher)
            area += weight
            flow += f.drim[k] * f.liquid[k] + f.rim[k] * f.dliquid[k]
            faces += weight * (far_c[0] * dcarrier + by_oil_c)
            if i >= m.i_g:
                passed = far_g[0] * dtemp[np.uintp(gear + i)] + by_oil_g
                faces += m.weight2[i] * m.weight_t[j] * passed
            if max(carrier, washer) > hottest:
                hottest = max(carrier, washer)
                dhottest = dcarrier if carrier >= washer else dwasher
    given, dgiven = f.small[L.GIVEN], f.small[L.GIVEN_SLOPE] * change.speed
    torque = given * torque + dgiven / given * out[L.O_TORQUE]
    dout[L.O_TORQUE] = torque
    dout[L.O_MEAN] = change.oil_temperature + mean / area
    peak = out[L.O_PEAK] > out[L.O_MEAN]
    dout[L.O_PEAK] = change.oil_temperature + (dhottest if peak else mean / area)
    dout[L.O_FILM] = film_thickness_change(m.outer_radius, w.q, dq)
    dout[L.O_RATIO] = dout[L.O_FILM] / m.sigma1
    # film and contact together carry the load
    dfluid = change.load - dcontact
    share = out[L.O_FLUID_SHARE]
    dout[L.O_FLUID_SHARE] = ((1.0 - share) * dfluid - share * dcontact) / pt.load
    per_torque = coefficient_per_torque(m.inner_radius, m.outer_radius, pt.load)
    dout[L.O_COEFFICIENT] = (
        per_torque * sign_of(out[L.O_TORQUE]) * torque
        - out[L.O_COEFFICIENT] * change.load / pt.load
    )
    dout[L.O_POWER] = torque * pt.speed + out[L.O_TORQUE] * change.speed
    dout[L.O_OIL_FLOW] = flow
    gone = 0.0
    if m.film_step > 0:
        gone = f.small[L.RIM_CHANGE]
    elif pt.speed != 0.0:
        faster = change.speed / pt.speed + dgiven / given
        gone = given * kept_out + out[L.O_THROUGHFLOW_HEAT] * faster
    dout[L.O_THROUGHFLOW_HEAT] = gone
    dout[L.O_OIL_HEAT] = gone + faces
    dout[L.O_OUTLET] = change.oil_temperature
    if m.par[L.P_OIL_SUPPLY_TEMPERATURE] > 0.0:
        dout[L.O_OUTLET] = 0.0
    if m.film_step > 0 and out[L.O_OIL_FLOW] > 0.0:
        warmth = out[L.O_THROUGHFLOW_HEAT] * flow / out[L.O_OIL_FLOW]
        dout[L.O_OUTLET] += (gone - warmth) / (m.oil_storage * out[L.O_OIL_FLOW])
    dout[L.O_FILM_TEMPERATURE] = change.oil_temperature + film / area
    dout[L.O_ENERGY], dout[L.O_STORED_HEAT] = 0.0, 0.0
    dout[L.O_OIL_ENERGY], dout[L.O_ADVISED] = 0.0, 0.0
    dout[L.O_STICK_MARGIN] = 0.0
    hold, dhold = _hold_change(m, change, dq, f)
    if out[L.O_STICK_MARGIN] < MOST_MARGIN and hold > 0.0:
        _, slope = dry_friction(m.par, f.small[L.FORCES + L.ON_GEAR])
        relative = dhold / hold - torque / out[L.O_TORQUE]
        if f.small[L.FRICTION2] > 0.0:
            relative += slope * change.load / f.small[L.FRICTION2]
        dout[L.O_STICK_MARGIN] = out[L.O_STICK_MARGIN] * relative
    return OK if are_finite(dout) else NOT_FINITE


@kernel
def book(made: float, kept: float, dt: float, state: Array, out: Array) -> None:
    """Fill the heats of a step: what is made [J] and not kept in the bodies reaches the oil."""
    out[L.O_ENERGY] = state[L.S_ENERGY] + made
    out[L.O_STORED_HEAT] = state[L.S_STORED_HEAT] + kept
    out[L.O_OIL_ENERGY] = out[L.O_ENERGY] - out[L.O_STORED_HEAT]
    if dt > 0.0:
        out[L.O_OIL_HEAT] = made / dt - kept / dt


@kernel
def keep_book(out: Array, state: Array) -> None:
    """Remember the heats of a step."""
    state[L.S_ENERGY], state[L.S_STORED_HEAT] = out[L.O_ENERGY], out[L.O_STORED_HEAT]


@kernel
def lessen(share: float, oil: float, out: Array) -> None:
    """Let outputs of a look-up, those of sliding, be those of a share of the torque near rest.

    Rises over the ``oil`` [K] are as large as the heat that makes them.
    """
    for k in range(len(BY_HEAT)):
        out[BY_HEAT[k]] *= share
    for k in range(len(RISES)):
        out[RISES[k]] = oil + share * (out[RISES[k]] - oil)
    if out[L.O_STICK_MARGIN] < MOST_MARGIN * share:
        out[L.O_STICK_MARGIN] /= share
    else:
        out[L.O_STICK_MARGIN] = MOST_MARGIN


@kernel
def lessen_slopes(
    share: float, rise: float, oil: float, doil: float, own: Array, dout: Array
) -> None:
    """Turn the changes of a look-up's outputs, ``own``, to those of a share of the torque.

    ``rise``: relative change of the share; ``doil``: change of the ``oil`` [K].
    """
    for k in range(len(BY_HEAT)):
        at = BY_HEAT[k]
        dout[at] = share * (dout[at] + rise * own[at])
    for k in range(len(RISES)):
        at = RISES[k]
        dout[at] = doil + share * (dout[at] - doil + rise * (own[at] - oil))
    margin = own[L.O_STICK_MARGIN]
    dout[L.O_STICK_MARGIN] = (dout[L.O_STICK_MARGIN] - rise * margin) / share
    if not margin < MOST_MARGIN * share:
        dout[L.O_STICK_MARGIN] = 0.0


# rows of the fields over the nodes
F_FILM, F_PRESSURE, F_CONTACT, F_CARRIER, F_WASHER, F_GEAR, F_OIL, F_LIQUID, N_FIELDS = range(9)


@kernel
def fill_fields(par: Array, inp: Array, work: Array, rows: Array) -> None:
    """Fill fields of the present solution over the nodes, ``rows`` (N_FIELDS n + n_t,).

    Field by field, each node by node; then the nodes' angles [rad], from 0 on.

    Separation of the mean surfaces of film 1 [m], film and asperity pressure [Pa], temperatures of
    carrier and washer towards film 1, of the gear towards gap 2 (NaN inside its inner radius) and
    of the oil in film 1 (without oil cooling that of its walls) [K], share of liquid.
    """
    w, oil_temperature = workspace_of(par, work), inp[L.I_OIL]
    m, f, q, n = model_of(w), fields_of(w), w.q, int(fields_of(w).p.size)
    for j in range(m.n_t):
        slope = m.sin[j] * q[TILT_X] - m.cos[j] * q[TILT_Y]
        angle = math.atan2(m.sin[j], m.cos[j])
        rows[N_FIELDS * n + j] = angle if angle >= 0.0 else angle + 2.0 * math.pi
        for i in range(m.n_r):
            k = j * m.n_r + i
            carrier = f.temp[m.carrier_at + j * m.carrier_step + i]
            washer = f.temp[m.washer_at + j * m.washer_step + i]
            oil, gear = 0.5 * (carrier + washer), math.nan
            if m.film_step > 0:
                oil = f.temp[m.film_at + j * m.film_step + i]
            if i >= m.i_g:
                gear = f.temp[m.gear_at + j * m.gear_step + i - m.i_g]
            rows[F_FILM * n + k] = q[Z_WASHER] + m.r[i] * slope
            rows[F_PRESSURE * n + k] = f.p[k]
            rows[F_CONTACT * n + k] = f.pc[k]
            rows[F_CARRIER * n + k] = oil_temperature + carrier
            rows[F_WASHER * n + k] = oil_temperature + washer
            rows[F_GEAR * n + k] = oil_temperature + gear
            rows[F_OIL * n + k] = oil_temperature + oil
            rows[F_LIQUID * n + k] = f.liquid[k]
