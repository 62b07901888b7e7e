"""Steps and slopes at which a loop of two parts stops being stable: formulas, measured.

J is the inertia that the slip sees, c = d(torque)/d(slip), H the step, kappa = H c/J. Measured on
the minimum loops of two parts that only meet at communication points, stepped as masters do. Each
part is exact on its own, as the formulas take it: what a loop does wrong comes from holding a
signal over a step. A stepper takes all that the loop knows and returns what it knows a step later.
"""

import math
from collections.abc import Callable
from functools import partial
from typing import Any

ONE, TWO, THREE = (1.0,), (1.0, 1.0), (1.0, 0.0, 0.0)
STEP, SPRING, MASS = 1e-3, 1e4, 1.0  # s, N/m, kg
CONDUCTANCE, CAPACITY, HEAT_STEP = 20.0, 1.0, 0.05  # W/K, J/K, s
FRICTION, DRIVE = 100.0, 40.0  # N m on 1 kg m2
State = tuple[float, ...]
Stepper = Callable[[State], State]
MANY = 3000  # steps that tell if a deviation grows
HUGE, TINY = 1e6, 1e-6
Limit = dict[str, Any]


# Slip under a torque c w, kappa = H c/J; "tanh": under T tanh(w/w_0), w_0 = 1e-3, H T/(J w_0).
TORQUES: dict[str, Callable[[float, State], State]] = {
    "fresh": lambda kappa, s: ((1.0 - kappa) * s[0],),
    "late": lambda kappa, s: (s[0] - kappa * s[1], s[0]),
    "extrapolated": lambda kappa, s: (s[0] - kappa * (1.5 * s[0] - 0.5 * s[1]), s[0]),
    "implicit": lambda kappa, s: (s[0] - kappa * s[0] / (1.0 + kappa),),
    "tanh": lambda kappa, s: (s[0] - kappa * 1e-3 * math.tanh(s[0] / 1e-3),),
}


def spring(k: float, c: float, h: float, s: State) -> State:
    """Step a mass of 1 under the force k x + c v of another part: fresh, or that of a step ago."""
    fresh = k * s[0] + c * s[1]
    force = s[2] if len(s) == 3 else fresh
    return (
        s[0] + h * s[1] - 0.5 * h * h * force,
        s[1] - h * force,
        *([fresh] if len(s) == 3 else ()),
    )


def dies_out(step: Stepper, start: State, steps: int = MANY) -> bool:
    """Tell if a deviation is less in the second half of a run than in the first."""
    now, sizes = start, [0.0, 0.0]
    for i in range(2 * steps):
        now = step(now)
        size = max(map(abs, now))
        sizes[i >= steps] = max(sizes[i >= steps], size)
        if not size < HUGE:
            return False
    return sizes[1] < sizes[0] or sizes[1] < TINY


def keeps_its_side(step: Stepper, start: State) -> bool:
    """Tell if the first number of a state that dies out never changes sign."""
    now = start
    for _ in range(200):
        now = step(now)
        if now[0] < -1e-12 * abs(start[0]):
            return False
    return True


def factor(step: Stepper, start: State, steps: int = 200) -> float:
    """Return the mean growth of the size per step, the first half of the steps left out."""
    now, sizes = start, []
    for _ in range(steps):
        now = step(now)
        sizes.append(math.hypot(*now))
    half = steps // 2
    grown = sizes[-1] / sizes[half - 1]
    return math.exp(math.log(grown) / (steps - half))


def coulomb_reach(friction: float, drive: float, h: float) -> tuple[float, float]:
    """Return the lowest and the highest slip of a unit inertia under held Coulomb friction."""
    low, high = 0.0, 0.0
    for start in range(500):
        w = h * start / 500.0 * (friction + drive)
        for i in range(200):
            w += h * (drive - math.copysign(friction, w))
            if i >= 20:
                low, high = min(low, w), max(high, w)
    return low, high


def edge(holds: Callable[[float], bool], inside: float, outside: float) -> float:
    """Return by bisection where ``holds`` ends between two values."""
    for _ in range(40):
        middle = 0.5 * (inside + outside)
        if holds(middle):
            inside = middle
        else:
            outside = middle
    return 0.5 * (inside + outside)


def _limit(loop: str, formula: str, predicted: float, measured: float) -> Limit:
    """Return one formula and what a run of its loop gives."""
    return {
        "loop": loop,
        "formula": formula,
        "predicted": predicted,
        "measured": measured,
        "deviation": measured / predicted - 1.0,
    }


def limits() -> list[Limit]:
    """Return all limits as JSON types, each by bisection or by the growth over a run."""
    return [
        _limit(
            "torque fresh, held (Gauss-Seidel)",
            "H < 2 J/c: stable",
            2.0,
            _kappa(dies_out, "fresh", ONE),
        ),
        _limit(
            "torque fresh, held (Gauss-Seidel)",
            "H < J/c: no overshoot",
            1.0,
            _kappa(keeps_its_side, "fresh", ONE),
        ),
        _limit("torque a step old (Jacobi)", "H < J/c: stable", 1.0, _kappa(dies_out, "late", TWO)),
        _limit(
            "torque a step old (Jacobi)",
            "H < J/(4 c): no overshoot",
            0.25,
            _kappa(keeps_its_side, "late", TWO),
        ),
        _limit(
            "torque extrapolated", "H < J/c: stable", 1.0, _kappa(dies_out, "extrapolated", TWO)
        ),
        _limit(
            "T tanh(w/w_0), held", "H < 2 J w_0/T: stable", 2.0, _kappa(dies_out, "tanh", (1e-6,))
        ),
        _limit(
            "torque with its slope, kappa 10",
            "factor 1/(1 + kappa) a step: always stable",
            1.0 / 11.0,
            factor(partial(TORQUES["implicit"], 10.0), ONE, 40),
        ),
        _limit(
            "falling friction, kappa -0.1",
            "grows by 1 + H abs(c)/J a step: physics",
            1.1,
            factor(partial(TORQUES["fresh"], -0.1), ONE),
        ),
        *_springs(),
        *_rest(),
    ]


def _kappa(holds: Callable[[Stepper, State], bool], torque: str, start: State) -> float:
    """Bisect the kappa up to which a deviation dies out, or does not change its sign."""
    return edge(lambda kappa: holds(partial(TORQUES[torque], kappa), start), 1e-3, 5.0)


def _springs() -> list[Limit]:
    """Return the growth without damping; bisect the damping that a spring needs and bears."""
    start = (1.0, 0.0)

    def held(c: float) -> bool:
        return dies_out(partial(spring, SPRING, c, STEP), start)

    def late(c: float, h: float = 1e-4) -> bool:
        return dies_out(partial(spring, SPRING, c, h), THREE, 15_000)

    undamped = partial(spring, SPRING, 0.0, STEP)
    return [
        _limit(
            "undamped spring, force held",
            "grows by sqrt(1 + k H^2/(2 m)) a step: never",
            math.sqrt(1.0 + SPRING * STEP**2 / (2.0 * MASS)),
            factor(undamped, (1.0, 0.0), 5000),
        ),
        _limit(
            "spring and damper, force held",
            "c > k H/2: stable",
            0.5 * SPRING * STEP,
            edge(held, 50.0, 0.0),
        ),
        _limit(
            "spring and damper, force held",
            "c < 2 m/H: stable",
            2.0 * MASS / STEP,
            edge(held, 50.0, 1e4),
        ),
        _limit(
            "spring and damper, force a step old",
            "c > 1.5 k H for small H: stable",
            1.5 * SPRING * 1e-4,
            edge(late, 50.0, 0.0),
        ),
    ]


def _rest() -> list[Limit]:
    """Heat, and the reach of chatter."""

    def settles(slope: float) -> bool:
        """Tell if a body dies out that is cooled, and heated by ``slope`` times its rise."""
        kept = math.exp(-CONDUCTANCE * HEAT_STEP / CAPACITY)
        held = (1.0 - kept) * slope
        return dies_out(lambda s: (kept * s[0] + held * s[0] / CONDUCTANCE,), ONE)

    least = -CONDUCTANCE / math.tanh(0.5 * CONDUCTANCE * HEAT_STEP / CAPACITY)
    low, high = coulomb_reach(FRICTION, DRIVE, STEP)
    return [
        _limit(
            "power held, G and C exact", "dq/dT < G: stable", CONDUCTANCE, edge(settles, 0.0, 100.0)
        ),
        _limit(
            "power held, G and C exact",
            "dq/dT > -G coth(G H/(2 C)): stable",
            least,
            edge(settles, 0.0, -200.0),
        ),
        _limit(
            "Coulomb friction, held",
            "slip up to (T + T_x) H/J: bounded chatter",
            (FRICTION + DRIVE) * STEP,
            high,
        ),
        _limit(
            "Coulomb friction, held",
            "slip down to -(T - T_x) H/J: bounded chatter",
            -(FRICTION - DRIVE) * STEP,
            low,
        ),
    ]
