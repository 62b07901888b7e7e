"""Builds of the shell around the toy written in C, and the C host that runs scripts on them."""

import platform
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from functools import cache
from importlib import metadata
from pathlib import Path

import pytest
from toy.spec import SPEC as TOY

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.package.model_sources import source_folder
from thrustwasher.fmu.shell import c_tables
from thrustwasher.fmu.shell.platform_libraries import library as native_library
from thrustwasher.model.registry import find_spec

HERE = Path(__file__).parent
GUID = "0123456789abcdef0123456789abcdef"
SANITIZED = ("-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
STRICT = ("-Wall", "-Wextra", "-Werror", "-ffp-contract=off")
_folder = tempfile.TemporaryDirectory(prefix="shell")
gcc = shutil.which("gcc")
needs_linux = pytest.mark.skipif(
    sys.platform != "linux" or platform.machine() != "x86_64" or not gcc,
    reason="needs Linux on x86-64 and gcc (Debian package gcc)",
)
needs_gcc = pytest.mark.skipif(not gcc, reason="needs gcc (Debian package gcc)")
LETTERS = {"Real": "real", "Integer": "whole", "Boolean": "boolean", "Enumeration": "enumeration"}


def headers() -> Path:
    return Path(str(metadata.distribution("fmpy").locate_file("fmpy"))) / "c-code"


def _compile(*arguments) -> None:
    done = subprocess.run(["gcc", *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@cache
def toy_library(flags: tuple[str, ...] = ("-O2",)) -> Path:
    """Return the shell linked with the toy's C functions; its part.bin lies next to it."""
    folder = Path(tempfile.mkdtemp(dir=_folder.name))
    for name, text in c_tables.sources(interface(TOY)).items():
        (folder / name).write_text(text)
    (folder / c_tables.PART).write_bytes(c_tables.part_file(interface(TOY), GUID))
    shell = source_folder() / "shell"
    files = [shell / name for name in c_tables.SHELL_FILES]
    library = folder / "toy.so"
    shared = "-std=c99 -shared -fPIC -fvisibility=hidden".split()
    folders = ("-I", folder, "-I", shell, "-I", headers())
    files = [folder / "model.c", *files, HERE.parent / "toy" / "toy.c"]
    _compile(*shared, *STRICT, *flags, *folders, *files, "-o", library, "-lm")
    return library


@cache
def host(fmi: int, flags: tuple[str, ...] = ("-O1",)) -> Path:
    """Return the program that runs scripts."""
    program = Path(tempfile.mkdtemp(dir=_folder.name)) / "host"
    files = [HERE / "host" / name for name in ("script.c", "script_state.c", f"host{fmi}.c")]
    _compile("-std=gnu99", *STRICT, *flags, "-I", headers(), *files, "-o", program, "-ldl")
    return program


@cache
def model_library(model: str) -> Path:
    """Return the library of a model of this package for this machine, part.bin next to it."""
    spec = find_spec(model)
    library = Path(tempfile.mkdtemp(dir=_folder.name)) / f"{spec.name}.so"
    library.write_bytes(native_library(spec, platform="linux64"))
    (library.parent / c_tables.PART).write_bytes(c_tables.part_file(interface(spec), GUID))
    return library


@cache
def threads() -> Path:
    """Return the program that runs many instances at once."""
    program = Path(tempfile.mkdtemp(dir=_folder.name)) / "threads"
    links = "-ldl -lm -lpthread".split()
    folders = ("-I", headers())
    _compile(
        "-std=gnu99", "-O1", *STRICT, *folders, HERE / "host" / "threads.c", "-o", program, *links
    )
    return program


@dataclass
class Reply:
    """What one command answered; the messages are those since the command before."""

    status: int
    values: list[float]
    messages: list[str] = field(default_factory=list)


def run(
    fmi: int, library: Path, script: str, *, flags=("-O1",), wrap=(), resources=None
) -> list[Reply]:
    """Run a script in a fresh process without any environment; the process has to end well.

    The folder of the resources is that of the library unless another is given.
    """
    command = [*map(str, wrap), host(fmi, flags), library, resources or library.parent]
    done = subprocess.run(
        command, input=script, env={}, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-4000:]
    replies, messages = [], []
    for line in done.stdout.splitlines():
        kind, rest = line[0], line[2:]
        if kind == "!":
            messages.append(rest)
            continue
        status, *values = rest.split()
        replies.append(Reply(int(status), [float.fromhex(v) for v in values], messages))
        messages = []
    return replies


def last(fmi: int, script: str) -> Reply:
    """Return what the last command answered, of a script on the toy."""
    return run(fmi, toy_library(), script)[-1]


def ref(name: str) -> int:
    """Return a value reference of the toy."""
    return next(v.reference for v in interface(TOY).variables if v.name == name)


def taking(names, spec=TOY) -> str:
    """Return the commands that read variables by name, one line for each type."""
    found = {v.name: v for v in interface(spec).variables}
    lines = []
    for kind, letter in LETTERS.items():
        references = [str(found[n].reference) for n in names if found[n].type == kind]
        if references:
            lines.append(f"take {letter} {' '.join(references)}\n")
    return "".join(lines)


def putting(spec=TOY, **values) -> str:
    """Return the commands that set variables by name, one line for each type."""
    found = {v.name: v for v in interface(spec).variables}
    lines = []
    for kind, letter in LETTERS.items():
        pairs = [
            f"{found[n].reference} {float(x).hex()}"
            for n, x in values.items()
            if found[n].type == kind
        ]
        if pairs:
            lines.append(f"put {letter} {' '.join(pairs)}\n")
    return "".join(lines)


MADE = f"make toy {GUID} 1\n"
BEGUN = MADE + "setup 0\nenter 0\nleave\n"
