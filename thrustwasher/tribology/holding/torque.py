# mypy: disable-error-code="no-any-return"
"""The torque of a pack between two shafts of a driveline that it does not know: ask, then hold.

A pack slides with its capacity until a coded part of its torque has proved the driveline
(``plant``). Then it gives the torque which ends the slip with the step: with inertia J and age d
of the torque, a the outside acceleration of the last step,

    a = (s_n - s_(n-1))/H_(n-1) + T_(n-1-d)/J,
    s_p = s_n + sum over the d torques still to act of H (a - T/J),
    T_n = J (a + g s_p/H),  at most the capacity,

with H the longest of the last four steps where d > 0: which one the torque will act over is not
known yet. A host that judges its steps by the outputs may shorten them at will: H is not less than
a tenth of the longest step.

A torque other than that of sliding is given only within the slip that the capacity makes in a few
steps. While the pack holds, the slip must stay small, and the work of its torque is limited by
a purse; else it slides and asks again. Derived in docs/theory/holding.md.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from ...numerics.status import CHATTER, OK, REFUTED, UNANSWERED
from . import memory as M
from .asking import (
    DEEPEST,
    FIRST_STEPS,
    FREE,
    N_AGES,
    NEAR,
    NEAR_GIVEN,
    SURE,
    is_clean,
    is_near,
    largest_move,
    next_bit,
    share_asked,
)
from .doubts import SMALL, SURELY, ask_anew, asked_in_hold, hear, is_strange
from .memory import Coupling
from .plant import (
    LESS,
    MORE,
    SEEN,
    evidence,
    excludes,
    forget,
    largest_answer,
    learn,
    was_rougher,
)
from .reversals import ROW, calm, chatters, count_repeats, watch
from .sampling import held_over
from .work import book

OPEN = 0.02  # of the largest capacity: below it the pack is open, and a new engagement follows
CLOSED = 50.0  # times the capacity at the start of an engagement: it was open until then
LEAST_STEP = 0.1  # of the longest step: over less no slip is ended
LASTS = 0.995  # of the longest step, at each step
SMOOTH = 1e-3  # of the largest slip: over which the torque of an unknown plant rises, at least
FEW, ALL = 0.03, 1.0  # of the last swings: at most; where the plant is nearly proved
NEARLY = 7.0  # standard deviations of an answer
START = 0.002  # of the capacity: what a pack that is stuck at the start gives more in each step
GROWS, STOPS, NOTHING = 2.0, 1.2, 0.02  # its torque over the last, over the held one; of its motion
EARLY = 5.0  # steps of slip in which the pack's own torque hardly changes it
FEELS = 12.0  # steps of slip after which it is stuck no more
TURNS = 1.2  # times the mean change of the slip: by more a shaft that was at rest changes none
EASILY = 1.9  # times the torque that is to be held: with that a pack that was stuck ends its slip
VAGUE = 0.1  # relative error of the inertia, times 1 + age: above it the slip is ended in part
BADLY = 0.15  # relative error above which it is so in a smaller part
STEADY, CAREFUL, SLOWEST = 1.0, 0.5, 0.3  # share of the slip that is ended in a step
LOUD = 0.05  # torque by noise over capacity, times 1 + age: above it the same
LOUDER = 0.1  # of the capacity: above it the slip is ended in the smaller part
REACH = 4.0  # steps of the last kind in which a slip that is to be ended must be gone
STRANGE = 0.05  # of the slip that capacity makes in a step: what outside torques may leave
SWINGS = 0.3  # of the capacity: a change of outside torques in a step that may leave its slip
LARGE = 0.05  # of the largest slip: more is not held
ANSWERS, SAID = 4.0, 34.0  # steps after the last question: an answer may come, it is told
EXACT = 1e-6  # third difference of the slip over its change in a step: speeds are exact
ENDLESS = 200.0  # steps of an engagement in which no driveline was found: none is waited for
TOLD_BY = 20.0  # steps far from zero after which exact speeds have told a driveline
ANSWERED = 2.0  # what was given is refuted by an answer: the driveline is another one
DROWNED = 0.3  # of the slip that capacity makes in a step: noise in which nothing is held
UNSEEN = 1.5  # times the slip: a larger change by outside torques is none of the slip's
TINY = 1e-6  # of the largest slip: no slip that matters
ESCAPED = 3.0  # doubts: a slip that is held and leaves its reach
MANY = 3.5  # reversals of late


@kernel
def is_given(coupling: Coupling, mem: Array) -> bool:
    """Tell if inertia and age are those of the host, and not refuted."""
    mode, _, _, _, _ = coupling
    return mode == M.GIVEN and mem[M.REFUSED] == 0.0


@kernel
def is_unproved(coupling: Coupling, mem: Array) -> bool:
    """Tell if the slip has still to answer as what was given says."""
    mode, _, _, _, probing = coupling
    return mode == M.GIVEN and probing and mem[M.CONFIRMED] == 0.0


@kernel
def is_deaf(coupling: Coupling, mem: Array) -> bool:
    """Tell if the slip has not answered what was asked of it."""
    heard = mem[M.CONFIRMED] if coupling[0] == M.GIVEN else mem[M.KNOWN]
    return heard == 0.0 and mem[M.ASKED] >= FREE


@kernel
def knows(coupling: Coupling, mem: Array) -> bool:
    """Tell if the driveline is known: proved, or given, neither refuted nor lost in noise."""
    if coupling[0] == M.IDENTIFIED:
        return mem[M.KNOWN] > 0.0
    return is_given(coupling, mem) and mem[M.LOST] == 0.0


@kernel
def age_of(coupling: Coupling, mem: Array) -> int:
    """Return how many steps late the torque acts, -1 while nobody knows."""
    if not knows(coupling, mem):
        return -1
    return coupling[2] if coupling[0] == M.GIVEN else int(mem[M.AGE])


@kernel
def part_of(coupling: Coupling, mem: Array) -> float:
    """Return the part of a step by which the torque is later than that."""
    return mem[M.PART] if coupling[0] == M.IDENTIFIED and mem[M.KNOWN] > 0.0 else 0.0


@kernel
def inertia_of(coupling: Coupling, mem: Array) -> float:
    """Return the inertia that the slip sees [kg m2], 0 while nobody knows."""
    if not knows(coupling, mem):
        return 0.0
    return coupling[1] if coupling[0] == M.GIVEN else mem[M.INERTIA]


@kernel
def shown_inertia(coupling: Coupling, mem: Array) -> float:
    """Return the same; where the one given was refuted, the one that was seen then."""
    if coupling[0] == M.GIVEN and mem[M.REFUSED] > 0.0:
        return mem[M.INERTIA]
    return inertia_of(coupling, mem)


@kernel
def bound_of(coupling: Coupling, mem: Array, capacity: float, h: float) -> float:
    """Return the slip [rad/s] within which a pack is called locked."""
    inertia, bound = inertia_of(coupling, mem), SMALL * mem[M.MOST_SLIP]
    if inertia > 0.0 and not is_strange(mem):
        bound = max(bound, STRANGE * capacity * h / inertia)
    return bound + 4.0 * mem[M.NOISE]


@kernel
def slope_of_bound(coupling: Coupling, mem: Array, capacity: float, h: float) -> float:
    """Return how that slip grows with the capacity [rad/s/(N m)]."""
    inertia = 0.0 if is_strange(mem) else inertia_of(coupling, mem)
    if inertia > 0.0 and STRANGE * capacity * h / inertia > SMALL * mem[M.MOST_SLIP]:
        return STRANGE * h / inertia
    return 0.0


@kernel
def basis_of(coupling: Coupling, locked: bool) -> int:
    """Return what a lock rests on: nothing, what was asked, what was given, what was trusted."""
    mode, _, _, _, probing = coupling
    if not locked:
        return M.NOT_LOCKED
    if mode == M.GIVEN:
        return M.BY_GIVEN if probing else M.BY_TRUST
    return M.BY_ASKING


@kernel
def notice(coupling: Coupling, mem: Array, slip: float) -> None:
    """Take in the slip [rad/s] at the start of a step: reversals, the plant."""
    mode, _, age, _, probing = coupling
    mem[M.MOST_SLIP] = max(mem[M.MOST_SLIP], abs(slip))
    watch(mem, slip, mem[M.CAPACITY], mode != M.OFF)
    if mode == M.OFF:
        return
    count_repeats(mem, slip)
    if mem[M.COUNT] == 0.0:
        mem[M.STUCK] = 1.0 if slip == 0.0 else 0.0
        mem[M.LEAST] = mem[M.CAPACITY]
    given = is_given(coupling, mem)
    if mode == M.IDENTIFIED and mem[M.KNOWN] > 0.0 and mem[M.EVERY] == 0.0:
        if hear(mem, slip):
            refuse(coupling, mem)
            ask_anew(mem)
    else:
        learn(mem, slip, 1.0 / coupling[1] if given else 0.0, age if given else 0)
    if given:
        mem[M.NOISE] = math.sqrt(mem[M.ROUGH] / 20.0)
        if probing:
            found = evidence(mem, coupling[1], age)
            if found > SURELY:
                mem[M.CONFIRMED] = 1.0
            if found < -SURELY or excludes(mem, coupling[1], age):
                refuse(coupling, mem)


@kernel
def book_heat(coupling: Coupling, mem: Array, slip: float) -> None:
    """Book the heat of the step that ended at ``slip`` [rad/s]."""
    age, inertia = age_of(coupling, mem) + part_of(coupling, mem), inertia_of(coupling, mem)
    kept = coupling[0] == M.IDENTIFIED or mem[M.CONFIRMED] > 0.0
    if age < 0 and kept and mem[M.REFUSED] == 0.0:  # that which was known last
        age, inertia = mem[M.HEAT_AGE] - 1.0, mem[M.HEAT_INERTIA]
    if mem[M.CLOSED] <= SEEN:
        mem[M.ALONE] = 0.0
    deaf = is_deaf(coupling, mem) and mem[M.COUNT] - mem[M.TOLD] > SAID
    move = max(largest_move(mem, slip), TINY * mem[M.MOST_SLIP])  # a steady slip has its rounding
    exact = math.sqrt(mem[M.ROUGH]) < EXACT * move and mem[M.AWAY] > TOLD_BY
    if deaf or exact or mem[M.REFUSED] > 0.0 or mem[M.CLOSED] > ENDLESS:
        mem[M.ALONE] = 1.0
    book(mem, slip, age, inertia)


@kernel
def refuse(coupling: Coupling, mem: Array) -> None:
    """Forget the plant, or refuse the one that was given until the pack was open."""
    if coupling[0] == M.GIVEN and mem[M.CONFIRMED] == 0.0:  # its age was no better
        late = mem[M.WORK + N_AGES] - mem[M.WORK + N_AGES + 1]
        mem[M.OWED] -= max(0.0, late)
    if coupling[0] == M.GIVEN:
        ratio = mem[M.INERTIA] / coupling[1]  # of the answer that was found beside
        another = mem[M.KNOWN] > 0.0 and not 1.0 / MORE < ratio < 1.0 / LESS
        mem[M.REFUSED], mem[M.CAREFUL] = 1.0, ANSWERED if another else 0.0
        mem[M.KNOWN] = mem[M.DOUBT] = mem[M.HELD] = 0.0
    else:
        forget(mem)
        mem[M.TURN] = 0.0
    mem[M.HEAT_AGE] = 0.0
    for k in range(N_AGES + 2):
        mem[np.uintp(M.WORK + k)] = 0.0
    for k in range(N_AGES):
        mem[np.uintp(M.LATE + k)] = 0.0


@kernel
def gain_of(coupling: Coupling, mem: Array, made: float) -> float:
    """Return the share of the slip that is ended in a step.

    ``made``: slip that the capacity makes in a step [rad/s].
    """
    late, loud, gain = 1.0 + age_of(coupling, mem), 2.3 * mem[M.NOISE], STEADY
    if not is_given(coupling, mem) and late * mem[M.ERROR] > VAGUE:
        gain = CAREFUL if mem[M.ERROR] <= BADLY else SLOWEST
    if mem[M.CAREFUL] > 0.0 or loud > LOUDER * made:
        return min(gain, SLOWEST)
    return min(gain, CAREFUL) if late * loud > LOUD * made else gain


@kernel
def _wanted(
    coupling: Coupling, mem: Array, slip: float, h: float, gain: float
) -> tuple[float, float, float]:
    """Return the torque that ends the slip, its slope over the slip, the outside acceleration.

    Late torques of two packs in parallel swing against each other where the gain is large, and the
    slip does not show it: then the gain is the smallest, at which they calm down.
    """
    age, inertia, outside, by_rate = age_of(coupling, mem), inertia_of(coupling, mem), 0.0, 0.0
    part = part_of(coupling, mem)
    if mem[M.COUNT] > 0.0:
        acting = mem[np.uintp(M.TORQUE + age)]
        acting += part * (mem[np.uintp(M.TORQUE + age + 1)] - acting)
        outside, by_rate = (slip - mem[M.SLIP]) / mem[M.STEP] + acting / inertia, 1.0
        turn = abs(outside - mem[M.OUTSIDE]) * mem[M.STEP]
        seen = max(abs(slip), abs(mem[M.SLIP]))
        tiny = turn > UNSEEN * seen or seen < TINY * mem[M.MOST_SLIP]
        if tiny and age > 0 and mem[M.HELD] > 0.0:
            gain = min(gain, SLOWEST)
        if gain < STEADY and mem[M.HELD] > 0.0:
            outside, by_rate = mem[M.OUTSIDE] + gain * (outside - mem[M.OUTSIDE]), gain
        by_rate /= mem[M.STEP]
    ahead, by_ahead, longest = slip, 1.0, max(h, LEAST_STEP * mem[M.LONGEST])
    if part > 0.0:
        ahead += part * h * (outside - mem[np.uintp(M.TORQUE + age)] / inertia)
        by_ahead += part * h * by_rate
    for k in range(age):  # torques that were given and have still to act
        ahead += h * (outside - mem[np.uintp(M.TORQUE + age - 1 - k)] / inertia)
        by_ahead += h * by_rate
    if age > 0:
        for k in range(3):
            longest = max(longest, mem[np.uintp(M.STEP + k)])
    torque = inertia * (outside + gain * ahead / longest)
    return torque, inertia * (by_rate + gain * by_ahead / longest), outside


@kernel
def _reach(coupling: Coupling, mem: Array, slip: float, made: float) -> float:
    """Return the slip [rad/s] up to which a torque other than that of sliding is given."""
    late = 1.0 + age_of(coupling, mem)
    reach = 2.0 * late * made + 4.0 * mem[M.NOISE]
    if mem[M.HELD] == 0.0 and mem[M.COUNT] > 0.0 and mem[M.STUCK] == 0.0:
        move = REACH * late * largest_move(mem, slip)
        reach = min(reach, move + SMALL * mem[M.MOST_SLIP])
    return reach


@kernel
def expected(coupling: Coupling, mem: Array, slip: float, h: float) -> float:
    """Return about the torque of a step of ``h`` [s], for the capacity of the last one [N m]."""
    capacity = mem[M.CAPACITY]
    if not (knows(coupling, mem) and h > 0.0):
        return sign_of(slip) * capacity
    made = capacity * h / inertia_of(coupling, mem)
    if abs(slip) > _reach(coupling, mem, slip, made):
        return sign_of(slip) * capacity
    wanted, _, _ = _wanted(coupling, mem, slip, h, gain_of(coupling, mem, made))
    return min(capacity, max(-capacity, wanted))


@kernel
def _largest_change(mem: Array) -> float:
    """Return the largest change of the torque from step to step, of the last five [N m]."""
    newer = max(abs(mem[M.TORQUE] - mem[M.TORQUE + 1]), abs(mem[M.TORQUE + 1] - mem[M.TORQUE + 2]))
    older = abs(mem[M.TORQUE + 2] - mem[M.TORQUE + 3])
    return max(newer, max(older, abs(mem[M.TORQUE + 3] - mem[M.TORQUE + 4])))


@kernel
def _verify(coupling: Coupling, mem: Array, slip: float, made: float) -> None:
    """Doubt what is known while the slip of a pack that holds is not small.

    Outside torques that swing leave a slip, and the pack's own torque swings with them: such a slip
    is told, and refutes nothing.
    """
    age = age_of(coupling, mem)
    if not mem[M.HELD] > 3.0 + age:
        return
    slid = max(
        mem[M.MOST_SLIP], 4.0 * (1.0 + age) * made
    )  # a pack may have been stuck from the start
    steps, enough = 0.5 * (1.0 + age) * (2.0 + age), 6.0 + 2.0 * age
    most, beyond = LARGE * slid, abs(slip) - 4.0 * mem[M.NOISE]
    if beyond <= min(2.0 * STRANGE * steps * made, most):
        mem[M.DOUBT] = max(0.0, mem[M.DOUBT] - 0.5)
        return
    change = min(SWINGS * mem[M.CAPACITY], _largest_change(mem))
    mem[M.DOUBT] += 1.0
    if beyond * mem[M.CAPACITY] <= steps * made * change and beyond <= most:
        if mem[M.DOUBT] > enough - 2.0:
            mem[M.DOUBT] = enough - 2.0
            mem[M.CHATTER] = mem[M.COUNT] + ROW
    elif mem[M.DOUBT] > enough:
        refuse(coupling, mem)


@kernel
def _count_reversals(coupling: Coupling, mem: Array) -> None:
    """Forget what is known, or be careful first with what was given, where the slip reverses."""
    if not (mem[M.REVERSALS] > MANY and knows(coupling, mem)):
        return
    if is_given(coupling, mem) and mem[M.CAREFUL] == 0.0:
        mem[M.CAREFUL], mem[M.REVERSALS] = 1.0, 0.0
        return
    refuse(coupling, mem)
    mem[M.REVERSALS] = 1.5


@kernel
def _most_of_stuck(mem: Array, slip: float) -> float:
    """Return the torque up to which a pack that was stuck at the start feels its way [N m].

    A held torque L sets the slip in motion with L/J; under a torque T it is (L - T)/J: the share
    that is left tells T/L. The torque of three steps ago has acted for certain.
    """
    if mem[M.FELT] <= 1.0:
        mem[M.PUSHED] = (slip - mem[M.SLIP]) / mem[M.STEP]
    left = (slip - mem[M.SLIP]) / mem[M.STEP] / (mem[M.PUSHED] if mem[M.PUSHED] != 0.0 else 1e300)
    last = max(abs(mem[M.TORQUE]), abs(mem[M.TORQUE + 1]))  # one may have been lowered to ask
    sure = abs(mem[M.TORQUE + 2])
    more = min(GROWS * last, STOPS * sure / max(1.0 - left, NOTHING)) if left > 0.0 else last
    return max(more, last) + START * mem[M.MOST_CAPACITY] * min(1.0, max(0.0, left))


@kernel
def _of_unknown(
    coupling: Coupling, mem: Array, slip: float, h: float, capacity: float
) -> tuple[float, float]:
    """Return the share of the capacity in an unknown plant, and its slope over the slip."""
    width = SMOOTH * mem[M.MOST_SLIP]
    swing = max(mem[M.AMPLITUDE], max(mem[M.AMPLITUDE + 1], mem[M.AMPLITUDE + 2]))
    wide = ALL if mem[M.PROOF] > NEARLY and mem[M.REVERSALS] > 1.0 else FEW
    broad = 4.0 * (1.0 + mem[M.REVERSALS]) * largest_answer(mem) * capacity * h
    if mem[M.REFUSED] > 0.0 and mem[M.CAREFUL] == ANSWERED:
        width = max(width, broad)
    width = max(max(width, min(wide * swing, broad)), 1e-300)
    share = math.tanh(slip / width)
    if not capacity > 0.0 and slip != 0.0:
        mem[M.STUCK] = 0.0  # nothing held it
    if mem[M.STUCK] > 0.0 and mem[M.COUNT] > 0.0 and capacity > 0.0:
        mem[M.FELT] += 1.0 if slip != 0.0 else 0.0
        turns = abs(slip - 2.0 * mem[M.SLIP] + mem[M.SLIP + 1])
        odd = mem[M.FELT] <= EARLY and mem[M.FELT] * turns > TURNS * mem[M.MOST_SLIP]
        if mem[M.FELT] > FEELS or odd:
            mem[M.STUCK] = 0.0  # no shaft that a steady torque sets in motion
        most = _most_of_stuck(mem, slip) / capacity
        if abs(share) > most:
            return math.copysign(most, share), 0.0
    return share, (1.0 - share) * (1.0 + share) / width


@kernel
def _doubt(coupling: Coupling, mem: Array, much: bool) -> None:
    """Doubt what is known where a slip that is held left its reach, or its torque drives."""
    if not much:
        return
    mem[M.DOUBT] += ESCAPED
    if mem[M.DOUBT] > 6.0 + 2.0 * age_of(coupling, mem):
        refuse(coupling, mem)
        if coupling[0] == M.IDENTIFIED:
            ask_anew(mem)


@kernel
def decide(
    coupling: Coupling, mem: Array, slip: float, h: float, capacity: float
) -> tuple[bool, float, float, float]:
    """Decide on the torque of a step of ``h`` [s] with this ``capacity`` [N m].

    Returns if the pack slides; then the share of the capacity, else the torque [N m] that ends the
    slip; its slope over the slip; the share of the capacity, or the torque, that is coded.
    """
    if capacity < OPEN * mem[M.MOST_CAPACITY]:
        forget(mem)
        calm(mem)
        mem[M.ASKED] = mem[M.CLOSED] = mem[M.TURN] = 0.0
        mem[M.REFUSED] = mem[M.CONFIRMED] = mem[M.CAREFUL] = mem[M.REPEATS] = 0.0
        mem[M.LEAST] = capacity
    elif capacity > CLOSED * mem[M.LEAST]:
        mem[M.ASKED], mem[M.CLOSED] = 0.0, min(mem[M.CLOSED], SEEN)
        mem[M.LEAST] = capacity
    mem[M.LOST] = 0.0
    if is_given(coupling, mem) and coupling[4] and h > 0.0 and capacity > 0.0:
        if mem[M.NOISE] * coupling[1] > DROWNED * capacity * h:
            mem[M.LOST] = 1.0
    slides, number, slope, coded, made = True, 0.0, 0.0, 0.0, 0.0
    if knows(coupling, mem) and h > 0.0:
        made = capacity * h / inertia_of(coupling, mem)
        gain = gain_of(coupling, mem, made)
        number, slope, mem[M.OUTSIDE] = _wanted(coupling, mem, slip, h, gain)
        slides = abs(slip) > _reach(coupling, mem, slip, made)
        drives = not slides and number * slip < 0.0 and abs(number) > capacity
        if drives and coupling[0] == M.IDENTIFIED:
            _doubt(coupling, mem, mem[M.HELD] == 0.0)
        elif (slides and mem[M.HELD] > 0.0) or drives:
            unproved = is_unproved(coupling, mem)
            _doubt(coupling, mem, unproved)
            number = 0.0 if drives and unproved else number
        if mem[M.STUCK] > 0.0 and coupling[0] == M.IDENTIFIED:
            most = EASILY * abs(inertia_of(coupling, mem) * mem[M.OUTSIDE])
            if slides or abs(number) > most:
                slides = most >= capacity
                number, slope = math.copysign(most, slip if slides else number), 0.0
            elif mem[M.HELD] > 3.0 + age_of(coupling, mem):
                mem[M.STUCK] = 0.0
        ends = mem[M.STUCK] > 0.0 and abs(slip) <= abs(mem[M.SLIP])
        holds = not slides and abs(number) < capacity and not ends
        if holds:
            _verify(coupling, mem, slip, made)
        _count_reversals(coupling, mem)
        slides = slides or not knows(coupling, mem)
        if holds and not slides and coupling[0] == M.IDENTIFIED and mem[M.EVERY] == 0.0:
            coded = asked_in_hold(mem, slip, capacity - abs(number), capacity, made)
            number += coded
    lent = capacity * h * largest_move(mem, slip)
    if knows(coupling, mem):
        late = 1.0 + age_of(coupling, mem)
        lent = capacity * h * (late * late * made + 4.0 * mem[M.NOISE])
    if slides:
        number, slope, coded = _slide(coupling, mem, slip, h, capacity)
    if number * slip < 0.0 and mem[M.DEBT] > lent:
        number = slope = coded = 0.0
        mem[M.DOUBT] += 1.0
    return slides, number, slope, coded


@kernel
def _slide(
    coupling: Coupling, mem: Array, slip: float, h: float, capacity: float
) -> tuple[float, float, float]:
    """Return the share of the capacity of a pack that slides, its slope, its coded part."""
    _, _, _, _, probing = coupling
    share, slope, known = sign_of(slip), 0.0, knows(coupling, mem) and h > 0.0
    if not known:
        share, slope = _of_unknown(coupling, mem, slip, h, capacity)
    given = is_given(coupling, mem)
    near = is_near(mem, slip, NEAR_GIVEN if given and is_clean(mem, slip) else NEAR)
    unclear = mem[M.ASKED] == 0.0 and is_clean(mem, slip)  # what was asked from afar
    of_others = mem[M.ASKED] < FREE and was_rougher(mem)
    known_of = mem[M.KNOWN] > 0.0 or unclear or of_others
    if near and mem[M.AWAY] > FIRST_STEPS and known_of and not given:
        forget(mem)  # it may be another plant by now
        if mem[M.ASKED] > FIRST_STEPS:
            ask_anew(mem)
    mem[M.AWAY] = 0.0 if near else mem[M.AWAY] + 1.0
    if not probing or mem[M.REFUSED] > 0.0 or (given and not near):
        return share, slope, 0.0
    proved = mem[M.KNOWN] > 0.0 and mem[M.ERROR] <= SURE
    depth = share_asked(mem, slip, near, proved)
    if mem[M.STUCK] > 0.0 and depth > 0.0:
        depth = DEEPEST  # of a torque that is small yet
    if depth == 0.0:
        return share, slope, 0.0
    bit = next_bit(mem)
    if near:
        mem[M.ASKED] += 1.0
        if mem[M.ASKED] == FREE:
            mem[M.TOLD], mem[M.STUCK] = mem[M.COUNT], 0.0
    if mem[M.ASKED] > FREE:
        mem[M.SPENT] += depth * bit * abs(share * capacity * slip) * h
    rest = 1.0 - depth * bit
    return rest * share, rest * slope, -share * depth * (bit - 0.5)


@kernel
def note(
    coupling: Coupling, mem: Array, slip: float, h: float, torque: float, coded: float,
    capacity: float, holds: bool,
) -> None:  # fmt: skip
    """Keep what was seen and given in a step."""
    for k in range(4, 0, -1):
        mem[np.uintp(M.TORQUE + k)] = mem[np.uintp(M.TORQUE + k - 1)]
        mem[np.uintp(M.CODED + k)] = mem[np.uintp(M.CODED + k - 1)]
        mem[np.uintp(M.SLIP + k)] = mem[np.uintp(M.SLIP + k - 1)]
        mem[np.uintp(M.STEP + k)] = mem[np.uintp(M.STEP + k - 1)]
    mem[M.TORQUE], mem[M.CODED], mem[M.SLIP], mem[M.STEP] = torque, coded, slip, h
    if mem[M.COUNT] > 0.0:
        mem[M.BEFORE + 1], mem[M.BEFORE] = mem[M.BEFORE], mem[M.CAPACITY]
    mem[M.COUNT] += 1.0
    mem[M.CLOSED] += 1.0
    mem[M.CLOCK] += h
    mem[M.HELD] = mem[M.HELD] + 1.0 if holds else 0.0
    mem[M.CAPACITY] = capacity
    mem[M.MOST_CAPACITY] = max(mem[M.MOST_CAPACITY], capacity)
    mem[M.LONGEST] = max(LASTS * mem[M.LONGEST], h)
    quiet = abs(slip) <= bound_of(coupling, mem, capacity, h)
    mem[M.QUIET] = mem[M.QUIET] + 1.0 if quiet else 0.0


@kernel
def is_locked(coupling: Coupling, mem: Array) -> bool:
    """Tell if the pack holds, and has lately slipped by no more than the bound of a lock."""
    late = 1.0 + age_of(coupling, mem)
    return mem[M.HELD] > late and mem[M.QUIET] > late


@kernel
def told_of(coupling: Coupling, mem: Array, advice: int) -> int:
    """Return the status of a pack that could hold: why it does not, else ``advice``."""
    if coupling[0] == M.GIVEN and mem[M.REFUSED] > 0.0:
        return REFUTED
    if held_over(mem) > 0.0 and not (mem[M.EVERY] > 0.0 and knows(coupling, mem)):
        return CHATTER
    if is_deaf(coupling, mem):
        since = mem[M.COUNT] - mem[M.TOLD]
        return UNANSWERED if advice == OK and ANSWERS < since < SAID else advice
    return CHATTER if chatters(mem) else advice
