"""How programs of another platform are run on this machine, for tests: wine and qemu."""

import shutil
from pathlib import Path

from ...errors import EnvironmentProblem
from ...native.link import local_machine
from ...native.targets import Platform

# Debian's wine64 alone puts nothing on PATH.
WINE = ("wine64", "wine", "/usr/lib/wine/wine64")
ARM_LIBRARIES = "/usr/aarch64-linux-gnu"


def command(platform: Platform) -> tuple[str, ...]:
    """Return what comes before a program of a platform to run it here; nothing if it just runs.

    Raises
    ------
    EnvironmentProblem : it cannot be run here; the message names the Debian package if one helps
    """
    if platform.machine == local_machine():
        return ()
    if platform.name == "win64" and local_machine() == ("Linux", "x86_64"):
        return (_found(WINE, "wine64"),)
    if platform.name == "aarch64-linux" and local_machine()[0] == "Linux":
        if not Path(ARM_LIBRARIES).is_dir():
            raise EnvironmentProblem("install the Debian package libc6-arm64-cross")
        return (_found(("qemu-aarch64", "qemu-aarch64-static"), "qemu-user"), "-L", ARM_LIBRARIES)
    raise EnvironmentProblem(f"no emulator known for {platform.name} on this machine")


def old_processor() -> tuple[str, ...]:
    """Return what comes before a program of linux64 to run it as on an x86-64 CPU of 2008.

    Raises
    ------
    EnvironmentProblem : the message names the Debian package
    """
    return _found(("qemu-x86_64", "qemu-x86_64-static"), "qemu-user"), "-cpu", "Nehalem"


def _found(names: tuple[str, ...], package: str) -> str:
    for name in names:
        path = shutil.which(name)
        if path:
            return path
    raise EnvironmentProblem(f"install the Debian package {package}")
