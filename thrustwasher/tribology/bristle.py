# mypy: disable-error-code="no-any-return"
"""Friction at rest and in sliding by one state: an elastic bristle behind a transformer.

A bristle of stiffness k is bent by z [rad]; the transformer n = C/(k max(z_s, |z|)) makes of its
torque k z the torque n k z <= C of the contact, and of the slip v the rate n v. Up to 0.9 of the
bending z_s at which it slides all slip is elastic: at rest nothing creeps. Its energy k z^2/2 is
given back; the rest, T v - k z z', is heat and never below 0, for any capacity C(t).

Source: Dahl's model with the elastoplastic zone of Dupont et al. 2002; transformer, bounded rates
and damping are chosen here and proved in docs/theory/bristle.md.
"""

import math
from typing import NamedTuple

from ..numerics.jit import kernel
from ..numerics.smoothing import sign_of

FLOOR = 0.1  # of the largest capacity: the least that z_s is made of
ELASTIC = 0.9  # of z_s: below it no slip is plastic
GONE = 1e-3  # of the largest capacity: below it the bristle falls back
RETURN = 1e-3  # s, in which it does, and in which a bending beyond z_s is taken back
DAMPED = 0.5  # of k z_s: the most that the damping adds
BENT = 0.1  # of the angle: a usual bending
FREE, HELD, DWELL = 0.98, 0.95, 5e-3  # of the capacity: breaks away, holds, if for so long [s]


class Bristle(NamedTuple):
    """What a bristle is: ``stiffness`` [N m/rad], ``largest`` expected capacity [N m].

    ``speed`` [rad/s] over which it settles in sliding, ``damping`` [s] at rest over the stiffness.
    """

    stiffness: float
    largest: float
    speed: float
    damping: float


@kernel
def bristle_of(largest: float, angle: float, speed: float, damping: float) -> Bristle:
    """Return the bristle that bends by ``angle`` [rad] under its largest capacity [N m]."""
    return Bristle(largest / angle, largest, speed, damping)


@kernel
def sliding_angle(b: Bristle, capacity: float) -> float:
    """Return the bending z_s [rad] at which all slip is plastic."""
    return max(capacity, FLOOR * b.largest) / b.stiffness


@kernel
def first_bend(b: Bristle, capacity: float, slip: float) -> float:
    """Return the bending [rad] a run starts from: that of sliding, or none near rest."""
    return math.copysign(sliding_angle(b, capacity), slip) if abs(slip) > b.speed else 0.0


@kernel
def plastic(x: float) -> tuple[float, float]:
    """Return the share of slip that is plastic and its slope over x, bending over that of sliding.

    Source: Dupont et al. 2002, their function alpha, with a cosine between.
    """
    if x <= ELASTIC:
        return 0.0, 0.0
    if x >= 1.0:
        return 1.0, 0.0
    phase = math.pi * (x - ELASTIC) / (1.0 - ELASTIC)
    return 0.5 - 0.5 * math.cos(phase), 0.5 * math.pi / (1.0 - ELASTIC) * math.sin(phase)


@kernel
def bristle(b: Bristle, capacity: float, slip: float, bend: float) -> tuple[float, float]:
    """Return torque [N m], at most the capacity, and rate of the bending [rad/s].

    ``capacity`` C >= 0 [N m] now, ``slip`` v [rad/s], ``bend`` z [rad].
    """
    size, fast = abs(bend), abs(slip)
    limit = sliding_angle(b, capacity)
    n = capacity / (b.stiffness * max(limit, size))
    share = 0.0
    if slip * bend > 0.0:
        share, _ = plastic(size / limit)
    rate = n * slip * (1.0 - share * size / limit) / (1.0 + share * fast / b.speed)
    most, rest = DAMPED * b.stiffness * limit, b.stiffness * b.damping
    torque = n * b.stiffness * bend + rest * most / (most + rest * fast) * rate
    torque = min(max(torque, -capacity), capacity)
    if size > limit:
        rate -= math.copysign(size - limit, bend) / RETURN
    lost = GONE * b.largest
    if capacity < lost:
        rate -= (1.0 - capacity / lost) * bend / RETURN
    return torque, rate


@kernel
def bristle_heat(b: Bristle, torque: float, slip: float, bend: float, rate: float) -> float:
    """Return the heat [W] of torque and rate: what is neither given on nor stored, at least 0."""
    return max(torque * slip - b.stiffness * bend * rate, 0.0)


@kernel
def bristle_slopes(
    b: Bristle, capacity: float, slip: float, bend: float
) -> tuple[float, float, float, float, float, float]:
    """Return the slopes of the torque over capacity, slip, bend, then those of the rate."""
    k, fast, size, way = b.stiffness, abs(slip), abs(bend), sign_of(bend)
    limit, inner = sliding_angle(b, capacity), 1.0 if capacity > FLOOR * b.largest else 0.0
    limit_c = inner / k
    if size > limit:
        n, n_c, n_z = capacity / (k * size), 1.0 / (k * size), -capacity * way / (k * size * size)
    else:
        n, n_z = capacity / (k * limit), 0.0
        n_c = 0.0 if inner > 0.0 else 1.0 / (k * limit)
    x = size / limit
    share, steep = 0.0, 0.0
    if slip * bend > 0.0:
        share, steep = plastic(x)
    left, slow = 1.0 - share * x, 1.0 + share * fast / b.speed
    rate = n * slip * left / slow
    by_x = n * slip * (-(share + steep * x) * slow - left * steep * fast / b.speed) / (slow * slow)
    rate_c = n_c * slip * left / slow - by_x * x * limit_c / limit
    rate_v = n * left / (slow * slow)
    rate_z = n_z * slip * left / slow + by_x * way / limit
    most, rest = DAMPED * k * limit, k * b.damping
    total = most + rest * fast
    damping = rest * most / total
    damping_c = (rest / total) * (rest / total) * fast * DAMPED * inner
    damping_v = -(rest / total) * (rest / total) * most * sign_of(slip)
    torque = n * k * bend + damping * rate
    torque_c = n_c * k * bend + damping_c * rate + damping * rate_c
    torque_v = damping_v * rate + damping * rate_v
    torque_z = n_z * k * bend + n * k + damping * rate_z
    if abs(torque) > capacity:
        torque_c, torque_v, torque_z = sign_of(torque), 0.0, 0.0
    if size > limit:
        rate_z -= 1.0 / RETURN
        rate_c += way * limit_c / RETURN
    lost = GONE * b.largest
    if capacity < lost:
        rate_z -= (1.0 - capacity / lost) / RETURN
        rate_c += bend / (lost * RETURN)
    return torque_c, torque_v, torque_z, rate_c, rate_v, rate_z


@kernel
def bristle_changes(
    b: Bristle,
    capacity: float,
    slip: float,
    bend: float,
    change: tuple[float, float, float],
    beside: tuple[float, float],
) -> tuple[float, float, float, float]:
    """Return the heat [W], then the changes of torque, rate of the bending and heat.

    ``change``: of capacity, slip, bend; ``beside``: a torque [N m] that acts beside the bristle's
    and heats too, and its change.
    """
    grows, faster, bends = change
    torque, rate = bristle(b, capacity, slip, bend)
    by = bristle_slopes(b, capacity, slip, bend)
    torques = by[0] * grows + by[1] * faster + by[2] * bends
    turns = by[3] * grows + by[4] * faster + by[5] * bends
    heat = bristle_heat(b, torque, slip, bend, rate) + beside[0] * slip
    heats = torques * slip + torque * faster + beside[1] * slip + beside[0] * faster
    return heat, torques, turns, heats - b.stiffness * (bends * rate + bend * turns)


@kernel
def margin(b: Bristle, capacity: float, bend: float, part: float) -> float:
    """Return how far the bristle is below ``part`` of the capacity, over the largest one.

    Negative too where the capacity is gone.
    """
    room = part * capacity - b.stiffness * abs(bend) * _turned(b, capacity, bend)
    return min(room, capacity - GONE * b.largest) / b.largest


@kernel
def _turned(b: Bristle, capacity: float, bend: float) -> float:
    """Return the transformer's n."""
    return capacity / (b.stiffness * max(sliding_angle(b, capacity), abs(bend)))
