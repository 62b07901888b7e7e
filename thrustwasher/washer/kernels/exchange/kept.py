# mypy: disable-error-code="no-any-return"
"""What the washer keeps for model exchange: its last solution, from step to step."""

from ....numerics.arrays import are_equal, copy
from ....numerics.jit import Array, kernel
from ....numerics.status import MAX_ITERATIONS, OK, SINGULAR
from .. import layout as L
from ..heat import set_steady
from ..ladder import N_STATES, hold_bodies
from ..newton import EXACT, LOAD, NO_FLOOR, evaluate, make_factor, newton
from ..regime_and_status import point_of
from ..step import FINE_GRID
from ..workspace import Point, Workspace, fields_of, model_of, temperatures_of

NCONT = N_STATES
A_ANGLE, A_DAMPING, A_SPEED, A_LARGEST, NOWN = range(5)
# What is discrete: time of the next event [s], largest capacity [N m]; is the map asked; branch,
# are there several, point of the last search for folds; the present time [s], written by the
# shell, and behind it 1 if that counts: with heat in time. Then: since when the bodies' fields
# hold [s], for how long they shall [s], what is stored in bodies at the start [J], the point of the
# fields; the kept solution: its point, positions, then temperatures and pressures; the fields.
D_NEXT, D_LARGEST, D_ON_MAP, D_BRANCH, D_SEVERAL, D_SPEED, D_TILT, D_OIL = range(8)
D_NOW, D_IN_TIME, D_SINCE, D_LASTS, D_STORED, D_WAS, D_KEPT = 8, 9, 10, 11, 12, 13, 18
K_POSITIONS = D_KEPT + 5
K_FIELDS = K_POSITIONS + 4
K_SHAPES = K_FIELDS + temperatures_of(*FINE_GRID) + FINE_GRID[0] * FINE_GRID[1]
NMODE = K_SHAPES + (L.N_TERMS + 1) * temperatures_of(*FINE_GRID)
TIME_AT = D_NOW
Z_BRANCH, Z_MIXED, Z_BOUNDARY, Z_HOT, Z_RISE, Z_OUTSIDE, Z_MAP, Z_SHAPES, NSIGN = range(9)
SLOWEST = 1e-6  # rad/s; at rest friction is that of a washer that turns so fast
CLOSE = 1e-10  # of all balances, where rounding lets them come so close ...
NEARLY = 1e-7  # ... and where it does not
ITERATIONS = 14.0


@kernel
def way_of(speed: float) -> float:
    """Return the sign of a speed, 1 at rest."""
    return -1.0 if speed < 0.0 else 1.0


@kernel
def moving_point(par: Array, inp: Array) -> Point:
    """Return the operating point of a washer that turns."""
    pt = point_of(par, inp)
    speed = pt.speed
    if abs(speed) < SLOWEST:
        speed = SLOWEST * way_of(speed)
    return Point(pt.load, speed, pt.tilt, pt.oil_temperature, pt.far_face)


@kernel
def point_from(numbers: Array) -> Point:
    """Return the point that five numbers are."""
    return Point(numbers[0], numbers[1], numbers[2], numbers[3], numbers[4])


@kernel
def write_point(pt: Point, to: Array) -> None:
    """Write a point into five numbers."""
    to[0], to[1], to[2], to[3], to[4] = pt.load, pt.speed, pt.tilt, pt.oil_temperature, pt.far_face


@kernel
def keep(w: Workspace, pt: Point, discrete: Array) -> None:
    """Keep the present solution."""
    f = fields_of(w)
    write_point(pt, discrete[D_KEPT:K_POSITIONS])
    end = K_FIELDS + f.temp.size
    copy(w.q, discrete[K_POSITIONS:K_FIELDS])
    copy(f.temp, discrete[K_FIELDS:end])
    copy(f.p, discrete[end : end + f.p.size])


@kernel
def take_kept(w: Workspace, discrete: Array) -> int:
    """Take the kept solution and a heat factor made there; return a status."""
    m, f = model_of(w), fields_of(w)
    end = K_FIELDS + f.temp.size
    temp, pressure = discrete[K_FIELDS:end], discrete[end : end + f.p.size]
    at = point_from(discrete[D_KEPT:K_POSITIONS])
    set_steady(m, at, f)
    copy(discrete[K_POSITIONS:K_FIELDS], w.q)
    copy(temp, f.temp)
    copy(pressure, f.p)
    if discrete[D_IN_TIME] == 1.0:
        hold_bodies(w)
    tag = f.tag
    same = (
        tag[L.TAG_VALID] == 1.0
        and tag[L.TAG_SPEED] == at.speed
        and tag[L.TAG_TILT] == at.tilt
        and tag[L.TAG_OIL] == at.oil_temperature
        and are_equal(tag[L.TAG_POSITIONS : L.TAG_PARAMETERS], w.q)
        and are_equal(tag[L.TAG_PARAMETERS : L.TAG_OUT], w.par[: L.D_SIGMA1])
        and are_equal(tag[L.TAG_OUT : L.TAG_GIVEN], f.small[L.OUT_CARRIER : L.OUT_SIZE])
        and tag[L.TAG_GIVEN] == 1.0
        and are_equal(tag[L.N_TAG : L.N_TAG + temp.size], temp)
    )
    if same:
        return OK
    evaluate(m, at, w.q, f, False)
    if not make_factor(m, at, w.q, f.temp, f, EXACT):
        return SINGULAR
    copy(w.par[: L.D_SIGMA1], tag[L.TAG_PARAMETERS : L.TAG_OUT])
    copy(pressure, f.p)
    return OK


@kernel
def arrive(w: Workspace, pt: Point) -> int:
    """Solve for the load from here until nothing changes any more; return a status."""
    status = newton(w, pt, LOAD, pt.load, NO_FLOOR, CLOSE, ITERATIONS)
    return OK if status == MAX_ITERATIONS and w.info[L.RESIDUAL] < NEARLY else status
