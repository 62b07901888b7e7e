"""The kernels of a model, and the digest that ties an FMU to this package."""

import hashlib
import importlib
import importlib.util
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from ..model.record import resolve
from ..model.spec import ModelSpec
from ..native.library import is_ready
from ..numerics.jit import kernel_digest, way


class Kernel(NamedTuple):
    """The compiled entries of a model, the lengths of their arrays, and what only some have."""

    derive: Callable[[Any], int]
    step: Callable[..., int]
    n_param: int
    n_par: int
    n_inp: int
    n_state: int
    n_work: int
    n_out: int
    n_iout: int
    sens: Callable[..., int] | None
    """``sens(par, inp, state, work, seed, dout)``: directional derivatives."""
    broken_rule: Callable[[Any], int] | None
    """``broken_rule(par)``: number of the first rule that the parameters break, 0: none."""
    table: dict[str, float]
    """Where in ``work`` a model's table lies and how it is known, by name; ROOM 0: none.

    ``AT``, ``ROOM``: place and length. ``MAGIC``: its first number. ``SIZE``: place of its length.
    ``PARAMS``, ``N_PARAMS``: place and number of the parameters it was made for. ``HEADER``: how
    many of its numbers are doubles in a file. ``SWITCH``, ``ON``: place in ``par`` and number of
    the fidelity that wants it.
    """


@cache
def load_kernel(name: str) -> Kernel:
    """Import a kernel module, by its dotted name."""
    k = importlib.import_module(name)
    sizes = (k.N_PARAM, k.NPAR, k.NINP, k.NSTATE, k.NWORK, k.NOUT, k.NIOUT)
    sens, broken_rule = (getattr(k, entry, None) for entry in ("sens", "broken_rule"))
    table = getattr(k, "TABLE", None) or {"ROOM": 0}
    return Kernel(k.derive, k.step, *sizes, sens=sens, broken_rule=broken_rule, table=table)


def has_derivatives(spec: ModelSpec) -> bool:
    """Tell if the model's kernels give directional derivatives."""
    return load_kernel(spec.kernel).sens is not None


def is_compiled(spec: ModelSpec) -> bool:
    """Tell if the model's kernels are compiled, so that their first call takes no minutes."""
    return way() == "python" or is_ready(spec.kernel)


def count_places(spec: ModelSpec) -> tuple[tuple[str, int], ...]:
    """Return (text, place in ``work``) of everything the model's solver counts."""
    return tuple((text, int(resolve(where))) for text, where in spec.counts)


def package_version() -> str:
    """Return the version of the code that runs, whatever is installed beside it."""
    return str(sys.modules[__name__.partition(".")[0]].__version__)


def content_digest(spec: ModelSpec) -> str:
    """Return 16 hex digits over everything that decides the numbers: kernels, maps, parameters."""
    return _content_digest(spec.kernel, spec.params.__module__, bool(spec.table))


@cache
def _content_digest(kernel: str, params: str, table: bool) -> str:
    found = [importlib.util.find_spec(name) for name in (kernel, params)]
    files = [Path(s.origin) for s in found if s and s.origin]
    if table:
        files += sorted((Path(__file__).parents[1] / "data" / "maps").glob("*.twm"))
    hashed = hashlib.sha256(f"{package_version()} {kernel_digest()}".encode())
    for file in files:
        hashed.update(file.name.encode() + file.read_bytes())
    return hashed.hexdigest()[:16]
