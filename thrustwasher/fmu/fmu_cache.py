"""FMUs built when needed, in a folder named by everything they are made of."""

import hashlib
import os
import time
from collections.abc import Iterable
from contextlib import suppress
from functools import lru_cache
from pathlib import Path

from ..native.files import code_folder, keep_sum, kept, stamp, to_stderr

KEPT = 3  # versions
STUDIO = "studio"  # nothing of it goes into an FMU


def fmu_paths(models: Iterable[str], target: str) -> dict[str, Path]:
    """Return the FMU of each model for this machine, building those that are not there yet.

    One that is not as it was built is built again; what happens is said in a line.
    """
    from .build import build
    from .running.loading import prune

    folder = cache_folder(target)
    paths = {model: folder / f"{target}-fmi2" / f"{model}.fmu" for model in models}
    missing = [model for model, path in paths.items() if not _is_whole(path, stamp(path))]
    if missing:
        damaged = [model for model in missing if paths[model].exists()]
        began = time.perf_counter()
        build(missing, target=target, out=folder, local=True)
        for model in missing:
            keep_sum(paths[model], paths[model].read_bytes())
        took = f"{time.perf_counter() - began:.0f} s"
        again = f", {', '.join(damaged)} again: not as it was built in {folder}" if damaged else ""
        to_stderr(f"built {', '.join(missing)} in {took}{again}")
        prune(folder.parent, KEPT)
    with suppress(OSError):
        os.utime(folder)
    return paths


@lru_cache(maxsize=64)
def _is_whole(path: Path, _changed: tuple[int, ...]) -> bool:
    """Tell if an FMU is there as it was built; looked at once per process and change."""
    return kept(path) is not None


def cache_folder(target: str) -> Path:
    """Return the folder of the FMUs of this very source: the user's cache, else a temporary one."""
    return code_folder("built") / source_digest(target)


def source_digest(target: str) -> str:
    """Return 16 hex digits over version, sources, linker and, if native, what was compiled."""
    from ..model.prepare import tables_of
    from ..model.registry import all_specs
    from .model_kernels import package_version
    from .package.model_sources import TEXTS, source_folder
    from .shell.platform_libraries import library_identity

    native, texts = target == "native", (*TEXTS, ".json", ".npz")
    made_for = "python"
    if native:
        made_for = " ".join(library_identity(spec, local=True) for spec in all_specs())
    hashed = hashlib.sha256(f"{package_version()} {made_for}".encode())
    for root in (Path(__file__).parents[1], source_folder()):
        found = ((p.relative_to(root), p) for p in root.rglob("*") if p.suffix in texts)
        for own, path in sorted(found):
            if own.parts[0] != STUDIO:
                hashed.update(own.as_posix().encode() + path.read_bytes())
    for tables in filter(None, map(tables_of, all_specs())):
        for path in tables.paths():
            hashed.update(path.read_bytes())  # every map goes into the washer's FMU
    return hashed.hexdigest()[:16]
