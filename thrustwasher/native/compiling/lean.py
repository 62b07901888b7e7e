"""What numba does for each function although only the module of all of them is wanted: left out.

numba is made to run every function it compiles. It links all functions below one into it and
optimises the whole again, makes machine code of it, wraps it for Python, and keeps it on the disk:
four fifths of the time. Here each function's own module is kept as it was written, and all are
linked once. Who else holds an array is not counted: kernels make none. None of this is public in
numba: a version whose parts are not as expected is refused.
"""

import inspect
from collections import Counter
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from .callbacks import Callback, check_convention, compiled, function_name, unknown_numba

# Methods that are replaced, with their arguments in the versions this was written for.
_EXPECTED = {
    ("JITCodeLibrary", "finalize"): ["self"],
    ("JITCodeLibrary", "add_linking_library"): ["self", "library"],
    ("JITCodeLibrary", "add_llvm_module"): ["self", "ll_module"],
    ("JITCodeLibrary", "get_pointer_to_function"): ["self", "name"],
    ("JITCPUCodegen", "set_env"): ["self", "env_name", "env"],
    ("Lower", "delvar"): ["self", "name"],
    ("Lower", "_find_singly_assigned_variable"): ["self"],
    ("BaseFunction", "get_call_type"): ["self", "context", "args", "kws"],
    ("NRTContext", "incref"): ["self", "builder", "typ", "value"],
    ("NRTContext", "decref"): ["self", "builder", "typ", "value"],
}


def check_numba() -> None:
    """Stop if numba's code generator lacks the parts that are replaced here."""
    from numba.core import codegen, lowering
    from numba.core.runtime import context
    from numba.core.types import functions

    homes = {"NRTContext": context, "BaseFunction": functions, "Lower": lowering}
    for (owner, name), arguments in _EXPECTED.items():
        method = getattr(getattr(homes.get(owner, codegen), owner, None), name, None)
        if method is None or list(inspect.signature(method).parameters) != arguments:
            raise unknown_numba(f"{owner}.{name} is not as expected")


def module(callbacks: Sequence[Callback]) -> Any:
    """Return one LLVM module with the functions of all callbacks under their symbols.

    numba compiles for nothing else in this process from then on. EnvironmentProblem: this numba is
    built otherwise.
    """
    check_numba()
    libraries = _gathered()
    names = {function_name(compiled(callback)): callback.symbol for callback in callbacks}
    return _linked(libraries, names)


@cache
def _gathered() -> list[Any]:
    """Replace the parts; return the list that each finished library of functions is added to."""
    from numba.core import codegen, lowering
    from numba.core.runtime import context
    from numba.core.types import functions

    parts: Any = codegen
    lower: Any = lowering.Lower
    counting: Any = context
    typing: Any = functions.BaseFunction
    libraries: list[Any] = []

    def finalize(self: Any) -> None:
        self._finalized = True
        libraries.append(self)

    def add_llvm_module(self: Any, ll_module: Any) -> None:
        ll_module.data_layout = self._codegen._data_layout
        self._final_module.link_in(ll_module)

    def get_pointer_to_function(self: Any, name: str) -> int:
        """Return the address of a function that is never called."""
        self._ensure_finalized()
        return 1

    parts.JITCodeLibrary.finalize = finalize
    parts.JITCodeLibrary.add_llvm_module = add_llvm_module
    parts.JITCodeLibrary.get_pointer_to_function = get_pointer_to_function
    parts.JITCPUCodegen.set_env = lambda self, env_name, env: None
    lower.delvar = lambda self, name: None  # nothing is counted, so nothing has to be let go
    lower._find_singly_assigned_variable = _with_the_first_block(
        lower._find_singly_assigned_variable
    )
    typing.get_call_type = _remembered(typing.get_call_type)
    counting.NRTContext.incref = counting.NRTContext.decref = lambda self, builder, typ, value: None
    return libraries


def _with_the_first_block(find: Callable[..., None]) -> Callable[..., None]:
    """Return what finds the variables that need no place in memory, more of them than numba's own.

    numba takes those that one block alone uses. One that is set once, in the first block, as an
    argument, has its value ready in all others; a tuple of arrays in memory is read as a whole
    wherever one of them is used.
    """
    from numba.core import ir

    kind: Any = ir.Assign

    def found(self: Any) -> None:
        find(self)
        blocks = self.blocks
        names = [a.target.name for block in blocks.values() for a in block.find_insts(kind)]
        first, times = blocks[min(blocks)], Counter(names)
        once = {a.target.name for a in first.find_insts(kind) if times[a.target.name] == 1}
        self._singly_assigned_vars |= once

    return found


def _remembered(get_call_type: Callable[..., Any]) -> Callable[..., Any]:
    """Return numba's choice of an operator's variant, which is tried out, made once per types."""
    from numba.core import types

    plain: Any = (types.Number, types.Boolean, types.Array, types.BaseTuple, types.Literal)
    known: dict[Any, tuple[Any, Any]] = {}

    def remembered(self: Any, context: Any, args: Any, kws: Any) -> Any:
        if kws or not all(isinstance(kind, plain) for kind in args):
            return get_call_type(self, context, args, kws)
        key = id(self), tuple(args)
        if key not in known:
            known[key] = self, get_call_type(self, context, args, kws)  # kept, so is its id
        return known[key][1]

    return remembered


def _linked(libraries: Sequence[Any], names: dict[str, str]) -> Any:
    """Return all modules in one, callers before what they call.

    Neighbours are linked in pairs: each time all that has been linked before is looked through.
    """
    import llvmlite.binding as llvm

    parts = []
    for library in reversed(libraries):
        part = library._final_module.clone()
        own = {f.name for f in part.functions if not f.is_declaration}
        for name in own & names.keys():
            check_convention(str(part), name)
        for function in part.functions:
            external = function.linkage == llvm.Linkage.external
            if external and function.name in own and function.name not in names:
                function.linkage = "weak_odr"
        parts.append(part)
    while len(parts) > 1:
        for one, next_one in zip(parts[::2], parts[1::2], strict=False):
            one.link_in(next_one)
        parts = parts[::2]
    whole = parts[0]
    for name, symbol in names.items():
        function = whole.get_function(name)
        function.name, function.linkage = symbol, "external"
    return whole
