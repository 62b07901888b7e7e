"""Where the FMUs' own sources lie, and the GUID made of all that decides an FMU's content."""

import hashlib
import re
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from typing import NamedTuple

from ...errors import EnvironmentProblem
from ...model.registry import MODELS as HOMES
from ...model.spec import ModelSpec
from ...native.files import Note
from ..description.interface import Interface
from ..model_kernels import content_digest, package_version

PACKAGE = Path(str(files(__name__.partition(".")[0])))
OWN = (PACKAGE / "fmu", PACKAGE / "native")  # what packs and links
SHARED = ("shell", "portable", "documentation")  # folders next to those of the models
TEXTS = (".py", ".c", ".h", ".md", ".html", ".jinja", ".toml", ".txt", ".svg", ".png")


def source_folder() -> Path:
    """Return the folder of shell and texts: next to the package in a source tree, else in it."""
    for folder in (PACKAGE / "_fmu_src", PACKAGE.parent / "fmu_src"):
        if folder.is_dir():
            return folder
    raise EnvironmentProblem(
        "the folder fmu_src is missing next to the package; install thrustwasher again"
    )


def model_folder(spec: ModelSpec, sources: Path) -> Path:
    """Return the folder of a model's readme and icon, such as ``thrust_washer``.

    Of a model outside this package that is the folder of its record.
    """
    home = HOMES.get(spec.key, PACKAGE.name)
    if home.partition(".")[0] != PACKAGE.name:
        return Path(str(files(home) / "model.py")).parent
    return sources / re.sub(r"(?<=[a-z])(?=[A-Z])", "_", spec.kind or spec.name).lower()


class Order(NamedTuple):
    """What kind of FMU is built.

    ``local``: compiled for the processor of this machine; ``c_sources``: with the folder sources;
    ``plain``: real and whole numbers only, see ``build``.
    """

    target: str
    fmi: int
    platforms: Sequence[str]
    note: Note
    local: bool = False
    c_sources: bool = False
    plain: bool = False


def identifier(
    shown: Interface, folder: Path, order: Order, tools: str = "", shared: Path | None = None
) -> str:
    """Return 32 hex digits over all that decides what an FMU contains.

    ``folder`` holds the model's own files, ``shared`` (by default ``source_folder()``) C shell and
    documentation; ``tools``: the versions of the compilers, and whatever else goes in. No clock, no
    path, no chance.
    """
    spec = shown.spec
    own = spec.name, spec.help, spec.box, spec.notes, spec.profile, spec.stop_time, spec.step_size
    content = shown.everything, shown.enumerations, spec.terminals, own
    hashed = hashlib.sha256(repr(content).encode())
    hashed.update(f"{content_digest(spec)} {package_version()} {tools}".encode())
    options = f"{' C' if order.c_sources else ''}{' plain' if order.plain else ''}"
    hashed.update(f"{order.target} {order.fmi}{options}".encode())
    beside = shared or source_folder()
    for root in (*OWN, folder, *(beside / name for name in SHARED)):
        for file in sorted(f for f in root.rglob("*") if f.suffix in TEXTS and f.is_file()):
            hashed.update(file.relative_to(root).as_posix().encode() + file.read_bytes())
    return hashed.hexdigest()[:32]
