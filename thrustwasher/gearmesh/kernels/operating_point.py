# mypy: disable-error-code="no-any-return"
"""The mesh at one operating point: heat of its loss or that of the paper, safety; its changes.

Pitting, scuffing, micropitting: ISO 6336-2, ISO/TS 6336-20 and -22 as publicly quoted; the
standards' own text was not at hand.
"""

import math

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import floored, floored_slope, soft_most
from . import layout as L
from .line_of_action import mesh_changes, solve_mesh
from .loss_heat import heat_of_loss, loss_changes
from .mesh_point import LEAST_LINE_LOAD, thinning

LEAST_RISE = 1.0  # K of the contact over the oil that the safety against scuffing counts at least


@kernel
def scuffing_temperature(par: Array, viscosity: float) -> float:
    """Return Theta_S [K]; ``viscosity`` [Pa s] at the oil's temperature."""
    return 353.15 + par[L.D_SCUFFING] * math.exp(-0.05 * math.log(1e3 * viscosity))


@kernel
def fill_safety(par: Array, torque: float, oil: float, field: Array) -> None:
    """Fill pitting stress and all safety factors from bulk, flash, film and the oil's viscosity."""
    line = floored(torque * par[L.D_LOAD], LEAST_LINE_LOAD)
    field[L.F_PITTING_STRESS] = par[L.D_PITTING] * math.sqrt(line)
    field[L.F_PITTING_SAFETY] = 1.0 / (par[L.D_PITTING_USED] * math.sqrt(line))
    limit = scuffing_temperature(par, field[L.F_BULK_VISCOSITY])
    rise = field[L.F_BULK] + field[L.F_FLASH_MAX] - oil
    counted, _ = soft_most(rise, LEAST_RISE, 0.5 * LEAST_RISE)
    field[L.F_SCUFFING_SAFETY] = (limit - oil) / counted
    field[L.F_SCUFFING_MARGIN] = limit - oil - rise
    permissible = par[L.P_PERMISSIBLE_FILM_RATIO]
    field[L.F_MICROPITTING] = L.NO_LIMIT
    if permissible > 0.0:
        field[L.F_MICROPITTING] = field[L.F_FILM_GF] / permissible
    field[L.F_ROOT_STRESS] = max(par[L.D_ROOT_PINION], par[L.D_ROOT_GEAR]) * line
    if not par[L.D_ROOT_PINION] > 0.0:
        field[L.F_ROOT_STRESS] = L.NO_DATA
    field[L.F_ROOT_SAFETY] = L.NO_LIMIT
    if par[L.D_ROOT_USED] > 0.0:
        field[L.F_ROOT_SAFETY] = 1.0 / (par[L.D_ROOT_USED] * line)


@kernel
def safety_changes(
    par: Array,
    torque: float,
    oil: float,
    field: Array,
    change: tuple[float, float, float],
    dout: Array,
) -> None:
    """Fill the changes of ``fill_safety``, from those of bulk, flash and film ratio in ``dout``.

    ``change``: of torque [N m], oil [K], relative of the oil's viscosity.
    """
    line = torque * par[L.D_LOAD]
    load = floored_slope(line, LEAST_LINE_LOAD) * par[L.D_LOAD] * change[0]
    load *= 0.5 / floored(line, LEAST_LINE_LOAD)
    bent = field[L.F_ROOT_STRESS] if par[L.D_ROOT_PINION] > 0.0 else 0.0
    dout[L.F_ROOT_STRESS] = 2.0 * bent * load
    dout[L.F_ROOT_SAFETY] = 0.0
    if par[L.D_ROOT_USED] > 0.0:
        dout[L.F_ROOT_SAFETY] = -2.0 * field[L.F_ROOT_SAFETY] * load
    dout[L.F_PITTING_STRESS] = field[L.F_PITTING_STRESS] * load
    dout[L.F_PITTING_SAFETY] = -field[L.F_PITTING_SAFETY] * load
    limit = scuffing_temperature(par, field[L.F_BULK_VISCOSITY])
    lower = -0.05 * (limit - 353.15) * change[2]
    rise = field[L.F_BULK] + field[L.F_FLASH_MAX] - oil
    counted, rest = soft_most(rise, LEAST_RISE, 0.5 * LEAST_RISE)
    more = dout[L.F_BULK] + dout[L.F_FLASH_MAX] - change[1]
    slope = rest * more / counted
    dout[L.F_SCUFFING_SAFETY] = (lower - change[1]) / counted - field[L.F_SCUFFING_SAFETY] * slope
    dout[L.F_SCUFFING_MARGIN] = lower - change[1] - more
    permissible = par[L.P_PERMISSIBLE_FILM_RATIO]
    dout[L.F_MICROPITTING] = dout[L.F_FILM_GF] / permissible if permissible > 0.0 else 0.0


@kernel
def solve_point(
    par: Array,
    torque: float,
    speed: float,
    oil: float,
    drive: float,
    state: Array,
    dt: float,
    work: Array,
) -> int:
    """Fill ``work[:N_FIELD]``, except loss torque and power; return 0, an advice or a failure.

    ``drive`` [W]: the power that the mesh transmits, as it counts for the loss.
    """
    if par[L.P_FILM_HEAT] == L.LOSS:
        status = heat_of_loss(par, torque, speed, oil, drive, state, dt, work)
    else:
        status = solve_mesh(par, torque, speed, oil, work)
        work[L.F_MEAN_FRICTION], work[L.F_FLASH_MAX] = work[L.F_FRICTION], work[L.F_FLASH]
        work[L.F_OIL_HEAT] = work[L.F_FRICTION] * par[L.D_LOSS] * drive
        work[L.F_STORED] = 0.0
        work[L.F_PRESSURE_MAX] = 4.0 / math.pi * work[L.F_PRESSURE]
        work[L.F_FILM_GF] = work[L.F_FILM] / par[L.D_MEAN]
        work[L.F_GF_PLACE] = -1.0
    fill_safety(par, torque, oil, work)
    return status


@kernel
def point_changes(
    par: Array,
    work: Array,
    torque: float,
    speed: float,
    oil: float,
    rate: float,
    more: float,
    seed: Array,
    warms: float,
    dout: Array,
) -> None:
    """Fill the changes along ``seed`` of all outputs but loss torque and power.

    ``rate`` [W]: loss of a friction of 1; ``more``: its change; ``warms`` [K]: that of the bodies
    where they are held.
    """
    if par[L.P_FILM_HEAT] == L.LOSS:
        loss_changes(par, torque, speed, oil, rate, more, seed, warms, work, dout)
    else:
        mesh_changes(par, work, torque, speed, oil, seed, dout)
        dout[L.F_MEAN_FRICTION], dout[L.F_FLASH_MAX] = dout[L.F_FRICTION], dout[L.F_FLASH]
        dout[L.F_BULK], dout[L.F_STORED] = seed[L.I_OIL], 0.0
        dout[L.F_OIL_HEAT] = more * work[L.F_FRICTION] + rate * dout[L.F_FRICTION]
        stress = dout[L.F_STRESS] / work[L.F_STRESS]
        dout[L.F_PRESSURE_MAX] = work[L.F_PRESSURE_MAX] * stress
        dout[L.F_FILM_GF] = dout[L.F_FILM] / par[L.D_MEAN]
        dout[L.F_SCUFFING_FRICTION] = dout[L.F_FRICTION]
    change = (seed[L.I_LOAD], seed[L.I_OIL], thinning(par, oil) * seed[L.I_OIL])
    safety_changes(par, torque, oil, work, change, dout)
