"""The GUID of an FMU: the same content gives the same, any change another."""

import hashlib
import re
from pathlib import Path

from ..models._spec import ModelSpec
from .interface import enumerations, variables
from .registry import content_digest, package_version

TEXTS = (".py", ".c", ".h", ".md")


def model_folder(spec: ModelSpec, sources: Path) -> Path:
    """Return the folder of a model's slave and readme, such as ``thrust_washer``."""
    return sources / re.sub(r"(?<=[a-z])(?=[A-Z])", "_", spec.name).lower()


def identifier(
    spec: ModelSpec, folder: Path, *, shell: Path, target: str, fmi: int, tools: str = ""
) -> str:
    """Return 32 hex digits over all that decides what an FMU contains.

    That is the interface, the kernels, the model's own files in ``folder``, the C sources in
    ``shell``, this package's packing, target, FMI version, package version and ``tools``, the
    versions of the compilers. No clock, no path, no chance.
    """
    hashed = hashlib.sha256(repr((variables(spec), enumerations(spec), spec.terminals)).encode())
    hashed.update(f"{content_digest(spec)} {target} {fmi} {package_version()} {tools}".encode())
    for root in (Path(__file__).parent, Path(__file__).parents[1] / "native", folder, shell):
        for file in _texts(root):
            hashed.update(file.relative_to(root).as_posix().encode() + file.read_bytes())
    return hashed.hexdigest()[:32]


def _texts(root: Path) -> list[Path]:
    found = root.rglob("*") if root.is_dir() else ()
    return sorted(file for file in found if file.suffix in TEXTS and file.is_file())
