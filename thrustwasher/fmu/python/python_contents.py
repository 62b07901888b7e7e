"""What only the Python target carries: pythonfmu's libraries and modules, and the slave."""

from importlib import metadata
from pathlib import Path

from ...model.spec import ModelSpec
from ..model_kernels import content_digest, package_version

NEEDS = """This FMU calls Python and the package thrustwasher {version}.
Install both on the machine that runs it: pip install thrustwasher=={version}
The libraries in binaries/ and the modules in resources/pythonfmu are of pythonfmu {pythonfmu}, MIT.
Linux, x86-64: the importing process must have libpython's symbols loaded, as every Python has;
another host loads the shared library first, for example LD_PRELOAD=libpython3.x.so.
Windows, x86-64: python3.dll on PATH and the Visual C++ runtime; not tested.
Only a step can fail: it returns fmi2Discard. Calls that set and read values return fmi2OK; that a
value was refused is said to the logger, in solver_status and by the next step.
"""


def python_contents(spec: ModelSpec, folder: Path, *, guid: str) -> dict[str, bytes]:
    """Return binaries, resources and the list of what the host must have."""
    module = f"thrustwasher_fmu_{folder.name}_{guid[:8]}"
    template = (folder / "slave.py").read_text("utf-8")
    slave = template.replace("@VERSION@", package_version()).replace("@GUID@", guid)
    slave = slave.replace("@DIGEST@", content_digest(spec))
    needs = NEEDS.format(version=package_version(), pythonfmu=metadata.version("pythonfmu"))
    return {
        "documentation/externalDependencies.txt": needs.encode(),
        f"resources/{module}.py": slave.encode(),
        "resources/slavemodule.txt": module.encode(),
        **_pythonfmu(spec.name),
    }


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
