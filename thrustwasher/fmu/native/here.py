"""Which platform this very machine is, and the fastest code its processor runs."""

from collections.abc import Iterable
from dataclasses import replace

from ...errors import EnvironmentProblem
from ...models._spec import ModelSpec
from ..registry import kernel_module, load_kernel
from .link import local_machine
from .objects import Note, prepare, to_stderr
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
        f"native FMUs are made for {', '.join(PLATFORMS)}, this is {' '.join(local_machine())}"
    )


def this_level(platform: Platform) -> Level:
    """Return the last of the platform's levels that this processor runs."""
    from llvmlite import binding

    has = binding.get_host_cpu_features()
    able = [x for x in platform.levels if all(has.get(f, False) for f in FEATURES.get(x.name, ()))]
    return able[-1]


def compile_models(specs: Iterable[ModelSpec], note: Note = to_stderr) -> None:
    """Compile models for this processor, side by side; ``library`` finds the results."""
    platform = this_platform()
    one = replace(platform, levels=(this_level(platform),))
    # The model with the most memory has the most code; begun last it would run alone at the end.
    largest_first = sorted(specs, key=lambda spec: -load_kernel(spec.kernel).n_work)
    prepare([kernel_module(spec.kernel) for spec in largest_first], [one], note)
