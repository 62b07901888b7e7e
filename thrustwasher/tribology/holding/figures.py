# mypy: disable-error-code="no-any-return"
"""Numbers of what a unit says when it cannot hold; the sentences are ``errors.FIGURES``."""

import math

from ...numerics.arrays import clear
from ...numerics.jit import Array, kernel
from . import memory as M
from .memory import Coupling
from .plant import largest_answer
from .sampling import held_over
from .torque import ANSWERED, STRANGE, inertia_of, is_given

DIGITS = 3
LN_10 = 2.302585092994046
OTHER = 0.2  # of what was given: one that answers and differs by less is the same


@kernel
def rounded(x: float) -> float:
    """Return a number with as many digits as a sentence has."""
    if not 1e-100 < x < 1e100:
        return 0.0
    unit = math.exp(LN_10 * (math.floor(math.log10(x)) - (DIGITS - 1.0)))
    return round(x / unit) * unit


@kernel
def fill_figures(coupling: Coupling, mem: Array, told: Array) -> None:
    """Fill ``told`` (N_FIGURES,) from what a unit remembers after a step."""
    clear(told)
    made = mem[M.CAPACITY] * mem[M.STEP]
    inertia = inertia_of(coupling, mem)
    noise = max(mem[M.NOISE], math.sqrt(mem[M.ROUGH] / 20.0))
    if mem[M.KNOWN] == 0.0 and mem[M.WEIGHT] > 0.0:  # nothing explains the third differences
        noise = max(noise, mem[M.STEP] * math.sqrt(mem[M.YY] / mem[M.WEIGHT] / 20.0))
    told[M.T_TESTS], told[M.T_NOISE] = mem[M.ASKED], rounded(noise)
    if coupling[0] == M.GIVEN:
        inertia = coupling[1]
    move = made / inertia if inertia > 0.0 else made * largest_answer(mem)
    told[M.T_MOVE] = rounded(move)
    if coupling[0] == M.GIVEN and not is_given(coupling, mem):
        late, slip = 1.0 + coupling[2], abs(mem[M.SLIP])
        most = STRANGE * late * (late + 1.0) * made / coupling[1] + 4.0 * mem[M.NOISE]
        is_other = abs(mem[M.INERTIA] - coupling[1]) > OTHER * coupling[1]
        if mem[M.CAREFUL] == ANSWERED and is_other:
            told[M.T_ANSWER] = rounded(mem[M.INERTIA])
        elif slip > most:
            told[M.T_SLIP], told[M.T_EXPECTED] = rounded(slip), rounded(most)
    told[M.T_REPEATS] = held_over(mem)
    told[M.T_ENGAGEMENT] = mem[M.COUNT] - mem[M.CLOSED] + 1.0
