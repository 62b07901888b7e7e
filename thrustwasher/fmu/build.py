"""From a model's list, slave and documents to an FMU file."""

import hashlib
import re
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path

from ..errors import EnvironmentProblem, ParameterError
from ..models._spec import ModelSpec
from . import archive, xml
from .icon import icon
from .interface import all_specs, enumerations, find_spec, variables
from .page import page
from .reference import reference_files
from .registry import content_digest, package_version
from .terminals import terminals_and_icons

TARGETS = ("python", "native")
DEPENDENCIES = """This FMU calls Python and the package thrustwasher {version}.
Install both on the machine that runs it: pip install thrustwasher=={version}
The library in binaries/ and the modules in resources/pythonfmu are of pythonfmu {pythonfmu}, MIT.
Linux, x86-64: the importing process must have libpython's symbols loaded, as every Python has.
Windows, x86-64: python3.dll on PATH and the Visual C++ runtime; not tested.
"""


def build(
    models: Sequence[str] | None = None,
    *,
    target: str = "python",
    fmi: int = 2,
    out: Path = Path("dist"),
    sources: Path | None = None,
) -> list[Path]:
    """Build FMUs and return their paths, ``out/<target>-fmi<N>/<Model>.fmu``.

    Parameters
    ----------
    models
        FMU names such as "ThrustWasher" (or keys such as "washer"); None: all.
    target
        "python": needs this package of the same version where it runs.
    fmi
        2; the Python target knows no other.
    out
        Folder of the results; existing files are replaced at once.
    sources
        Folder with one folder per model (slave.py, readme.md); None: those of this package.
    """
    _check(target, fmi)
    specs = [find_spec(model) for model in models] if models else all_specs()
    paths = []
    for spec in specs:
        path = Path(out) / f"{target}-fmi{fmi}" / f"{spec.name}.fmu"
        archive.write(path, archive.pack(contents(spec, sources=sources or source_folder())))
        paths.append(path)
    return paths


def _check(target: str, fmi: int) -> None:
    if target not in TARGETS:
        raise ParameterError(f"target = {target!r}, allowed: {' or '.join(TARGETS)}")
    if target == "python" and fmi != 2:
        raise ParameterError(f"fmi = {fmi!r}, allowed: 2; this version builds FMI 2.0 only")
    if target == "native":
        raise ParameterError(
            "target = 'native', allowed: python; the native target is not part of this version"
        )


def source_folder() -> Path:
    """Return the folder of the slaves: beside the package in a source tree, else in it."""
    package = Path(__file__).parents[1]
    for folder in (package / "_fmu_src", package.parent / "fmu_src"):
        if folder.is_dir():
            return folder
    raise EnvironmentProblem(
        "the folder fmu_src is missing beside the package; install thrustwasher again"
    )


def contents(spec: ModelSpec, *, sources: Path) -> dict[str, bytes]:
    """Return everything that lies in the FMU of the Python target."""
    folder = sources / re.sub(r"(?<=[a-z])(?=[A-Z])", "_", spec.name).lower()
    template = (folder / "slave.py").read_text("utf-8")
    guid = identifier(spec, template, "python", 2)
    module = f"thrustwasher_fmu_{folder.name}_{guid[:8]}"
    slave = template.replace("@VERSION@", package_version()).replace("@GUID@", guid)
    slave = slave.replace("@DIGEST@", content_digest(spec))
    readme = folder / "readme.md"
    equations = readme.read_text("utf-8") if readme.is_file() else ""
    needs = DEPENDENCIES.format(version=package_version(), pythonfmu=metadata.version("pythonfmu"))
    picture = icon(spec.name)
    return {
        "modelDescription.xml": xml.text(xml.description(spec, guid=guid)),
        "model.png": picture,
        "terminalsAndIcons/icon.png": picture,
        "terminalsAndIcons/terminalsAndIcons.xml": xml.text(terminals_and_icons(spec)),
        "documentation/index.html": page(spec, guid=guid, equations=equations).encode(),
        "documentation/externalDependencies.txt": needs.encode(),
        **_licenses(),
        **reference_files(spec),
        f"resources/{module}.py": slave.encode(),
        "resources/slavemodule.txt": module.encode(),
        **_pythonfmu(spec.name),
    }


def identifier(spec: ModelSpec, template: str, target: str, fmi: int) -> str:
    """Return the GUID: the same content gives the same, any change another."""
    own = sorted(Path(__file__).parent.glob("*.py"))
    hashed = hashlib.sha256(repr((variables(spec), enumerations(spec), spec.terminals)).encode())
    hashed.update(f"{content_digest(spec)} {template} {target} {fmi} {package_version()}".encode())
    for file in own:
        hashed.update(file.read_bytes())
    return hashed.hexdigest()[:32]


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


def _licenses() -> dict[str, bytes]:
    """Return our licence and the notice of pythonfmu, whose files are inside."""
    place = "documentation/licenses"
    own = _distributed("thrustwasher", "LICENSE")
    beside = Path(__file__).parents[2] / "LICENSE"
    if beside.is_file():
        own = beside.read_bytes()
    return {
        f"{place}/license.txt": own,
        f"{place}/pythonfmu.txt": _distributed("pythonfmu", "LICENSE"),
    }


def _distributed(package: str, name: str) -> bytes:
    try:
        listed = metadata.files(package) or []
    except metadata.PackageNotFoundError:
        listed = []
    for file in listed:
        if file.name == name:
            return Path(str(file.locate())).read_bytes()
    return f"See the license of the package {package}.\n".encode()
