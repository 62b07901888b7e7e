"""Heat balance of oil film, carrier, washer and gear: residual, and its change along a direction.

Finite volumes in the plane, conduction across by resistances. Sources and conduction across use
the same weights as force and torque, so that friction power in is heat out to rounding. A body
that turns under the load has one balance per ring, the sum over its nodes; the places of its
temperatures (see the layout) make it so. Near rest a washer may give a share of the torque of
sliding; its oil and its asperities make that share of the heat.

Film, where its oil carries heat: carried out - in + exchange with the walls = heat made in it,
exchange 12 K_oil/h_T per area to the mean of both walls; its heat and that of the asperities
enter carrier and washer by the heat split. Otherwise the heat made enters them at once.

Temperatures are rises above the oil: no digits are lost on a cool washer.

Source: Jackson & Green Eq 19-29; R1 = h_T/K_oil + t_w/(2 K_w), likewise R2. Derived in
docs/theory/washer.md: the film.
"""

import numpy as np

from ...numerics.arrays import clear
from ...numerics.jit import Array, kernel
from . import layout as L
from .constants import WasherModel
from .film import hold_pressure, let_flows_follow, let_pressure_follow
from .gap import film_change
from .layout import TILT_X, TILT_Y, Z_GEAR, Z_WASHER
from .throughflow import carry, carry_change, flows_change, supply_rise
from .workspace import Fields, Point, vector


@kernel
def far_rise(pt: Point) -> float:
    """Return how much warmer than the oil the gear's far face is kept [K]."""
    return pt.far_face - pt.oil_temperature


@kernel
def set_steady(m: WasherModel, pt: Point, f: Fields) -> None:
    """Let heat flow out as in steady state, and all friction of sliding make heat."""
    f.small[L.GIVEN], f.small[L.GIVEN_SLOPE] = 1.0, 0.0
    let_out(m, pt, f)


@kernel
def let_out(m: WasherModel, pt: Point, f: Fields) -> None:
    """Let heat flow out through carrier and gear as in steady state, none into the washer."""
    f.small[L.OUT_CARRIER] = m.carrier_conductivity / m.carrier_thickness
    f.small[L.OUT_WASHER] = 0.0
    f.small[L.OUT_GEAR] = 0.0 if m.is_insulated else m.gear_conductivity / m.gear_thickness
    clear(f.small[L.OUT_OIL : L.FAR_CARRIER])
    f.small[L.FAR_CARRIER], f.small[L.FAR_CARRIER + 1] = f.small[L.OUT_CARRIER], 0.0
    f.small[L.FAR_GEAR], f.small[L.FAR_GEAR + 1] = f.small[L.OUT_GEAR], 0.0
    clear(f.outward)
    outside = far_rise(pt)
    if outside != 0.0:
        for j in range(m.n_t):
            gear = m.gear_at + j * m.gear_step - m.i_g
            for i in range(m.i_g, m.n_r):
                f.outward[np.uintp(gear + i)] = outside


@kernel
def conduct(m: WasherModel, temp: Array, f: Fields, heat: Array) -> None:
    """Fill ``heat`` [W], what leaves each node by conduction, outwards to rises of 0."""
    n_r, n_t, i_g = m.n_r, m.n_t, m.i_g
    kc = m.carrier_conductivity * m.carrier_thickness
    kw = m.washer_conductivity * m.washer_thickness
    kg = m.gear_conductivity * m.gear_thickness
    out_c, out_w = f.small[L.OUT_CARRIER], f.small[L.OUT_WASHER]
    out_g = f.small[L.OUT_GEAR]
    half = m.washer_thickness / (2.0 * m.washer_conductivity)
    per_oil = 1.0 / m.oil_conductivity
    one = np.uintp(1)
    clear(heat)
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        carrier, carrier_on = m.carrier_at + j * m.carrier_step, m.carrier_at + jn * m.carrier_step
        washer, washer_on = m.washer_at + j * m.washer_step, m.washer_at + jn * m.washer_step
        gear, gear_on = m.gear_at + j * m.gear_step - i_g, m.gear_at + jn * m.gear_step - i_g
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            ic, iw = np.uintp(carrier + i), np.uintp(washer + i)
            w1 = m.weight1[i] * m.weight_t[j]
            across = w1 * (temp[ic] - temp[iw]) / (f.ht[k] * per_oil + half)
            heat[ic] += across + w1 * out_c * temp[ic]
            heat[iw] += w1 * out_w * temp[iw] - across
            # to the next column
            g = m.log_width[i] * m.per_step[j]
            if m.carrier_step > 0:
                on = np.uintp(carrier_on + i)
                flow = kc * g * (temp[ic] - temp[on])
                heat[ic] += flow
                heat[on] -= flow
            if m.washer_step > 0:
                on = np.uintp(washer_on + i)
                flow = kw * g * (temp[iw] - temp[on])
                heat[iw] += flow
                heat[on] -= flow
            if i + 1 < n_r:  # to the next radius
                g = m.along[i] * m.width_t[j]
                flow = kc * g * (temp[ic] - temp[ic + one])
                heat[ic] += flow
                heat[ic + one] -= flow
                flow = kw * g * (temp[iw] - temp[iw + one])
                heat[iw] += flow
                heat[iw + one] -= flow
            if i >= i_g:
                ig = np.uintp(gear + i)
                w2 = m.weight2[i] * m.weight_t[j]
                across = w2 * (temp[iw] - temp[ig]) / (f.ht2[k] * per_oil + half)
                heat[iw] += across
                heat[ig] += w2 * out_g * temp[ig] - across
                if m.gear_step > 0:
                    on = np.uintp(gear_on + i)
                    flow = kg * m.gear_width[i] * m.per_step[j] * (temp[ig] - temp[on])
                    heat[ig] += flow
                    heat[on] -= flow
                if i + 1 < n_r:
                    flow = kg * m.along[i] * m.width_t[j] * (temp[ig] - temp[ig + one])
                    heat[ig] += flow
                    heat[ig + one] -= flow


@kernel
def _from_outside(m: WasherModel, f: Fields, heat: Array) -> float:
    """Take from ``heat`` what the rises outside bring in; return the size of what flows out [W]."""
    out_c, out_w = f.small[L.OUT_CARRIER], f.small[L.OUT_WASHER]
    out_g = f.small[L.OUT_GEAR]
    size = 0.0
    for j in range(m.n_t):
        carrier = m.carrier_at + j * m.carrier_step
        washer = m.washer_at + j * m.washer_step
        gear = m.gear_at + j * m.gear_step - m.i_g
        for i in range(m.n_r):
            ic, iw = np.uintp(carrier + i), np.uintp(washer + i)
            w1 = m.weight1[i] * m.weight_t[j]
            heat[ic] -= w1 * out_c * f.outward[ic]
            heat[iw] -= w1 * out_w * f.outward[iw]
            # no balance is better than the rounding of a temperature
            size += w1 * out_c * (abs(f.temp[ic] - f.outward[ic]) + 1e-8 * abs(f.temp[ic]))
            size += w1 * out_w * (abs(f.temp[iw] - f.outward[iw]) + 1e-8 * abs(f.temp[iw]))
            if i >= m.i_g:
                ig = np.uintp(gear + i)
                w2 = m.weight2[i] * m.weight_t[j] * out_g
                heat[ig] -= w2 * f.outward[ig]
                size += w2 * (abs(f.temp[ig] - f.outward[ig]) + 1e-8 * abs(f.temp[ig]))
    return size


@kernel
def _by_pressure(m: WasherModel, f: Fields, to: Array) -> None:
    """Fill ``to`` (n,), the heat that pressure flow makes around each node [W]."""
    n_r, n_t = m.n_r, m.n_t
    clear(to)
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        for i in range(n_r - 1):
            k, o = np.uintp(j * n_r + i), np.uintp(jn * n_r + i)
            drop = f.p[k] - f.p[o]
            made = 0.5 * f.ct[k] * (f.fluidity[k] + f.fluidity[o]) * drop * drop
            to[k] += made
            to[o] += made
            o = k + np.uintp(1)
            drop = f.p[k] - f.p[o]
            made = 0.5 * f.cr[k] * (f.fluidity[k] + f.fluidity[o]) * drop * drop
            to[k] += made
            to[o] += made


@kernel
def _make_heat(m: WasherModel, pt: Point, temp: Array, f: Fields) -> None:
    """Fill heat made in the film [W], its conductance to the walls [W/K] and the oil's outlet rise.

    The outlet rise is that of the oil that leaves a node above the oil supplied [K].
    """
    warmer = supply_rise(m, pt)
    by_pressure = m.pressure_shear > 0.0
    if by_pressure:
        _by_pressure(m, f, f.made)
    for j in range(m.n_t):
        film = m.film_at + j * m.film_step
        carrier = m.carrier_at + j * m.carrier_step
        washer = m.washer_at + j * m.washer_step
        for i in range(m.n_r):
            k = np.uintp(j * m.n_r + i)
            w1 = m.weight1[i] * m.weight_t[j]
            v = pt.speed * m.r[i]
            part = 1.0
            if m.only_liquid:
                part = f.liquid[k]
            per_gap = w1 * part / f.ht[k]
            shear = per_gap * f.mu[k] * v * v
            if by_pressure:
                shear += f.made[k]
            f.made[k] = f.small[L.GIVEN] * m.film_heat_fraction * shear
            f.exchange[k] = m.film_exchange * per_gap
            if m.film_step > 0:
                rise = temp[np.uintp(film + i)]
                walls = 0.5 * (temp[np.uintp(carrier + i)] + temp[np.uintp(washer + i)])
                left = f.made[k] - f.exchange[k] * (rise - walls)
                twice = 2.0 * m.oil_storage * f.liquid[k] * f.leaving[k] + f.exchange[k]
                f.outlet[k] = rise - warmer + left / twice
                f.edge[k] = rise - warmer + f.across[k] * left / twice


@kernel
def heat_residual(m: WasherModel, pt: Point, temp: Array, f: Fields) -> float:
    """Fill ``f.heat`` [W], heat leaving each node less heat made; return the heat made [W]."""
    n_r = m.n_r
    omega = abs(pt.speed)
    friction = f.small[L.GIVEN] * f.small[L.FRICTION]
    conduct(m, temp, f, f.heat)
    f.small[L.OUT_SIZE] = 0.0
    if f.small[L.OUT_WASHER] > 0.0 or far_rise(pt) != 0.0:  # in time, or not to the oil
        f.small[L.OUT_SIZE] = _from_outside(m, f, f.heat)
    _make_heat(m, pt, temp, f)
    cooled = m.film_step > 0
    if cooled:
        carry(m, f, f.heat)
    made = 0.0
    for j in range(m.n_t):
        film = m.film_at + j * m.film_step
        carrier = m.carrier_at + j * m.carrier_step
        washer = m.washer_at + j * m.washer_step
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            ic, iw = np.uintp(carrier + i), np.uintp(washer + i)
            rubbing = m.weight1[i] * m.weight_t[j] * friction * f.pc[k] * omega * m.r[i]
            made += f.made[k] + rubbing
            if cooled:
                t = np.uintp(film + i)
                into = f.exchange[k] * (temp[t] - 0.5 * (temp[ic] + temp[iw]))
                f.heat[t] += into - f.made[k]
                rubbing += into
            else:
                rubbing += f.made[k]
            f.heat[ic] -= m.heat_split * rubbing
            f.heat[iw] -= (1.0 - m.heat_split) * rubbing
    return made


@kernel
def contact_change(small: Array, dq: Array) -> float:
    """Return the change of the contact force of film 1 [N] as the positions change."""
    slopes = vector(small, L.CONTACT_SLOPES)
    change = 0.0
    for c in range(4):
        change += slopes[c] * dq[c]
    return change


@kernel
def _pressure_change(m: WasherModel, f: Fields, dq: Array, to: Array) -> None:
    """Fill ``to`` (n,), the change of `_by_pressure`; fluidity changes are in ``f.lag[:, 0]``."""
    n_r, n_t = m.n_r, m.n_t
    clear(to)
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        for i in range(n_r - 1):
            k, o = np.uintp(j * n_r + i), np.uintp(jn * n_r + i)
            x, y = m.middle[i] * m.cos_face[j], m.middle[i] * m.sin_face[j]
            dh = dq[Z_WASHER] + y * dq[TILT_X] - x * dq[TILT_Y]
            drop, ddrop = f.p[k] - f.p[o], f.dp[k] - f.dp[o]
            fluid, dfluid = f.fluidity[k] + f.fluidity[o], f.lag[k, 0] + f.lag[o, 0]
            slope = f.dct[k] * dh * fluid + f.ct[k] * dfluid
            made = (0.5 * slope * drop + f.ct[k] * fluid * ddrop) * drop
            to[k] += made
            to[o] += made
            x, y = f.arm_cr[k] * m.cos[j], f.arm_cr[k] * m.sin[j]
            dh = dq[Z_WASHER] + y * dq[TILT_X] - x * dq[TILT_Y]
            o = k + np.uintp(1)
            drop, ddrop = f.p[k] - f.p[o], f.dp[k] - f.dp[o]
            fluid, dfluid = f.fluidity[k] + f.fluidity[o], f.lag[k, 0] + f.lag[o, 0]
            slope = f.dcr[k] * dh * fluid + f.cr[k] * dfluid
            made = (0.5 * slope * drop + f.cr[k] * fluid * ddrop) * drop
            to[k] += made
            to[o] += made


@kernel
def let_film_follow(
    m: WasherModel, pt: Point, change: Point, q: Array, dq: Array, dtemp: Array, f: Fields
) -> None:
    """Fill the changes of pressures, flows and liquid that all else brings."""
    hold_pressure(m, pt, change, dq, dtemp, f)
    let_pressure_follow(m, f)
    let_flows_follow(m, f)
    if m.film_step > 0:
        flows_change(m, pt, q, dq, f)


@kernel
def heat_change(
    m: WasherModel,
    pt: Point,
    change: Point,
    q: Array,
    dq: Array,
    dtemp: Array,
    f: Fields,
    heat: Array,
) -> float:
    """Fill ``heat`` [W], the change of the heat residual; return that of what rims carry away [W].

    ``change`` is that of the operating point, ``dq`` (4,) of the positions, ``dtemp`` (n_temp,) of
    the temperatures; `let_film_follow` has filled what the film does.
    """
    n_r, i_g = m.n_r, m.i_g
    half = m.washer_thickness / (2.0 * m.washer_conductivity)
    per_oil = 1.0 / m.oil_conductivity
    omega, domega = abs(pt.speed), 0.0
    if pt.speed != 0.0:
        domega = change.speed if pt.speed > 0.0 else -change.speed
    given, dgiven = f.small[L.GIVEN], f.small[L.GIVEN_SLOPE] * change.speed
    friction = given * f.small[L.FRICTION]
    dfriction = given * f.small[L.FRICTION_SLOPE] * contact_change(f.small, dq)
    dfriction += dgiven * f.small[L.FRICTION]
    conduct(m, dtemp, f, heat)
    # in time a rise above warmer oil is less: the body stays as warm as it was
    less_far = change.oil_temperature - change.far_face
    warms = f.small[L.OUT_WASHER] > 0.0 and change.oil_temperature != 0.0
    warms = warms or less_far != 0.0
    less_c = f.small[L.OUT_CARRIER] * f.small[L.OUT_OIL] * change.oil_temperature
    less_w = f.small[L.OUT_WASHER] * f.small[L.OUT_OIL + 1] * change.oil_temperature
    less_g = f.small[L.OUT_GEAR] * (f.small[L.OUT_OIL + 2] * change.far_face + less_far)
    cooled = m.film_step > 0
    by_pressure = m.pressure_shear > 0.0
    if by_pressure:
        _pressure_change(m, f, dq, f.doutlet)
    colder = 0.0  # change of the supply's rise above the oil
    if m.par[L.P_OIL_SUPPLY_TEMPERATURE] > 0.0:
        colder = -change.oil_temperature
    warmer = supply_rise(m, pt)
    for j in range(m.n_t):
        film = m.film_at + j * m.film_step
        carrier = m.carrier_at + j * m.carrier_step
        washer = m.washer_at + j * m.washer_step
        gear = m.gear_at + j * m.gear_step - i_g
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            ic, iw = np.uintp(carrier + i), np.uintp(washer + i)
            x, y = m.r[i] * m.cos[j], m.r[i] * m.sin[j]
            w1 = m.weight1[i] * m.weight_t[j]
            v, dv = omega * m.r[i], domega * m.r[i]
            dh = dq[Z_WASHER] + y * dq[TILT_X] - x * dq[TILT_Y]
            dht = f.dht[k] * dh
            across = m.sin[j] * dq[TILT_X] - m.cos[j] * dq[TILT_Y]
            dpc = f.dpc[k] * (dq[Z_WASHER] + f.arm_pc[k] * across)
            dmu = f.dmu[k] * (film_change(m, dtemp, j, i) + change.oil_temperature)
            per_gap = 1.0 / f.ht[k]
            part, dpart = 1.0, 0.0
            if m.only_liquid:
                part, dpart = f.liquid[k], f.dliquid[k]
            shear = (
                w1
                * v
                * per_gap
                * (
                    part * (dmu * v + 2.0 * f.mu[k] * dv - f.mu[k] * v * dht * per_gap)
                    + dpart * f.mu[k] * v
                )
            )
            if by_pressure:
                shear += f.doutlet[k]
            shear *= given * m.film_heat_fraction
            shear += dgiven / given * f.made[k]
            rubbing = w1 * (friction * (dpc * v + f.pc[k] * dv) + dfriction * f.pc[k] * v)
            if cooled:
                t = np.uintp(film + i)
                over = f.temp[t] - 0.5 * (f.temp[ic] + f.temp[iw])
                dover = dtemp[t] - 0.5 * (dtemp[ic] + dtemp[iw])
                dexchange = m.film_exchange * w1 * per_gap * (dpart - part * dht * per_gap)
                into = f.exchange[k] * dover + dexchange * over
                heat[t] += into - shear
                rubbing += into
                twice = 2.0 * m.oil_storage * f.liquid[k] * f.leaving[k] + f.exchange[k]
                dtwice = f.dliquid[k] * f.leaving[k] + f.liquid[k] * f.dleaving[k]
                dtwice = 2.0 * m.oil_storage * dtwice + dexchange
                less = f.outlet[k] - f.temp[t] + warmer  # by which the oil leaves warmer
                dless = (shear - into - less * dtwice) / twice
                f.doutlet[k] = dtemp[t] - colder + dless
                f.dedge[k] = dtemp[t] - colder + f.across[k] * dless + f.dacross[k] * less
            else:
                rubbing += shear
            res = f.ht[k] * per_oil + half
            across = w1 * (f.temp[ic] - f.temp[iw]) / (res * res) * dht * per_oil
            heat[ic] -= across + m.heat_split * rubbing
            heat[iw] += across - (1.0 - m.heat_split) * rubbing
            if warms:
                heat[ic] += w1 * less_c
                heat[iw] += w1 * less_w
            if i >= i_g:
                ig = np.uintp(gear + i)
                w2 = m.weight2[i] * m.weight_t[j]
                dh2 = dq[Z_GEAR] - dq[Z_WASHER] - y * dq[TILT_X]
                dh2 += x * (dq[TILT_Y] - change.tilt)
                res = f.ht2[k] * per_oil + half
                across = w2 * (f.temp[iw] - f.temp[ig]) / (res * res)
                across *= f.dht2[k] * dh2 * per_oil
                heat[iw] -= across
                heat[ig] += across
                if warms:
                    heat[ig] += w2 * less_g
    if cooled:
        return carry_change(m, f, heat)
    return 0.0
