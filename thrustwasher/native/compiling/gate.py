"""What a kernel may need: the mathematical functions linked with it, and memory functions."""

import re
from collections.abc import Iterable
from typing import Any

from ...errors import EnvironmentProblem
from .. import mathematics
from ..binaries import undefined

# The list grows by a reviewed line, never by a pattern. The stack probe of Windows for frames above
# 4 kB is put into the library by the linker itself. The third line is macOS's: memset of eight or
# sixteen bytes at once, in its C library since 10.5.
MEMORY = frozenset(
    """
    memset memcpy memmove bzero __bzero
    ___chkstk_ms
    memset_pattern8 memset_pattern16
    """.split()
)
ALLOWED = MEMORY | mathematics.defined().keys()
MACHINES = re.compile(r"llvm\.(x86|aarch64|arm)\.")
# Beginnings of a symbol -> what is behind it and what to write instead.
CAUSES = (
    ("NRT_Allocate NRT_Free", "memory is allocated: pass it as work; copy slices in a loop"),
    ("NRT_MemInfo_alloc", "an array is allocated: pass it as work"),
    ("NRT_", "an object of numba's run time, like a list: pass an array as work"),
    ("numba_attempt_nocopy_reshape", "reshape, or a reduction like np.max: write the loop"),
    ("numba_gamma", "math.gamma: write the series as a kernel"),
    ("numba_xxdot", "np.dot: write the loop"),
    ("numba_xx numba_ez", "np.linalg: use kernels.banded or kernels.dense"),
    ("numba_gil", "Python's lock, for np.dot, np.linalg or print: leave them out"),
    ("numba_get_np_random numba_rnd", "np.random: random numbers are inputs"),
    ("numba_", "a helper of numba's run time: write it as a kernel"),
    ("PyErr_ PyExc_", "raise with a value: return a status"),
    ("Py _Py", "a Python object: numbers in, numbers out"),
    ("__svml_", "Intel's vector library: NUMBA_DISABLE_INTEL_SVML=1"),
    ("__chkstk", "a frame above 4 kB: keep arrays in work, no large tuples"),
    ("/numba/", "an error that names a file here, as of x**n with a whole n: write x**float(n)"),
    ("inttoptr", "an address of the building process, of a Python object or ctypes function"),
    ("llvm.", "an instruction of one kind of machine"),
)


def check_module(module: Any, kernel: str) -> None:
    """Stop if an optimised module of llvmlite needs more than is allowed; name cause and cure."""
    found = [v.name for v in module.global_variables if v.is_declaration]
    text = str(module)
    if re.search(r"inttoptr \(i64 \d", text):  # of an object of the compiling process
        found.append("inttoptr")
    if "/numba/" in text:  # the same code elsewhere would have other bytes
        found.append("/numba/")
    for function in module.functions:
        name = function.name  # intrinsics of any machine pass: those left over become calls
        allowed = not MACHINES.match(name) if name.startswith("llvm.") else name in ALLOWED
        if function.is_declaration and not allowed:
            found.append(name)
    _stop(kernel, found)


def check_object(code: bytes, kernel: str) -> None:
    """Stop if an object file refers to more than is allowed: intrinsics become calls late."""
    _stop(kernel, [name for name in undefined(code) if name not in ALLOWED])


def cause(symbol: str) -> str:
    """Return what is behind a symbol and the cure."""
    for beginnings, text in CAUSES:
        if symbol.startswith(tuple(beginnings.split())):
            return text
    return "not on the list in thrustwasher/native/compiling/gate.py"


def _stop(kernel: str, found: Iterable[str]) -> None:
    symbols = sorted(set(found))
    if symbols:
        causes = "; ".join(dict.fromkeys(cause(symbol) for symbol in symbols))
        raise EnvironmentProblem(
            f"{kernel} is not self-contained, it needs {', '.join(symbols)} ({causes})"
        )
