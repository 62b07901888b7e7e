"""The guard of the Python target: a library of our own in front of pythonfmu's.

It is compiled where the FMU is built. Without a C compiler there is none; the FMU then carries
pythonfmu's library alone and says so in documentation/externalDependencies.txt.
"""

from dataclasses import replace
from importlib import metadata

from ..errors import EnvironmentProblem
from ..models._spec import ModelSpec

GUARDED = """Linux, x86-64: any host. A host that is no Python gets the Python that `python3` on
its PATH starts; thrustwasher must be installed for that one. Where it has no shared library
(libpython3.x.so), or another is wanted, the environment variable FMU_LIBPYTHON names the file.
"""
BARE = """Linux, x86-64: this FMU was built without a C compiler and lacks the guard in front of
pythonfmu's library. The importing process must have libpython's symbols loaded, as every Python
has; calls are not checked, and a step that fails returns fmi2Discard.
"""
_LIBRARIES = ("-ldl", "-lpthread")  # of their own until glibc 2.34


def guard_library(spec: ModelSpec, *, guid: str) -> bytes | None:
    """Return the guard of a model for Linux on x86-64; None if there is no compiler for it.

    Parameters
    ----------
    spec
        The model.
    guid
        Compiled in: a description of another build is refused.
    """
    if not compiler():
        return None
    from ..native import link, targets
    from .build import source_folder
    from .native import library, tables

    folder = source_folder() / "shell"
    own = [*folder.glob("guard*.[ch]"), folder / "tables.h"]
    files: dict[str, str | bytes] = {file.name: file.read_bytes() for file in own}
    files |= {**library.headers(2), **tables.sources(spec, fmi=2, guid=guid)}
    platform = replace(targets.PLATFORMS["linux64"], libraries=_LIBRARIES)
    return link.shared_library(files, platform=platform, name=spec.name)


def compiler() -> str:
    """Return name and version of what can build the guard, "" if something is missing."""
    try:
        from ..native.link import find_linker

        found, headers = find_linker(), metadata.version("fmpy")
    except (ImportError, EnvironmentProblem):
        return ""
    known = "linux64" in found.platforms
    return f"{found.name} {found.version}, fmpy {headers}" if known else ""
