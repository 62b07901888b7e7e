"""Which kernel modules the numbers of each rung come from; cards are tied to these files."""

from __future__ import annotations

from .digests import KERNELS, closure

_CLUTCH = ("clutch_steady", "clutch_advance", "clutch_outputs")
_WASHER_FIELD = ("washer_solve", "washer_outputs", "washer_model")
# model -> rung -> the modules that compute; what they import is found by itself
ROOTS: dict[str, dict[str, tuple[str, ...]]] = {
    "washer": {
        "closed": ("washer_closed",),
        "stribeck": ("washer_stribeck",),
        "map": ("washer_map_step",),
        "coarse": _WASHER_FIELD,
        "field": _WASHER_FIELD,
        "fine": _WASHER_FIELD,
    },
    "clutch": {
        "closed": _CLUTCH,
        "boundary": _CLUTCH,
        "stribeck": _CLUTCH,
        "field": _CLUTCH,
        "fine": _CLUTCH,
    },
    "gearmesh": {
        "closed": ("gear_point",),
        "stribeck": ("gear_point",),
        "field": ("gear_point",),
        "fine": ("gear_line_of_action",),
    },
}
# The file that sends each rung to its kernels and names the meshes; not what it imports, or every
# rung would hang on every other one.
DISPATCH = {"washer": "washer_step.py", "clutch": "clutch_step.py", "gearmesh": "gear_step.py"}


def files_of(model: str, fidelity: str) -> tuple[str, ...]:
    """Return the kernel files of a rung, sorted.

    Raises
    ------
    KeyError : no such rung
    FileNotFoundError : the rung has no kernels in this version
    """
    dispatch = DISPATCH[model]
    if not (KERNELS / dispatch).is_file():
        raise FileNotFoundError(dispatch)
    return tuple(sorted({*closure(*ROOTS[model][fidelity]), dispatch}))
