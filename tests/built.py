"""FMUs that tests share: each is built once, by the process that needs it first."""

import hashlib
import os
import shutil
import subprocess
import zipfile
from importlib import metadata
from pathlib import Path

import needed
import pytest
from filelock import FileLock

from thrustwasher.errors import EnvironmentProblem
from thrustwasher.fmu.build import build
from thrustwasher.fmu.fmu_cache import fmu_paths, source_digest
from thrustwasher.fmu.running.loading import prune
from thrustwasher.fmu.shell.platform_libraries import tools
from thrustwasher.model.prepare import tables_of
from thrustwasher.model.registry import all_specs, find_spec
from thrustwasher.native import link
from thrustwasher.native.link import find_linker
from thrustwasher.washer.map.map_file import VARIABLE

HOME = Path(__file__).parents[1] / ".cache" / "test-fmus"
_made = {}
AS_COMMANDS_DO = {"local": True}  # these lie where the commands look for them
HEADERS = Path(str(metadata.distribution("fmpy").locate_file("fmpy"))) / "c-code"
STRICT = "-std=c99 -Wall -Wextra -pedantic -Werror".split()


def built_fmu(model, *, target="native", fmi=2, sources=None, **options):
    """Return the path of an FMU; the arguments are those of ``build``.

    The folder is named by all that the FMU is made of; a lock lets other processes wait for it.
    All that is read for the name, a process reads once: sources stay as they are while tests run.
    """
    given = (model, target, fmi, sources, repr(options), *_surroundings())
    if given not in _made or not _made[given].is_file():
        _made[given] = _built_fmu(model, target, fmi, sources, options)
    return _made[given]


def _surroundings():
    """Return what tests change of that which an FMU is made of: folders, maps, linkers."""
    maps = [t.paths() for t in map(tables_of, all_specs()) if t]
    variables = (VARIABLE, "XDG_CACHE_HOME", "SOURCE_DATE_EPOCH")
    return *map(os.environ.get, variables), repr(maps), needed.linkable()


def _built_fmu(model, target, fmi, sources, options):
    name = find_spec(model).name
    home = HOME / _digest(target, sources, options)
    path = home / f"{target}-fmi{fmi}" / f"{name}.fmu"
    home.mkdir(parents=True, exist_ok=True)
    with FileLock(home / f"{target}-fmi{fmi}-{name}.lock"):
        if fmi == 2 and sources is None and options == AS_COMMANDS_DO:
            return fmu_paths([name], target)[name]
        if not path.is_file():
            try:
                build([model], target=target, fmi=fmi, out=home, sources=sources, **options)
            except EnvironmentProblem as problem:
                needed.missing(str(problem))
            prune(HOME, 3)
    os.utime(home)  # the time of the last use
    return path


def tool(name):
    """Return the path of a program, or skip and say which Debian package is missing."""
    return shutil.which(name) or pytest.skip(f"{name} is missing: the Debian package {name}")


def with_sources(name, fmi=2):
    return built_fmu(name, fmi=fmi, local=True, c_sources=True)


def compiled_fmu(name, fmi, compiler, *options):
    """Return an FMU whose library is compiled from its folder sources; "unpacked" lies beside it.

    A model takes up to a minute: it is compiled once for all tests.
    """
    fmu, program = with_sources(name, fmi), tool(compiler)
    version = subprocess.run([program, "--version"], capture_output=True, check=True).stdout
    key = hashlib.sha256(version + repr((name, options)).encode()).hexdigest()[:16]
    home = fmu.parent / f"{compiler}-{key}"
    own, made = home / "unpacked", home / fmu.name
    with FileLock(f"{home}.lock"):
        if not made.is_file():
            shutil.rmtree(home, ignore_errors=True)
            with zipfile.ZipFile(fmu) as zipped:
                zipped.extractall(own)
            (library,) = (own / "binaries").rglob("*.so")
            flags = ["-shared", "-fPIC", "-DFMI3_OVERRIDE_FUNCTION_PREFIX", f"-I{HEADERS}"]
            files = sorted((own / "sources").glob("*.c"))
            line = [program, "-O2", *STRICT, *options, *flags, "-o", library, *files, "-lm"]
            done = subprocess.run(list(map(str, line)), capture_output=True, text=True)
            assert (done.returncode, done.stderr) == (0, "")
            packed(own, made)
    return made


def packed(folder, fmu):
    """Write all files of a folder into an FMU."""
    with zipfile.ZipFile(fmu, "w") as zipped:
        for file in sorted(f for f in folder.rglob("*") if f.is_file()):
            zipped.write(file, file.relative_to(folder))
    return fmu


def _digest(target, sources, options):
    """Return 16 hex digits over sources, compilers and the way it is built."""
    can = target == "native" and needed.linkable()
    compilers = tools(find_linker()) if can else ""
    hashed = hashlib.sha256(f"{source_digest(target)} {compilers} {options}".encode())
    if sources:
        for path in sorted(p for p in sources.parent.rglob("*") if p.suffix in (".py", ".md")):
            hashed.update(path.relative_to(sources.parent).as_posix().encode() + path.read_bytes())
    return hashed.hexdigest()[:16]


def look_for_linkers_again():
    for found in (link.find_linker, link.local_linker, link._of_this_machine):
        found.cache_clear()
