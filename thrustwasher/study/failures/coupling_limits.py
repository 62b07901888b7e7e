"""Steps and slopes at which a loop of two parts stops being stable: formulas, measured.

J is the inertia that the slip sees, c = d(torque)/d(slip), H the step, kappa = H c/J. Measured on
the least loops of two parts that only meet at communication points, stepped as masters do. Each
part is exact on its own, as the formulas take it: what a loop does wrong comes from holding a
signal over a step. A stepper takes all that the loop knows and returns what it knows a step later.
"""

import math
from collections.abc import Callable
from typing import Any

ONE, TWO, THREE = (1.0,), (1.0, 1.0), (1.0, 0.0, 0.0)
STEP, SPRING, MASS = 1e-3, 1e4, 1.0  # s, N/m, kg
CONDUCTANCE, CAPACITY, HEAT_STEP = 20.0, 1.0, 0.05  # W/K, J/K, s
FRICTION, DRIVE = 100.0, 40.0  # N m on 1 kg m2
State = tuple[float, ...]
Stepper = Callable[[State], State]
MANY = 3000  # steps that tell if a deviation grows
HUGE, TINY = 1e6, 1e-6
Make = Callable[[float], Any]
Limit = dict[str, Any]


def torque_held(kappa: float) -> Stepper:
    """Return slip under a torque c w that is fresh in each step; ``kappa`` = H c/J."""
    return lambda s: ((1.0 - kappa) * s[0],)


def torque_late(kappa: float) -> Stepper:
    """Return slip under a torque that is one step old."""
    return lambda s: (s[0] - kappa * s[1], s[0])


def torque_drawn_on(kappa: float) -> Stepper:
    """Return slip under a torque that goes on as it did in the last step."""
    return lambda s: (s[0] - kappa * (1.5 * s[0] - 0.5 * s[1]), s[0])


def torque_implicit(kappa: float) -> Stepper:
    """Return slip under a torque handed over with its slope, taken at the step's end."""
    return lambda s: (s[0] - kappa * s[0] / (1.0 + kappa),)


def tanh_held(kappa: float, width: float = 1e-3) -> Stepper:
    """Return slip under T tanh(w/w_0), held; ``kappa`` = H T/(J w_0), ``width`` w_0."""
    return lambda s: (s[0] - kappa * width * math.tanh(s[0] / width),)


def spring_held(k: float, c: float, h: float) -> Stepper:
    """Return a mass of 1 under the force k x + c v of another part, fresh in each step."""

    def step(s: State) -> State:
        force = k * s[0] + c * s[1]
        return s[0] + h * s[1] - 0.5 * h * h * force, s[1] - h * force

    return step


def spring_late(k: float, c: float, h: float) -> Stepper:
    """Return the same with the force of a step ago."""

    def step(s: State) -> State:
        force = k * s[0] + c * s[1]
        return s[0] + h * s[1] - 0.5 * h * h * s[2], s[1] - h * s[2], force

    return step


def power_held(slope: float, conductance: float, step: float) -> Stepper:
    """Return a body of capacity 1 that is cooled, and heated by ``slope`` times its rise."""
    kept = math.exp(-conductance * step)
    return lambda s: (kept * s[0] + (1.0 - kept) * slope * s[0] / conductance,)


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
        "loop": loop, "formula": formula, "predicted": predicted, "measured": measured,
        "deviation": measured / predicted - 1.0,
    }  # fmt: skip


def limits() -> list[Limit]:
    """Return all limits as JSON types, each by bisection or by the growth over a run."""
    return [
        _limit("torque fresh, held (Gauss-Seidel)", "H < 2 J/c: stable", 2.0,
              _stable(torque_held, ONE)),
        _limit("torque fresh, held (Gauss-Seidel)", "H < J/c: no overshoot", 1.0,
              _smooth(torque_held, ONE)),
        _limit("torque a step old (Jacobi)", "H < J/c: stable", 1.0, _stable(torque_late, TWO)),
        _limit("torque a step old (Jacobi)", "H < J/(4 c): no overshoot", 0.25,
              _smooth(torque_late, TWO)),
        _limit("torque extrapolated", "H < J/c: stable", 1.0, _stable(torque_drawn_on, TWO)),
        _limit("T tanh(w/w_0), held", "H < 2 J w_0/T: stable", 2.0, _stable(tanh_held, (1e-6,))),
        _limit("torque with its slope, kappa 10", "factor 1/(1 + kappa) a step: always stable",
              1.0 / 11.0, factor(torque_implicit(10.0), ONE, 40)),
        _limit("falling friction, kappa -0.1", "grows by 1 + H abs(c)/J a step: physics",
              1.1, factor(torque_held(-0.1), ONE)),
        *_springs(), *_rest(),
    ]  # fmt: skip


def _stable(make: Make, start: State) -> float:
    """Bisect the kappa up to which a deviation dies out."""
    return edge(lambda kappa: dies_out(make(kappa), start), 1e-3, 5.0)


def _smooth(make: Make, start: State) -> float:
    """Bisect the kappa up to which a deviation does not change its sign."""
    return edge(lambda kappa: keeps_its_side(make(kappa), start), 1e-3, 5.0)


def _springs() -> list[Limit]:
    """Return the growth without damping; bisect the damping that a spring needs and bears."""
    start = (1.0, 0.0)

    def held(c: float) -> bool:
        return dies_out(spring_held(SPRING, c, STEP), start)

    def late(c: float, h: float = 1e-4) -> bool:
        return dies_out(spring_late(SPRING, c, h), THREE, 15_000)

    undamped = spring_held(SPRING, 0.0, STEP)
    return [
        _limit("undamped spring, force held", "grows by sqrt(1 + k H^2/(2 m)) a step: never",
              math.sqrt(1.0 + SPRING * STEP**2 / (2.0 * MASS)),
              factor(undamped, (1.0, 0.0), 5000)),
        _limit("spring and damper, force held", "c > k H/2: stable", 0.5 * SPRING * STEP,
              edge(held, 50.0, 0.0)),
        _limit("spring and damper, force held", "c < 2 m/H: stable", 2.0 * MASS / STEP,
              edge(held, 50.0, 1e4)),
        _limit("spring and damper, force a step old", "c > 1.5 k H for small H: stable",
              1.5 * SPRING * 1e-4, edge(late, 50.0, 0.0)),
    ]  # fmt: skip


def _rest() -> list[Limit]:
    """Heat, and the reach of chatter."""

    def settles(slope: float) -> bool:
        return dies_out(power_held(slope, CONDUCTANCE, HEAT_STEP), ONE)

    least = -CONDUCTANCE / math.tanh(0.5 * CONDUCTANCE * HEAT_STEP / CAPACITY)
    low, high = coulomb_reach(FRICTION, DRIVE, STEP)
    return [
        _limit("power held, G and C exact", "dq/dT < G: stable", CONDUCTANCE,
              edge(settles, 0.0, 100.0)),
        _limit("power held, G and C exact", "dq/dT > -G coth(G H/(2 C)): stable", least,
              edge(settles, 0.0, -200.0)),
        _limit("Coulomb friction, held", "slip up to (T + T_x) H/J: bounded chatter",
              (FRICTION + DRIVE) * STEP, high),
        _limit("Coulomb friction, held", "slip down to -(T - T_x) H/J: bounded chatter",
              -(FRICTION - DRIVE) * STEP, low),
    ]  # fmt: skip
