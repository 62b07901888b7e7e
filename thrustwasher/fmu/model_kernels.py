"""The kernels of a model, and the digest that ties an FMU to this package."""

import hashlib
import importlib.util
import sys
from functools import cache
from pathlib import Path
from typing import Any

from ..model.prepare import tables_of
from ..model.registry import kernel_of
from ..model.spec import ModelSpec
from ..native.code import code_of
from ..native.digest import read
from ..native.library import is_ready
from ..numerics.jit import kernel_digest, way


def has_derivatives(spec: ModelSpec) -> bool:
    """Tell if the model's kernels give directional derivatives."""
    return hasattr(kernel_of(spec), "sens")


def seed_length(kernel: Any) -> int:
    """Return how many numbers a direction of a derivative has: inputs, then tunable parameters."""
    return int(getattr(kernel, "NSEED", kernel.NINP))


def is_compiled(spec: ModelSpec) -> bool:
    """Tell if the model's kernels are compiled, so that their first call takes no minutes."""
    return way() == "python" or is_ready(spec.kernel)


def package_version() -> str:
    """Return the version of the code that runs, whatever is installed next to it."""
    return str(sys.modules[__name__.partition(".")[0]].__version__)


def content_digest(spec: ModelSpec) -> str:
    """Return 16 hex digits over everything that decides the numbers: kernels, maps, the model.

    Of a source only the code counts, not comments and docstrings.
    """
    return _content_digest(spec.kernel, spec.params.__module__, tables_of(spec) is not None)


@cache
def _content_digest(kernel: str, params: str, table: bool) -> str:
    hashed = hashlib.sha256(f"{package_version()} {kernel_digest()}".encode())
    for file in content_files(kernel, params, table):
        is_code = file.suffix == ".py"
        content = code_of(read(file)).digest.encode() if is_code else file.read_bytes()
        hashed.update(file.name.encode() + content)
    return hashed.hexdigest()[:16]


def content_files(kernel: str, params: str, table: bool) -> list[Path]:
    """Return the files that a model's digest is made of, in addition to the package's kernels.

    They are the module of its kernel and that of its parameters, all sources and lists in the
    folder of the latter where that is a package, and the shipped maps where it looks into one.
    """
    found = [importlib.util.find_spec(name) for name in (kernel, params)]
    files = [Path(s.origin) for s in found if s and s.origin]
    if "." in params:
        folder = files[-1].parent
        files += sorted(path for path in folder.iterdir() if path.suffix in (".py", ".toml"))
    if table:
        files += sorted((Path(__file__).parents[1] / "data" / "maps").glob("*.twm"))
    return files
