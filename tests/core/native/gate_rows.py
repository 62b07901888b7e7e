"""One kernel per row of the rules; run as a program it says what the gate thinks of each.

A name in ``REFUSED`` stands for the symbol that has to be in the message.
"""

import ctypes
import json
import math
import sys
import warnings
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np

from thrustwasher.errors import EnvironmentProblem
from thrustwasher.native.compiling import emit, lower
from thrustwasher.native.targets import PLATFORMS
from thrustwasher.numerics.jit import kernel

LABS = ctypes.CDLL(None).labs
LABS.restype, LABS.argtypes = ctypes.c_long, [ctypes.c_long]
TABLE = np.linspace(0.0, 1.0, 7)


class Pair(NamedTuple):
    first: float
    second: float


@kernel
def swapped(pair):
    return Pair(pair.second, pair.first), (pair.first, 1)


@kernel
def plain_loop(a):
    for i in range(1, 8):
        a[i] += a[i - 1]
    return 0


@kernel
def tuples(a):
    pair, other = swapped(Pair(a[0], a[1]))
    a[2] = pair.first + other[0] * other[1]
    return 0


@kernel
def read_slice(a):
    a[0] = a[1:4].sum()
    return 0


@kernel
def constant_table(a):
    a[0] = TABLE[int(a[1])]
    return 0


@kernel
def arithmetic(a):
    x, y = a[0], a[1]
    a[2] = x // y + x / y + x**y + x % y + round(x) + math.floor(x) + math.sqrt(x)
    a[3] = math.hypot(x, y) + np.sign(x) + math.copysign(x, y) + min(x, y) + max(x, y) + abs(x)
    return 1 if math.isfinite(a[3]) else 0


@kernel
def functions(a):
    x = a[0]
    a[1] = math.exp(x) + math.log(x) + math.pow(x, 1.7) + math.sin(x) + math.cos(x)
    a[2] = math.tanh(x) + math.erf(x) + math.expm1(x) + math.log1p(x)
    return 0


@kernel
def raises_a_constant(a):
    if a[0] < 0.0:
        raise ValueError("below zero")
    assert a[1] > 0.0
    return 0


@kernel
def zeros(a):
    b = np.zeros(3)
    b[0] = a[0]
    return int(b[int(a[1])])


@kernel
def reshaped(a):
    return int(a.reshape(2, 4)[1, int(a[0])])


@kernel
def gamma(a):
    return int(math.gamma(a[0]))


@kernel
def raises_a_number(a):
    if a[0] < 0.0:
        raise ValueError("below zero", a[0])
    return 0


@kernel
def dot(a):
    return int(np.dot(a, a))


@kernel
def prints(a):
    print(a[0])
    return 0


@kernel
def random(a):
    a[0] = np.random.random()  # noqa: NPY002
    return 0


@kernel
def calls_an_address(a):
    return LABS(int(a[0]))


@kernel
def whole_power(a):
    a[0] = 10.0 ** int(a[1])
    return 0


PASSED = (plain_loop, tuples, read_slice, constant_table, arithmetic, functions, raises_a_constant)
REFUSED = {
    zeros: "NRT_",
    reshaped: "numba_attempt_nocopy_reshape",
    gamma: "numba_gamma",
    raises_a_number: "PyErr_",
    dot: "numba_xxdot",
    prints: "numba_gil",
    random: "np.random",
    calls_an_address: "inttoptr",
    whole_power: "/numba/",
}


def judged(function):
    """Return what the gate says of a kernel, "" if nothing."""
    rows = SimpleNamespace(derive=function, NPAR=8, __name__="gate.rows")
    platform = PLATFORMS["linux64"]
    try:
        bitcode = emit.module(rows).as_bitcode()
        lower.object_code(bitcode, platform, platform.levels[0], "rows.derive")
    except EnvironmentProblem as problem:
        return str(problem)
    return ""


if __name__ == "__main__":
    import llvmlite.binding as llvm

    llvm.initialize_all_targets()
    warnings.simplefilter("ignore")
    print(json.dumps({f.__name__: judged(f) for f in (*PASSED, *REFUSED)}))
    sys.exit(0)
