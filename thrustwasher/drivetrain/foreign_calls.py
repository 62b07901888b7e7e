"""Calls of C functions by their address, for compiled code; in plain Python they do not exist."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..kernels._jit import way

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
