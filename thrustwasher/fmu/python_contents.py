"""What only the Python target carries: guard, pythonfmu's library and modules, and the slave."""

from importlib import metadata
from pathlib import Path

from ..models._spec import ModelSpec
from .guard import BARE, GUARDED, guard_library
from .registry import content_digest, package_version

DEPENDENCIES = """This FMU calls Python and the package thrustwasher {version}.
Install both on the machine that runs it: pip install thrustwasher=={version}
The libraries in binaries/ (on Linux: impl.so) and the modules in resources/pythonfmu are of
pythonfmu {pythonfmu}, MIT.
{linux}Windows, x86-64: python3.dll on PATH and the Visual C++ runtime; not tested. There is no
guard: calls are not checked, and a step that fails returns fmi2Discard.
"""


def python_contents(spec: ModelSpec, folder: Path, *, guid: str) -> dict[str, bytes]:
    """Return binaries, resources and the list of what the host must have."""
    module = f"thrustwasher_fmu_{folder.name}_{guid[:8]}"
    template = (folder / "slave.py").read_text("utf-8")
    slave = template.replace("@VERSION@", package_version()).replace("@GUID@", guid)
    slave = slave.replace("@DIGEST@", content_digest(spec))
    guard = guard_library(spec, guid=guid)
    needs = DEPENDENCIES.format(version=package_version(), linux=GUARDED if guard else BARE,
                                pythonfmu=metadata.version("pythonfmu"))  # fmt: skip
    return {
        "documentation/externalDependencies.txt": needs.encode(),
        f"resources/{module}.py": slave.encode(),
        "resources/slavemodule.txt": module.encode(),
        **_binaries(spec.name, guard),
    }


def _binaries(model: str, guard: bytes | None) -> dict[str, bytes]:
    """Return the guard in front of pythonfmu's library, if there is one, and what lies behind."""
    files = _pythonfmu(model)
    if guard:
        name = f"binaries/linux64/{model}.so"
        files["binaries/linux64/impl.so"], files[name] = files[name], guard
    return files


def _pythonfmu(model: str) -> dict[str, bytes]:
    """Return pythonfmu's libraries, renamed to the model, and its modules."""
    # Not by import: a process that has run an FMU imported the FMU's own, smaller pythonfmu.
    root = Path(str(metadata.distribution("pythonfmu").locate_file("pythonfmu")))
    binaries = root / "resources" / "binaries"
    files = {
        f"binaries/linux64/{model}.so": binaries / "linux64" / "libpythonfmu-export.so",
        f"binaries/win64/{model}.dll": binaries / "win64" / "pythonfmu-export.dll",
    }
    for module in sorted(root.iterdir(), key=lambda entry: entry.name):
        if module.name.endswith(".py"):
            files[f"resources/pythonfmu/{module.name}"] = module
    return {name: file.read_bytes() for name, file in files.items()}
