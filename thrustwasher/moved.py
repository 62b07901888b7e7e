"""What had another name: modules, and for one version classes, attributes and parameters.

The old names import the same modules. ``docs/migration.md`` says what to write now.
"""

import sys
from collections.abc import Mapping, Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any
from warnings import warn

from .errors import ParameterError

# Below the package: old name -> new name; what lies in a folder goes with it.
MOVED = {
    "calibration": "studio.calibration",
    "clutch.calibration": "studio.calibration.friction",
    "clutch.course": "clutch.profile",
    "explore": "studio.explore",
    "ladder.compare_rungs": "ladder.compare_levels",
    "model.rungs": "model.levels",
    "numerics.courses": "numerics.profiles",
    "optimisation": "studio.optimisation",
    "optimisation.crew": "studio.optimisation.worker_pool",
    "report": "studio.report",
    "report.shift.shift_record": "shift.account.shift_record",
    "report.shift.summary": "shift.account.summary",
    "report.shift.swing_texts": "shift.account.swing_texts",
    "report.shift.what_happened": "shift.account.what_happened",
    "report.shift.worst_moments": "shift.account.worst_moments",
    "rigs": "studio.measured",
    "rigs.rig_comparison": "studio.measured.comparison",
    "rigs.rig_file": "studio.measured.data_set_file",
    "scatter": "studio.scatter",
    "scatter.whole_shift": "shift.whole_shift",
    "shift.scene.course_file": "shift.scene.profile_file",
    "shift.tolerance.rung_check": "shift.tolerance.level_check",
    "study": "studio.verification",
    "sweep": "studio.sweep",
}
PACKAGE = __name__.rpartition(".")[0]


def new_name(name: str) -> str:
    """Return the name that a module has now, "" if it always had this one."""
    parts = name.split(".")
    for n in range(len(parts), 1, -1):
        if parts[0] == PACKAGE and (new := MOVED.get(".".join(parts[1:n]))):
            return ".".join([PACKAGE, new, *parts[n:]])
    return ""


class _Finder(MetaPathFinder, Loader):
    """Finds modules by the names they had: the same modules, not second ones."""

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return what imports a module that was moved."""
        return ModuleSpec(name, self) if new_name(name) else None

    def exec_module(self, module: ModuleType) -> None:
        """Import the module by its new name, and have it by the old one too."""
        sys.modules[module.__name__] = import_module(new_name(module.__name__))


def warn_renamed(old: str, new: str, *, above: int = 2) -> None:
    """Warn the caller's caller that a name is another now."""
    text = f"{old} is now {new}; the next version takes only this"
    warn(text, DeprecationWarning, stacklevel=above + 1)


def now_named(where: str, names: Mapping[str, str], given: Mapping[str, object]) -> dict[str, Any]:
    """Return values with the keys of earlier versions replaced; a warning names each."""
    for old in names.keys() & given.keys():
        if names[old] in given:
            raise ParameterError(f"{old}: former name of {names[old]}, allowed: one of the two")
        text = f"{where}: {old} is now {names[old]}; the next version takes only this"
        warn(text, FutureWarning, stacklevel=4)
    return {names.get(key, key): value for key, value in given.items()}


def renamed(module: str, members: Mapping[str, Any], name: str, names: Mapping[str, str]) -> Any:
    """Return what a module has under another name now; AttributeError if there is nothing."""
    if name not in names:
        raise AttributeError(f"module {module!r} has no attribute {name!r}")
    warn_renamed(f"{module}.{name}", f"{module}.{names[name]}", above=3)
    get = members.get("__getattr__")
    now = names[name]
    return members[now] if now in members or get is None else get(now)


def follow() -> None:
    """Let the old names be imported."""
    sys.meta_path.insert(0, _Finder())
