"""What works on this machine, and why not: the first thing to read when an FMU does not run."""

import importlib
import os
import platform
import sys
import sysconfig
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from importlib import metadata

from ..errors import ParameterError
from ..model.prepare import tables_of
from ..model.registry import all_specs, kernel_of
from ..native.compiling.portable import MISSING, maker
from ..native.files import VARIABLE, code_folder, private_folder, why_not_kept
from ..native.link import find_linker
from . import packages
from .model_kernels import is_compiled, package_version
from .package.model_sources import source_folder
from .shell import c_sources
from .shell.platform_libraries import is_shipped


@dataclass(frozen=True, slots=True)
class Check:
    """One finding: what was looked at, whether it works, and what to know or do."""

    name: str
    ok: bool
    text: str


def diagnose() -> list[Check]:
    """Look at everything this package uses; nothing is changed and no kernel is compiled."""
    looks: list[tuple[str, Callable[[], str]]] = [
        ("thrustwasher", _version),
        ("Python", lambda: f"{packages.python()} in {sys.executable}, {platform.platform()}"),
        *((asked.name, _package(asked)) for asked in packages.ranges()),
        ("models", lambda: ", ".join(s.name for s in all_specs() if kernel_of(s))),
        ("compiled kernels", _kernels),
        ("kept maps", _kept),
        ("folder of FMUs that run", _running),
        ("temporary folder", lambda: _writable(tempfile.gettempdir())),
        ("FMU sources", lambda: str(source_folder())),
        ("Python FMU", _binary),
        ("native FMUs, compiler", _compiler),
        ("C sources (--sources)", _c_sources),
        ("FMU checker (optional)", _importable("fmu_manipulation_toolbox")),
        *((f"extra {name} (optional)", _extra(name)) for name in packages.OPTIONAL),
    ]
    return [_look(name, look) for name, look in looks]


def _look(name: str, look: Callable[[], str]) -> Check:
    try:
        return Check(name, True, look())
    except Exception as problem:  # a doctor reports; whatever is wrong is a finding
        return Check(name, False, str(problem) or type(problem).__name__)


def _version() -> str:
    version = package_version()
    installed = [found.version for found in metadata.distributions(name="thrustwasher")]
    if installed and version not in installed:
        raise ParameterError(
            f"this code is {version}, but {installed[0]} is installed, which Python FMUs may find; "
            "install this one: pip install ."
        )
    return version


def _importable(name: str) -> Callable[[], str]:
    def look() -> str:
        try:
            importlib.import_module(name)
        except ImportError as problem:
            raise ParameterError(f"{problem}; pip install {name.replace('_', '-')}") from None
        return metadata.version(name.replace("_", "-"))

    return look


def _package(asked: packages.Range) -> Callable[[], str]:
    def look() -> str:
        text = packages.described(asked)
        importlib.import_module(asked.name.lower())
        return text

    return look


def _extra(name: str) -> Callable[[], str]:
    def look() -> str:
        try:
            found = [f"{r.name} {packages.described(r)}" for r in packages.ranges(name)]
        except ParameterError as problem:
            raise ParameterError(f"{problem}: pip install 'thrustwasher[{name}]'") from None
        return ", ".join(found)

    return look


def _kernels() -> str:
    missing = ", ".join(spec.name for spec in all_specs() if not is_compiled(spec))
    if not missing:
        return "all are those of the sources; nothing has to be compiled"
    folder = code_folder()  # says it if it is a temporary one
    return f"the first run compiles {missing}, seconds to a minute, and keeps them in {folder}"


def _c_sources() -> str:
    missing = ", ".join(s.name for s in all_specs() if not c_sources.is_shipped(s.kernel))
    if not missing:
        return "are shipped for all models"
    if not maker():
        raise ParameterError(f"not shipped, or stale: {missing}. {MISSING}")
    return f"shipped; of {missing} wasm2c makes them at each build"


def _kept() -> str:
    return "; ".join(tables.kept() for tables in filter(None, map(tables_of, all_specs())))


def _running() -> str:
    """Try the folder that FMUs are unpacked to, and their libraries loaded from."""
    folder = code_folder("fmus", runs=True)
    if folder.is_relative_to(private_folder()):
        raise ParameterError(
            f"each program unpacks them anew, to {folder}: {why_not_kept()}; let {VARIABLE} name "
            "another folder"
        )
    return str(folder)


def _writable(folder: str) -> str:
    try:
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError as problem:
        raise ParameterError(f"{folder} cannot be written to: {problem.strerror}") from None


def _binary() -> str:
    system, machine = platform.system(), platform.machine().lower()
    if system not in ("Linux", "Windows") or machine not in ("x86_64", "amd64"):
        raise ParameterError(
            f"pythonfmu has no library for {system} on {machine}; use the Python API here"
        )
    if system == "Windows":
        return "pythonfmu's library is inside; not tested on Windows"
    name, folder = (sysconfig.get_config_var(v) or "" for v in ("INSTSONAME", "LIBDIR"))
    library = os.path.join(folder, name)
    others = f"others have to load {library} first (LD_PRELOAD)"
    if not (".so" in name and os.path.exists(library)):
        others = "this Python has no shared library for others"
    return f"runs in FMPy and other Python hosts; {others}"


def _compiler() -> str:
    if all(map(is_shipped, all_specs())):
        return "not needed: the libraries of all FMUs are shipped"
    linker = find_linker()
    text = f"{linker.name} {linker.version}, builds for {', '.join(linker.platforms)}"
    return text if linker.is_cross else f"{text}; for all platforms: pip install ziglang"
