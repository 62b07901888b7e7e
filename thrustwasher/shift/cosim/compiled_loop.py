"""The loop over communication points as one compiled function over the FMUs' own C functions.

``compiled_layout`` lists the operations of one communication step; this function works through the
list for one point after another. Numbers and addresses in, numbers out. It stops where an FMU
reports something and can be entered again at the operation that follows.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...numerics.jit import kernel, way

# Kinds of operations
PULL, BEGIN, SET, STEP, GET, END, REPLAY = range(7)
# Columns of an operation. REFERENCES .. FIRST: of a group of values of one type; PULL: how many
# pairs of places, and where in ``places`` they begin; REPLAY: how many values, the first one's
# place and column.
KIND, PART, FUNCTION, COMPONENT, REFERENCES, COUNT, BUFFER, OFFSET, TYPE, FIRST = range(10)
WIDTH = 10
REAL, INT32, INT64, BYTE = range(4)  # types of values
# What the caller hands over and gets back: the point, the operation to go on with, the status of
# the last call.
AT_POINT, AT_OPERATION, LAST_STATUS = range(3)
DONE, REPORTED = range(2)
WARNING = 1

# Calls of C functions by their address, for compiled code; in plain Python they do not exist.
Foreign = Callable[[int, tuple[Any, ...]], int]  # address, arguments


def _only_compiled(*_: Any) -> int:
    raise NotImplementedError("only compiled code can call the function at an address")


values2: Foreign = _only_compiled  # int f(word, word, word, word)
values3: Foreign = _only_compiled  # int f(word, word, word, word, word)
step2: Foreign = _only_compiled  # int f(word, double, double, int)
step3: Foreign = _only_compiled  # int f(word, double, double, int, word, word, word, word)
clock_posix: Foreign = _only_compiled  # int f(int, word)
clock_windows: Foreign = _only_compiled  # int f(word)
number_at: Any = _only_compiled  # the 64-bit integer at an address

if way() in ("emit", "jit"):
    from llvmlite import ir
    from numba import types
    from numba.core import cgutils
    from numba.extending import intrinsic

    INT = ir.IntType(32)
    WORD = ir.IntType(64)  # an address or a length
    DOUBLE = ir.DoubleType()

    def _foreign(*kinds: Any) -> Any:
        """Return a call of the C function at an address: ``int f(kinds...)``."""
        unpack: Any = cgutils.unpack_tuple

        @intrinsic
        def call(_typing: Any, function: Any, arguments: Any) -> Any:
            def code(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
                address, packed = values
                pointer = builder.inttoptr(address, ir.FunctionType(INT, kinds).as_pointer())
                given = unpack(builder, packed, len(kinds))
                cut = [
                    builder.trunc(v, k) if v.type == WORD and k == INT else v
                    for v, k in zip(given, kinds, strict=True)
                ]
                return builder.call(pointer, cut)

            return types.int32(types.int64, arguments), code

        return call

    @intrinsic
    def _integer_at(_typing: Any, address: Any) -> Any:
        def code(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
            return builder.load(builder.inttoptr(values[0], WORD.as_pointer()))

        return types.int64(types.int64), code

    number_at = _integer_at
    values2 = _foreign(WORD, WORD, WORD, WORD)
    values3 = _foreign(WORD, WORD, WORD, WORD, WORD)
    step2 = _foreign(WORD, DOUBLE, DOUBLE, INT)
    step3 = _foreign(WORD, DOUBLE, DOUBLE, INT, WORD, WORD, WORD, WORD)
    clock_posix = _foreign(INT, WORD)
    clock_windows = _foreign(WORD)


@kernel
def _seconds(clock: NDArray[np.int64], tick: float, ticks: NDArray[np.int64]) -> float:
    """Return the time of the wall clock; ``clock``: function, its number or -1, place of ticks."""
    if clock[0] == 0:
        return 0.0
    if clock[1] < 0:
        clock_windows(clock[0], (clock[2],))
        return float(ticks[0]) * tick
    clock_posix(clock[0], (clock[1], clock[2]))
    return float(ticks[0]) + 1e-9 * float(ticks[1])


@kernel
def _fill(
    op: NDArray[np.int64], now: NDArray[np.float64], places: NDArray[np.int64],
    reals: NDArray[np.float64], ints: NDArray[np.int32], longs: NDArray[np.int64],
    bytes_: NDArray[np.uint8],
) -> None:  # fmt: skip
    """Put present values into the group's buffer; whole numbers lose what is behind the point."""
    for j in range(op[COUNT]):
        value, at = now[places[op[FIRST] + j]], op[OFFSET] + j
        if op[TYPE] == REAL:
            reals[at] = value
        elif op[TYPE] == INT32:
            ints[at] = np.int32(value)
        elif op[TYPE] == INT64:
            longs[at] = np.int64(value)
        else:
            bytes_[at] = np.uint8(value != 0.0)


@kernel
def _take(
    op: NDArray[np.int64], now: NDArray[np.float64], places: NDArray[np.int64],
    reals: NDArray[np.float64], ints: NDArray[np.int32], longs: NDArray[np.int64],
    bytes_: NDArray[np.uint8],
) -> None:  # fmt: skip
    """Take present values out of the group's buffer."""
    for j in range(op[COUNT]):
        place, at = places[op[FIRST] + j], op[OFFSET] + j
        if op[TYPE] == REAL:
            now[place] = reals[at]
        elif op[TYPE] == INT32:
            now[place] = float(ints[at])
        elif op[TYPE] == INT64:
            now[place] = float(longs[at])
        else:
            now[place] = 1.0 if bytes_[at] else 0.0


@kernel
def _call(op: NDArray[np.int64], third: bool) -> int:
    """Set or get a group of values and return the status."""
    first = (op[COMPONENT], op[REFERENCES], op[COUNT], op[BUFFER])
    if third:
        return values3(op[FUNCTION], (first[0], first[1], first[2], first[3], op[COUNT]))
    return values2(op[FUNCTION], first)


@kernel
def _step(op: NDArray[np.int64], third: bool, t: float, h: float, told: int) -> int:
    """Let a part step and return the status."""
    if third:
        places = (told, told + 8, told + 16, told + 24)
        return step3(
            op[FUNCTION],
            (op[COMPONENT], t, h, np.int64(0), places[0], places[1], places[2], places[3]),
        )
    return step2(op[FUNCTION], (op[COMPONENT], t, h, np.int64(0)))


@kernel
def run_operations(
    operations: NDArray[np.int64], places: NDArray[np.int64], third: NDArray[np.int64],
    said: NDArray[np.int64], now: NDArray[np.float64], reals: NDArray[np.float64],
    ints: NDArray[np.int32], longs: NDArray[np.int64], bytes_: NDArray[np.uint8],
    told: int, clock: NDArray[np.int64], tick: float, ticks: NDArray[np.int64],
    begun: NDArray[np.float64], spent: NDArray[np.float64], calls: NDArray[np.int64],
    time: NDArray[np.float64], h: float, commands: NDArray[np.float64], command: int,
    rows: NDArray[np.float64], recorded: NDArray[np.float64], stop: int,
    report: NDArray[np.int64],
) -> int:  # fmt: skip
    """Work through the operations for the points from ``report[AT_POINT]`` to ``stop``.

    Returns DONE, or REPORTED if the call before operation ``report[AT_OPERATION]`` had a status
    above WARNING or its part said something (the number at its address in ``said`` is not 0).
    ``now`` holds the present values of all parts, ``rows`` gets them at every point; ``recorded``
    has a row for each step, what parts give that only play a record.
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
                    now[op[FIRST] + j] = recorded[i, op[OFFSET] + j]
                continue
            if kind == BEGIN:
                begun[part] = _seconds(clock, tick, ticks)
                continue
            if kind == END:
                spent[part] += _seconds(clock, tick, ticks) - begun[part]
                continue
            if kind == SET:
                _fill(op, now, places, reals, ints, longs, bytes_)
                status = _call(op, third[part] != 0)
            elif kind == STEP:
                calls[part] += 1
                status = _step(op, third[part] != 0, time[i], h, told)
            else:
                status = _call(op, third[part] != 0)
                if status <= WARNING:
                    _take(op, now, places, reals, ints, longs, bytes_)
            if status > WARNING or number_at(said[part]) != 0:
                report[LAST_STATUS] = status
                return REPORTED
        for k in range(len(now)):
            rows[i + 1, k] = now[k]
        report[AT_POINT], report[AT_OPERATION] = i + 1, 0
    return DONE
