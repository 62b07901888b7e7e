"""Which platform this very machine is, and the fastest code its processor runs."""

from ..errors import EnvironmentProblem
from .link import local_machine
from .targets import PLATFORMS, Level, Platform

# What a processor must have for a level beyond the first one of its platform.
FEATURES = {"v3": ("avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe")}


def this_platform() -> Platform:
    """Return the platform of this machine.

    Raises
    ------
    EnvironmentProblem : native FMUs are not made for it
    """
    for platform in PLATFORMS.values():
        if platform.machine == local_machine():
            return platform
    raise EnvironmentProblem(
        f"native code is made for {', '.join(PLATFORMS)}, this is {' '.join(local_machine())}"
    )


def this_level(platform: Platform) -> Level:
    """Return the last of the platform's levels that this processor runs."""
    from llvmlite import binding

    has = binding.get_host_cpu_features()
    able = [x for x in platform.levels if all(has.get(f, False) for f in FEATURES.get(x.name, ()))]
    return able[-1]
