"""The loop over communication points as one compiled function over the FMUs' own C functions.

``compiled_layout`` lists the operations of one communication step; this function works through the
list for one point after another. Numbers and addresses in, numbers out. It stops where an FMU
reports something and can be entered again at the operation that follows.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...numerics.jit import kernel, way

# Kinds of operations
PULL, BEGIN, SET, STEP, GET, END, REPLAY = range(7)
# Columns of an operation. REFERENCES .. FIRST: of a group of values of one type, VALUES its
# address; PULL: how many pairs of places, and where in ``places`` they begin; REPLAY: how many
# values, the column of the first one, and its place. LOGGED: address of a number that is not 0 once
# the part has logged something. THIRD: whether it is one of FMI 3.
KIND, PART, FUNCTION, COMPONENT, REFERENCES, COUNT, VALUES, TYPE, FIRST, LOGGED, THIRD = range(11)
WIDTH = 11
REAL, INT32, INT64, BYTE = range(4)  # types of values
# What the caller hands over and gets back: the point, the operation to go on with, the status of
# the last call.
AT_POINT, AT_OPERATION, LAST_STATUS = range(3)
DONE, REPORTED = range(2)
WARNING = 1


def _only_compiled(_address: int) -> Any:
    raise NotImplementedError("only compiled code has pointers")


# What stands at an address: numbers, C functions of both FMI versions, clocks of both systems.
reals = int32s = int64s = bytes_ = _only_compiled
values2 = values3 = step2 = step3 = clock_posix = clock_windows = _only_compiled

if way() in ("emit", "jit"):
    import numba

    from ...native.compiling.callbacks import pointer

    types: Any = numba.types

    def _function(*takes: object) -> Any:
        """Return what makes of an address a C function ``int f(takes...)``."""
        return pointer(types.ExternalFunctionPointer(types.int32(*takes), None))

    reals, int32s, int64s, bytes_ = (
        pointer(types.CPointer(t)) for t in (types.float64, types.int32, types.int64, types.uint8)
    )
    _word, _real, _int = types.int64, types.float64, types.int32
    values2 = _function(_word, _word, _word, _word)
    values3 = _function(_word, _word, _word, _word, _word)
    step2 = _function(_word, _real, _real, _int)
    step3 = _function(_word, _real, _real, _int, _word, _word, _word, _word)
    clock_posix = _function(_int, _word)
    clock_windows = _function(_word)


@kernel
def _seconds(clock: NDArray[np.int64], tick: float) -> float:
    """Return the time of the wall clock; ``clock``: function, its number or -1, place of ticks."""
    if clock[0] == 0:
        return 0.0
    ticks = int64s(clock[2])
    if clock[1] < 0:
        clock_windows(clock[0])(clock[2])
        return float(ticks[0]) * tick
    clock_posix(clock[0])(clock[1], clock[2])
    return float(ticks[0]) + 1e-9 * float(ticks[1])


@kernel
def _fill(op: NDArray[np.int64], now: NDArray[np.float64], places: NDArray[np.int64]) -> None:
    """Put present values where the FMU reads them; whole numbers lose what is behind the point."""
    for j in range(op[COUNT]):
        value = now[places[op[FIRST] + j]]
        if op[TYPE] == REAL:
            reals(op[VALUES])[j] = value
        elif op[TYPE] == INT32:
            int32s(op[VALUES])[j] = np.int32(value)
        elif op[TYPE] == INT64:
            int64s(op[VALUES])[j] = np.int64(value)
        else:
            bytes_(op[VALUES])[j] = np.uint8(value != 0.0)


@kernel
def _take(op: NDArray[np.int64], now: NDArray[np.float64], places: NDArray[np.int64]) -> None:
    """Take present values from where the FMU has written them."""
    for j in range(op[COUNT]):
        place = places[op[FIRST] + j]
        if op[TYPE] == REAL:
            now[place] = reals(op[VALUES])[j]
        elif op[TYPE] == INT32:
            now[place] = float(int32s(op[VALUES])[j])
        elif op[TYPE] == INT64:
            now[place] = float(int64s(op[VALUES])[j])
        else:
            now[place] = 1.0 if bytes_(op[VALUES])[j] else 0.0


@kernel
def _call(op: NDArray[np.int64]) -> int:
    """Set or get a group of values and return the status."""
    function, component, references = op[FUNCTION], op[COMPONENT], op[REFERENCES]
    count, values = op[COUNT], op[VALUES]
    if op[THIRD]:
        status: int = values3(function)(component, references, count, values, count)
    else:
        status = values2(function)(component, references, count, values)
    return status


@kernel
def _step(op: NDArray[np.int64], t: float, h: float, back: int) -> int:
    """Let a part step and return the status."""
    function, component = op[FUNCTION], op[COMPONENT]
    if op[THIRD]:
        status: int = step3(function)(component, t, h, 0, back, back + 8, back + 16, back + 24)
    else:
        status = step2(function)(component, t, h, 0)
    return status


@kernel
def run_operations(
    operations: NDArray[np.int64],
    places: NDArray[np.int64],
    now: NDArray[np.float64],
    back: int,
    clock: NDArray[np.int64],
    tick: float,
    begun: NDArray[np.float64],
    spent: NDArray[np.float64],
    calls: NDArray[np.int64],
    time: NDArray[np.float64],
    h: float,
    commands: NDArray[np.float64],
    command: int,
    rows: NDArray[np.float64],
    recorded: NDArray[np.float64],
    stop: int,
    report: NDArray[np.int64],
) -> int:
    """Work through the operations for the points from ``report[AT_POINT]`` to ``stop``.

    Returns DONE, or REPORTED if the call before operation ``report[AT_OPERATION]`` had a status
    above WARNING or its part logged something. ``now`` holds the present values of all parts,
    ``rows`` gets them at every point; ``recorded`` has a row for each step, what parts give that
    only play a record.
    """
    n = len(operations)
    while report[AT_POINT] < stop:
        i = report[AT_POINT]
        now[command] = commands[i + 1]
        while report[AT_OPERATION] < n:
            op = operations[report[AT_OPERATION]]
            report[AT_OPERATION] += 1
            kind, part, status = op[KIND], op[PART], 0
            if kind == PULL:
                for j in range(op[FIRST], op[FIRST] + 2 * op[COUNT], 2):
                    now[places[j]] = now[places[j + 1]]
                continue
            if kind == REPLAY:
                for j in range(op[COUNT]):
                    now[op[FIRST] + j] = recorded[i, op[VALUES] + j]
                continue
            if kind == BEGIN:
                begun[part] = _seconds(clock, tick)
                continue
            if kind == END:
                spent[part] += _seconds(clock, tick) - begun[part]
                continue
            if kind == SET:
                _fill(op, now, places)
                status = _call(op)
            elif kind == STEP:
                calls[part] += 1
                status = _step(op, time[i], h, back)
            else:
                status = _call(op)
                if status <= WARNING:
                    _take(op, now, places)
            if status > WARNING or int64s(op[LOGGED])[0] != 0:
                report[LAST_STATUS] = status
                return REPORTED
        for k in range(len(now)):
            rows[i + 1, k] = now[k]
        report[AT_POINT], report[AT_OPERATION] = i + 1, 0
    return DONE
