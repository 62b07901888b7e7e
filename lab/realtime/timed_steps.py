"""Steps of an FMU timed one by one in compiled code, over the FMU's own C functions.

A step is what a host does between two communication points: set all inputs, step, get all outputs.
One that took long is done again from the same memory: what it takes then is its own work, what it
took before may be another process or an interrupt.
"""

import math

import numpy as np
from numpy.typing import NDArray

from thrustwasher.numerics.jit import kernel, way
from thrustwasher.shift.cosim.compiled_loop import (
    _only_compiled,
    _seconds,
    int64s,
    reals,
    step2,
    values2,
)

# Addresses of the instance and of its functions
COMPONENT, SET_REAL, DO_STEP, GET_STATE, SET_STATE, RESET, SETUP, ENTER, EXIT = range(9)
# ... of the inputs' value references and values; of the place that holds the state's address
REFERENCES, VALUES, STATE = range(9, 12)
N_ADDRESSES = 12
# A group of values of one type: function, value references, how many, values, 1 if Real
FUNCTION, GROUP_REFERENCES, COUNT, GROUP_VALUES, IS_REAL = range(5)
# What is counted over all calls
STEPS, FAILED, NOT_FINITE, REPEATED, RESTARTS = range(5)
N_COUNTS = 5
# Times [s] over all calls: as they came, and the minimum of each step's repeats
TOTAL, LONGEST, OWN_TOTAL, OWN_LONGEST, OWN_PLACE = range(5)
N_TIMES = 5
BINS_PER_OCTAVE, OCTAVES = 32, 40  # of the histograms, from 1 ns on
N_BINS = BINS_PER_OCTAVE * OCTAVES
BLOCK = 20  # steps from one saved state to the next
REPEATS = 3
WARNING = 1

# What stands at an address: functions of other forms than those that a run of connected FMUs calls.
plain = with_state = setup = _only_compiled

if way() in ("emit", "jit"):
    from thrustwasher.shift.cosim.compiled_loop import _function, types

    _word, _real, _int = types.int64, types.float64, types.int32
    plain = _function(_word)
    with_state = _function(_word, _word)
    setup = _function(_word, _int, _real, _real, _int, _real)


@kernel
def _set_inputs(calls: NDArray[np.int64], row: NDArray[np.float64]) -> int:
    """Hand all inputs over and return the status."""
    values = reals(calls[VALUES])
    for k in range(row.size):
        values[k] = row[k]
    set_real = values2(calls[SET_REAL])
    status: int = set_real(calls[COMPONENT], calls[REFERENCES], row.size, calls[VALUES])
    return status


@kernel
def _call_groups(calls: NDArray[np.int64], groups: NDArray[np.int64]) -> int:
    """Set or get all groups of values; return the worst status."""
    worst = 0
    for k in range(groups.shape[0]):
        call = values2(groups[k, FUNCTION])
        place, count = groups[k, GROUP_REFERENCES], groups[k, COUNT]
        worst = max(worst, call(calls[COMPONENT], place, count, groups[k, GROUP_VALUES]))
    return worst


@kernel
def _are_numbers(groups: NDArray[np.int64]) -> bool:
    """Tell if all Real values of the groups are finite."""
    for k in range(groups.shape[0]):
        if groups[k, IS_REAL] != 0:
            values = reals(groups[k, GROUP_VALUES])
            for i in range(groups[k, COUNT]):
                if not math.isfinite(values[i]):
                    return False
    return True


@kernel
def _restart(
    calls: NDArray[np.int64], parameters: NDArray[np.int64], row: NDArray[np.float64]
) -> int:
    """Put the instance back to its start and initialize it at time 0; return the status."""
    component = calls[COMPONENT]
    plain(calls[RESET])(component)
    _call_groups(calls, parameters)
    setup(calls[SETUP])(component, 0, 0.0, 0.0, 0, 0.0)
    plain(calls[ENTER])(component)
    _set_inputs(calls, row)
    status: int = plain(calls[EXIT])(component)
    return status


@kernel
def _step(
    calls: NDArray[np.int64],
    outputs: NDArray[np.int64],
    row: NDArray[np.float64],
    t: float,
    h: float,
    clock: NDArray[np.int64],
    tick: float,
) -> tuple[float, int]:
    """Set the inputs, step, get the outputs; return the time it took [s] and the worst status."""
    begun = _seconds(clock, tick)
    status = _set_inputs(calls, row)
    status = max(status, step2(calls[DO_STEP])(calls[COMPONENT], t, h, 1))
    status = max(status, _call_groups(calls, outputs))
    return _seconds(clock, tick) - begun, status


@kernel
def _bin(seconds: float) -> int:
    """Return the place of a time in a histogram."""
    octaves = math.log(max(seconds, 1e-9) * 1e9) / math.log(2.0)
    return min(int(BINS_PER_OCTAVE * octaves), N_BINS - 1)


@kernel
def run_steps(
    calls: NDArray[np.int64],
    parameters: NDArray[np.int64],
    outputs: NDArray[np.int64],
    inputs: NDArray[np.float64],
    sizes: NDArray[np.float64],
    restarts: NDArray[np.int64],
    at: NDArray[np.float64],
    clock: NDArray[np.int64],
    tick: float,
    slow: float,
    counts: NDArray[np.int64],
    times: NDArray[np.float64],
    raw: NDArray[np.int64],
    own: NDArray[np.int64],
) -> int:
    """Take the steps of a piece of a walk; the first one restarts the instance.

    Parameters
    ----------
    calls : addresses of the instance, its functions, its inputs
    parameters, outputs : groups of values
    inputs : (n, inputs) at each step; ``sizes`` (n,): of the steps [s]; ``restarts`` (n,): 1 where
        the instance begins anew before the step
    at : (n,) room for the time of each step, -1 where the instance could not be initialized
    clock, tick : of the operating system
    slow : steps that take longer [s] are done again
    counts, times : added to
    raw, own : histograms of the times, added to

    Returns the number of steps taken.
    """
    mark, t, taken = 0, 0.0, 0
    for i in range(sizes.size):
        if i % BLOCK == 0 or restarts[i] != 0:
            mark = i
            with_state(calls[GET_STATE])(calls[COMPONENT], calls[STATE])
        if restarts[i] != 0 or t < 0.0:
            t = -1.0 if _restart(calls, parameters, inputs[i]) > WARNING else 0.0
            counts[RESTARTS] += 1
        at[i] = t
        if t < 0.0:
            continue
        spent, status = _step(calls, outputs, inputs[i], t, sizes[i], clock, tick)
        least = spent
        if spent > slow:
            counts[REPEATED] += 1
            for _ in range(REPEATS):
                with_state(calls[SET_STATE])(calls[COMPONENT], int64s(calls[STATE])[0])
                for j in range(mark, i + 1):
                    if restarts[j] != 0 or (j > mark and at[j - 1] < 0.0):
                        _restart(calls, parameters, inputs[j])
                    if at[j] >= 0.0:
                        again, status = _step(
                            calls, outputs, inputs[j], at[j], sizes[j], clock, tick
                        )
                        if j == i:
                            least = min(least, again)
        counts[STEPS] += 1
        taken += 1
        if status > WARNING:
            counts[FAILED] += 1
        elif not _are_numbers(outputs):
            counts[NOT_FINITE] += 1
        times[TOTAL] += spent
        times[LONGEST] = max(times[LONGEST], spent)
        times[OWN_TOTAL] += least
        if least > times[OWN_LONGEST]:
            times[OWN_LONGEST], times[OWN_PLACE] = least, float(i)
        raw[_bin(spent)] += 1
        own[_bin(least)] += 1
        if status <= WARNING:
            t += sizes[i]
    return taken
