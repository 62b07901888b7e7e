"""FMUs built when needed, in a folder named by everything they are made of."""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Iterable
from pathlib import Path


def fmu_paths(models: Iterable[str]) -> dict[str, Path]:
    """Return the FMU of each model, building those that are not there yet."""
    from ..fmu.build import build

    folder = cache_folder()
    paths: dict[str, Path] = {}
    for model in dict.fromkeys(models):
        known = folder / "python-fmi2" / f"{model}.fmu"
        paths[model] = known if known.is_file() else build([model], target="python", out=folder)[0]
    return paths


def cache_folder() -> Path:
    """Return the folder of the FMUs of this very source: the user's cache, else a temporary one."""
    base = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    folder = Path(base) / "thrustwasher" / "built" / source_digest()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:
        return Path(tempfile.gettempdir()) / f"thrustwasher-built-{source_digest()}"


def source_digest() -> str:
    """Return 16 hex digits over version and sources of the package and the FMUs' own files."""
    from ..fmu.build import source_folder
    from ..fmu.registry import package_version

    package = Path(__file__).parents[1]
    files = {p for p in package.rglob("*") if p.suffix in (".py", ".json", ".npz")}
    files |= {p for p in source_folder().rglob("*") if p.suffix in (".py", ".md")}
    hashed = hashlib.sha256(package_version().encode())
    for path in sorted(files):
        hashed.update(path.name.encode() + path.read_bytes())
    return hashed.hexdigest()[:16]
