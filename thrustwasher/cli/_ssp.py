"""``thrustwasher shift --ssp FILE``: the shift as a package that any SSP master runs."""

from __future__ import annotations

import argparse
import time
from typing import Any

from ..errors import ParameterError
from . import _output
from .build import chosen_platforms


def export(arguments: argparse.Namespace, scene: Any) -> int:
    """Write the package and name it."""
    if arguments.fmu == "python":
        raise ParameterError("--fmu python: a package holds native FMUs only; leave it out")
    if arguments.master not in (None, "jacobi"):
        raise ParameterError(f"--master {arguments.master}: a package is for a parallel master")
    open_ = [name for name, part in scene.parts.items() if part.tolerance]
    if open_:
        raise ParameterError(
            f"fidelity of {', '.join(open_)} = auto, allowed in a package: a rung by name "
            "(--fidelity PART=RUNG)"
        )
    target = _output.check_file(arguments.ssp, "--ssp", (".ssp",))

    from ..native.link import find_linker

    find_linker()
    platforms = chosen_platforms(arguments.platforms, "native")
    began = time.perf_counter()
    parts = _contents(scene, platforms)

    from ..fmu import archive

    with _output.whole_file(target) as draft:
        draft.write_bytes(archive.pack(parts))
    if arguments.json:
        total = time.perf_counter() - began
        record = {"ssp": str(target), "files": sorted(parts), "total_time": total}
        _output.print_json(record)
    else:
        print(target)
    return 0


def _contents(scene: Any, platforms: list[str] | None) -> dict[str, bytes]:
    """Return all files of the package: the system, its documentation, one FMU per part."""
    from ..drivetrain.ssp.package import files
    from ..drivetrain.ssp.system_structure import plan, prepared, start_values
    from ..fmu.build import pack_native
    from ..fmu.registry import package_version
    from ..fmu.xml_parts import generation_date
    from ._fmu_cache import fmu_instances

    scene = prepared(scene)
    with fmu_instances(scene, "native") as make:
        instances = {name: make(name, part) for name, part in scene.parts.items()}
        system = plan(scene, start_values(scene, instances))
    tool = f"thrustwasher {package_version()}"
    found = files(system, tool=tool, date=generation_date())
    for part in system.components:
        found[part.source] = pack_native(part.spec, platforms=platforms, note=_output.note)
    return found
