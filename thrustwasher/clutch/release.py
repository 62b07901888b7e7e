"""What a pack drags after it was let go: a cold release against a warm one."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..model.parameters import check_number
from ..numerics.jit import Array
from ..units import format_quantity as say
from .kernels import layout as k
from .parameters import DRUM, LOAD, OIL, SPEED, ClutchParams
from .profile import outputs_over
from .solve import prepare

AFTER = 0.1  # s: what a pack drags is said so long after it was let go
COLD, WARM = 283.15, 353.15  # K: a release is called cold below; what it is compared with
LONGEST = 60.0  # s: no pack is followed further
FALL = 1e-3  # s in which its load goes
LAW = (
    "Reynolds' equation between flat plates that part evenly, at -40 .. 150 degC; there is no "
    "measurement to compare with"
)


@dataclass(frozen=True, slots=True)
class Release:
    """A pack ``after`` some time [s] since its load went, slip and oil held, SI units."""

    oil_temperature: float
    after: float
    friction_torque: float  # [N m] that it drags, with the sign of the slip
    energy: float  # [J] heat it has made since
    film_ratio: float
    temperature: float  # [K] of the interface
    open_after: float  # [s] in which the film has come to half its clearance; inf: not in 60 s


def release_clutch(
    params: ClutchParams,
    *,
    load: float,
    speed: float,
    oil_temperature: float = 297.15,
    drum_speed: float = 0.0,
    after: float = AFTER,
    fidelity: str = "field",
) -> Release:
    """Return what a pack drags that was pressed and settled until its load went within 1 ms.

    Parameters
    ----------
    params : the pack
    load : axial force before [N]
    speed : slip [rad/s], held
    oil_temperature : [K]; the steel is as warm when the load goes
    drum_speed : [rad/s] of the drum
    after : time since then [s], up to 60
    fidelity : "field" or "fine"; the others have no film

    Raises
    ------
    ParameterError : an argument is out of range; the message names it
    SolveError : an interval could not be integrated

    Notes
    -----
    Derived in docs/theory/clutch/release.md, with what it leaves out.

    Examples
    --------
    >>> cold, warm = (release_clutch(ClutchParams(), load=5898.0, speed=100.0, oil_temperature=t)
    ...               for t in (253.15, 353.15))
    >>> cold.friction_torque > 2.0 * warm.friction_torque, cold.open_after > 4.0 * warm.open_after
    (True, True)
    """
    force = check_number("load", load, "N", *LOAD.range)
    slip = check_number("speed", speed, "rad/s", *SPEED.range)
    oil = check_number("oil_temperature", oil_temperature, "K", *OIL.range)
    drum = check_number("drum_speed", drum_speed, "rad/s", *DRUM.range)
    since = check_number("after", after, "s", FALL, LONGEST)
    grid = np.geomspace(FALL, LONGEST, 200)
    time = np.unique(np.concatenate([[0.0], grid, [since]]))
    par = prepare(replace(params, starts_pressed=True), fidelity)
    loads, same = np.where(time > 0.0, 0.0, force), np.ones_like(time)
    rows, _ = outputs_over(par, time, loads, slip * same, oil, drum * same)
    row = rows[int(np.searchsorted(time, since))]
    wide = rows[:, k.O_FILM] >= 0.5 * params.initial_film
    return Release(
        oil_temperature=oil,
        after=since,
        friction_torque=float(row[k.O_TORQUE]),
        energy=float(row[k.O_ENERGY]),
        film_ratio=float(row[k.O_RATIO]),
        temperature=float(row[k.O_TEMPERATURE]),
        open_after=float(time[int(np.argmax(wide))]) if wide.any() else float("inf"),
    )


def cold_release(
    params: ClutchParams,
    fidelity: str,
    *,
    time: Array,
    load: Array,
    speed: Array,
    torque: Array,
    film_ratio: Array,
    energy: Array,
    oil_temperature: float,
) -> Iterator[str]:
    """Yield a line if a pack with a film is let go cold, against the same warm.

    ``time`` .. ``energy`` : (n,) a time history of the pack; ``fidelity`` : its level.
    """
    if oil_temperature >= COLD or fidelity not in ("field", "fine") or not params.film_dynamics:
        return
    pressed = load >= k.OPEN_PRESSURE * params.lining_area / params.faces
    gone = np.flatnonzero(pressed[:-1] & ~pressed[1:]) + 1
    if not len(gone) or time[gone[-1]] + AFTER > time[-1]:
        return
    begin = int(gone[-1])
    until = float(time[begin]) + AFTER
    drag, slip, ratio, heat = (
        float(np.interp(until, time, x)) for x in (torque, speed, film_ratio, energy)
    )
    if abs(slip) < 1.0 or pressed[(time >= time[begin]) & (time <= until)].any():
        return
    heat -= float(energy[begin])
    warm = release_clutch(
        params, load=float(load[:begin].max()), speed=slip, oil_temperature=WARM, fidelity=fidelity
    )
    yield (
        f"let go at {time[begin]:.4g} s with oil of {say(oil_temperature, 'K')}: {AFTER:g} s later "
        f"it drags {say(abs(drag), 'N.m')} at {say(abs(slip), 'rad/s')} and has made "
        f"{say(heat, 'J')}, its film is {ratio:.3g} roughnesses thick (with oil of "
        f"{say(WARM, 'K')} {say(abs(warm.friction_torque), 'N.m')}). By {LAW}"
    )
