# mypy: disable-error-code="no-any-return"
"""What driveline a unit sits in, proved by the slip that answers what the unit asks.

The slip of a unit between two shafts obeys ds/dt = a - T/J: J is the inertia that the slip sees,
J1 J2/(J1 + J2) of two shafts, a what all other torques do to it. The torque given in step n acts d
steps later: at once where a host passes fresh values, a step late where it passes old ones. Second
differences hardly feel smooth outside torques:

    y = D2[(s_n - s_(n-1))/H_(n-1)],  x_d = -D2[T_(n-1-d)],  y = x_d/J for the true d.

Most of T is made of the slip itself: y = x_d/J may then hold for any slip, also one that is
prescribed. Only the coded part z of x owes nothing to the slip. An F-test of z, with the rest
f = x - z fitted beside it, tells a plant from chance. Derived in docs/theory/holding.md.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from . import memory as M
from .asking import N_AGES

EXCITED = 0.002  # of the largest capacity: smaller changes of the coded part say nothing
ROUNDING = 1e-12  # of the largest slip: a host that takes it from two speeds rounds it by less
KEPT = 0.995  # of what was known, at each new sample
RISK = 1e-5  # of taking chance for an answer, at each look and age
ALIKE = 2.1  # samples that count as one: neighbouring differences go together
LIKELIER = 14.0  # 2 ln of the likelihood of the best age over that of the next, 1000
BADLY = 0.3  # relative error of the answer: nothing is known
LEVER = 0.1  # of the coded part's squares: from there on the other part is judged too
ALIKE_LEAST, ALIKE_MOST = 0.5, 2.0  # its slope over that of the coded part
SEEN = 4.0  # steps that a sample is made of
CERTAIN = 4.0  # standard deviations, neighbouring samples going together
WEAK = 0.1  # times that answer: less is none
LESS, MORE = 0.5, 1.4  # times the answer that was given: it is refuted
ENOUGH = 8.0  # weight of samples from which on they bound the answer
ROUGHER = 64.0  # times the mean square of that difference: more is none of the speed's own
RISES = 100.0  # times that mean square: a larger one counts as so much
FINE = 0.02  # of the slip that capacity makes in a step: below it the noise is of no account
N_GUESSES = N_AGES + 2  # of the age, where speeds are held over steps
CLOSE = 0.3  # steps: ages that differ by less are the same to a pack that holds
FADED = 0.9  # of the mean square of the slip's third difference, at each new one


@kernel
def _second_difference(mem: Array, at: int) -> float:
    """Return that of the torque whose last value lies at ``at``."""
    return mem[np.uintp(at)] - 2.0 * mem[np.uintp(at + 1)] + mem[np.uintp(at + 2)]


@kernel
def _guesses(mem: Array) -> int:
    """Return how many ages are possible."""
    return N_AGES if mem[M.EVERY] == 0.0 else N_GUESSES


@kernel
def _age_of_guess(mem: Array, k: int) -> float:
    """Return an age: 0, 1, 2; where speeds are held also steps of which a part is over."""
    if k < N_AGES:
        return float(k)
    return (k - N_AGES + 0.5) if mem[M.EVERY] == 2.0 else (k - N_AGES + 1.0) / mem[M.EVERY]


@kernel
def _changes(mem: Array, k: int) -> tuple[float, float]:
    """Return the second differences of coded part and rest of the torque, were this its age."""
    age = _age_of_guess(mem, k)
    d = int(age)
    part = age - d
    z, all_ = -_second_difference(mem, M.CODED + d), -_second_difference(mem, M.TORQUE + d)
    if part > 0.0:
        z -= part * (z + _second_difference(mem, M.CODED + d + 1))
        all_ -= part * (all_ + _second_difference(mem, M.TORQUE + d + 1))
    return z, all_ - z


@kernel
def forget(mem: Array) -> None:
    """Forget the plant and the samples that proved it."""
    for i in range(M.ZZ, M.WEIGHT + 1):
        mem[np.uintp(i)] = 0.0
    mem[M.KNOWN] = mem[M.DOUBT] = mem[M.HELD] = mem[M.MISSED] = 0.0
    mem[M.USUAL] = mem[M.STRAYS] = mem[M.AGAIN] = mem[M.UNSURE] = 0.0


@kernel
def was_rougher(mem: Array) -> bool:
    """Tell if the slip was rougher in the samples than it is without a code: others moved it."""
    mean = mem[M.YY] * mem[M.STEP] * mem[M.STEP]
    return mean > ROUGHER * mem[M.ROUGH] * mem[M.WEIGHT]


@kernel
def largest_answer(mem: Array) -> float:
    """Return the largest 1/J [1/(kg m2)] that the samples do not exclude, 0 if there are few."""
    most, n = 0.0, mem[M.WEIGHT]
    if n < ENOUGH:
        return most
    for d in range(N_AGES):
        zz = mem[np.uintp(M.ZZ + d)]
        if zz > 0.0:
            spread = math.sqrt(zz * mem[M.YY] / n)
            most = max(most, (mem[np.uintp(M.ZY + d)] + 3.0 * spread) / zz)
    return most


@kernel
def learn(mem: Array, slip: float, answer: float, age: int) -> None:
    """Take in the slip [rad/s] at the start of a step; what it proves goes to ``mem``.

    ``answer`` [1/(kg m2)]: the one that is given, of a torque of that ``age``; 0: none is.
    """
    if mem[M.COUNT] - mem[M.SINCE] < SEEN + 1.0 or mem[M.CLOSED] < SEEN:
        return
    rate_1 = (mem[M.SLIP] - mem[M.SLIP + 1]) / mem[M.STEP + 1]
    rate_2 = (mem[M.SLIP + 1] - mem[M.SLIP + 2]) / mem[M.STEP + 2]
    y = (slip - mem[M.SLIP]) / mem[M.STEP] - 2.0 * rate_1 + rate_2
    if abs(y) * mem[M.STEP] < ROUNDING * mem[M.MOST_SLIP]:  # rounding answers no torque
        y = 0.0
    most = 0.0
    for d in range(N_AGES):
        most = max(most, abs(_second_difference(mem, M.CODED + d)))
    asked = most > EXCITED * mem[M.MOST_CAPACITY]
    if answer > 0.0 or not asked:
        third = (y + answer * _second_difference(mem, M.TORQUE + age)) * mem[M.STEP]
        square = third * third
        if answer > 0.0:  # a jump of outside torque is no noise
            made = FINE * answer * mem[M.CAPACITY] * mem[M.STEP]
            square = min(square, RISES * mem[M.ROUGH] + made * made)
        mem[M.ROUGH] = FADED * mem[M.ROUGH] + (1.0 - FADED) * square
    if not asked:
        return
    for d in range(_guesses(mem)):
        z, f = _changes(mem, d)
        mem[np.uintp(M.ZZ + d)] = KEPT * mem[np.uintp(M.ZZ + d)] + z * z
        mem[np.uintp(M.ZF + d)] = KEPT * mem[np.uintp(M.ZF + d)] + z * f
        mem[np.uintp(M.FF + d)] = KEPT * mem[np.uintp(M.FF + d)] + f * f
        mem[np.uintp(M.ZY + d)] = KEPT * mem[np.uintp(M.ZY + d)] + z * y
        mem[np.uintp(M.FY + d)] = KEPT * mem[np.uintp(M.FY + d)] + f * y
    mem[M.YY] = KEPT * mem[M.YY] + y * y
    mem[M.WEIGHT] = KEPT * mem[M.WEIGHT] + 1.0
    _judge(mem)


@kernel
def fit(mem: Array, d: int) -> tuple[float, float, float, float, float]:
    """Return how an age explains the answer.

    Squares left without and with the coded part; slopes over it and over the rest [1/(kg m2)];
    squares of the coded part that the rest does not have.
    """
    zz, zf, ff = mem[np.uintp(M.ZZ + d)], mem[np.uintp(M.ZF + d)], mem[np.uintp(M.FF + d)]
    zy, fy, yy = mem[np.uintp(M.ZY + d)], mem[np.uintp(M.FY + d)], mem[M.YY]
    alone, own, answer, by_rest = yy, zz, zy, 0.0
    if ff > 1e-9 * zz:
        alone -= fy * fy / ff
        own -= zf * zf / ff
        answer -= zf * fy / ff
    if not own > 1e-6 * zz or zz == 0.0:
        return yy, yy, 0.0, 0.0, 0.0
    answer /= own
    if ff > 1e-9 * zz:
        by_rest = (fy - answer * zf) / ff
    left = alone
    if answer > 0.0:
        left = max(alone - answer * answer * own, 1e-13 * yy)
    return alone, left, answer, by_rest, own


@kernel
def _is_alike(mem: Array, d: int, answer: float, by_rest: float) -> bool:
    """Tell if the rest of the torque, where it is strong, is answered as the coded part is."""
    if mem[np.uintp(M.FF + d)] <= LEVER * mem[np.uintp(M.ZZ + d)]:
        return True
    return ALIKE_LEAST * answer < by_rest < ALIKE_MOST * answer


@kernel
def _next_best(mem: Array, age: int) -> float:
    """Return the squares that the best other age leaves; one that is hardly another is none."""
    least = 1e300
    for k in range(_guesses(mem)):
        if abs(_age_of_guess(mem, k) - _age_of_guess(mem, age)) > CLOSE:
            _, left, _, _, own = fit(mem, k)
            if own != 0.0:
                least = min(least, left)
    return least


@kernel
def _judge(mem: Array) -> None:
    """Take over the age whose coded part is answered beyond chance, and its inertia."""
    n = mem[M.WEIGHT]
    if n < 3.9:
        return
    best, age = 1e300, -1
    mem[M.PROOF] = 0.0
    for d in range(_guesses(mem)):
        alone, left, answer, by_rest, own = fit(mem, d)
        if own == 0.0:
            continue
        if answer > 0.0 and left > 0.0 and n >= ENOUGH and _is_alike(mem, d, answer, by_rest):
            ratio = answer * answer * own / left * (n - 2.0)
            mem[M.PROOF] = max(mem[M.PROOF], math.sqrt(ratio))
        if left < best:
            best, age = left, d
    if age < 0:
        return
    alone, left, answer, by_rest, own = fit(mem, age)
    chance = RISK ** (2.0 * ALIKE / max(n - 2.0 * ALIKE, 1.5))
    if not (answer > 0.0 and left < chance * alone):
        return
    if not left < math.exp(-LIKELIER / n) * _next_best(mem, age):
        return
    if not _is_alike(mem, age, answer, by_rest):
        return
    zz, ff = mem[np.uintp(M.ZZ + age)], mem[np.uintp(M.FF + age)]
    error = math.sqrt(left / max(n - 2.0, 1.0) / own) / answer
    if error > BADLY:
        return
    if ff > zz:  # the rest is the better lever, where it says the same
        both = mem[np.uintp(M.ZY + age)] + mem[np.uintp(M.FY + age)]
        both /= zz + 2.0 * mem[np.uintp(M.ZF + age)] + ff
        if abs(both - answer) < 2.0 * error * answer and both > 0.0:
            error *= answer / both * math.sqrt(zz / ff)
            answer = both
    if not 0.0 < 1.0 / answer < 1e300:
        return
    if mem[M.KNOWN] == 0.0:
        mem[M.REVERSALS] = mem[M.DOUBT] = 0.0
    found = _age_of_guess(mem, age)
    mem[M.KNOWN], mem[M.INERTIA], mem[M.AGE] = 1.0, 1.0 / answer, float(int(found))
    mem[M.PART] = found - int(found)
    mem[M.ERROR], mem[M.NOISE] = error, math.sqrt(left / (n - 1.0) / 20.0) * mem[M.STEP]


@kernel
def evidence(mem: Array, inertia: float, age: int) -> float:
    """Return ln of the likelihood of an answer as of ``inertia`` [kg m2] over that of none."""
    n = mem[M.WEIGHT]
    if n < ENOUGH:
        return 0.0
    _, left, answer, by_rest, own = fit(mem, age)
    if own == 0.0:
        return 0.0
    spread = ALIKE * left / (n - 2.0)
    found = own * (2.0 * answer - 1.0 / inertia) / inertia / (2.0 * spread + 1e-300)
    if found < 0.0:  # a weak answer is another matter
        return found if answer < WEAK / inertia else 0.0
    return found if _is_alike(mem, age, answer, by_rest) else 0.0


@kernel
def excludes(mem: Array, inertia: float, age: int) -> bool:
    """Tell if the samples exclude that the slip answers as one of ``inertia`` [kg m2] does.

    They do where its answer is less than half or more than 1.4 times of that, for certain.
    """
    n = mem[M.WEIGHT]
    if n < ENOUGH:
        return False
    _, left, answer, _, own = fit(mem, age)
    if own == 0.0:
        return False
    error = CERTAIN * math.sqrt(ALIKE * left / max(n - 2.0, 1.0) / own)
    return answer + error < LESS / inertia or answer - error > MORE / inertia
