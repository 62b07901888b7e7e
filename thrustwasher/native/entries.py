"""Which functions of the kernels can be called from Python, and the library each is in.

A model's library holds the entries of its step ABI for the FMU's shell, with arrays of fixed
length, and the functions below for Python, with the lengths as they are given. What they take
follows from their annotations: numbers, arrays, tuples of these. An array has one dimension unless
it is named here, behind the function, as having two.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, get_args, get_origin, get_type_hints

ITEMS = ("float64", "int32", "int64", "uint8")  # of arrays
PACKAGE = __name__.partition(".")[0]
# module with a model's step, below the package -> functions, each with its arrays of two dimensions
CALLED: dict[str, tuple[str, ...]] = {
    "kernels.washer_step": (
        "kernels.banded._forth",
        "kernels.banded._reverse",
        "kernels.banded.cholesky",
        "kernels.banded.cholesky_solve",
        "kernels.banded.cholesky_solve_many",
        "kernels.banded.lu",
        "kernels.banded.lu_solve",
        "kernels.banded.mirror",
        "kernels.asperities.contact_pressure",
        "kernels.dense.dense_solve",
        "kernels.flow_factors.flow_conductance",
        "kernels.flow_factors.mean_gap",
        "kernels.flow_factors.shear_flow",
        "kernels.lumped_body.exponential_weights",
        "kernels.viscosity.viscosity",
        "kernels.washer_curve.enter_curve",
        "kernels.washer_curve.find_fold",
        "kernels.washer_curve.recall",
        "kernels.washer_curve.remember",
        "kernels.washer_curve.walk_to",
        "kernels.washer_map.map_covers",
        "kernels.washer_map_rows.look_up_rows rows out found",
        "kernels.washer_map_rows.map_folds folds",
        "kernels.washer_map_rows.map_tilts",
        "kernels.washer_map_rows.single_look_up",
        "kernels.washer_map_step.look_up",
        "kernels.washer_map_step.map_sens",
        "kernels.washer_memory.remember_state",
        "kernels.washer_model.derive_grid",
        "kernels.washer_newton.newton",
        "kernels.washer_outputs.outputs_at",
        "kernels.washer_rules.broken_rule",
        "kernels.washer_simple.derive_simple",
        "kernels.washer_step.derive",
        "kernels.washer_step.sens",
        "kernels.washer_step.step",
        "kernels.washer_wedge.lift",
    ),
    "kernels.clutch_step": (
        "kernels.clutch_advance.advance",
        "kernels.clutch_advance.load_memory",
        "kernels.clutch_advance.settle_film",
        "kernels.clutch_constants.derive",
        "kernels.clutch_constants.derive_rings",
        "kernels.clutch_directional_derivative.directional_derivative",
        "kernels.clutch_friction.coefficient_slopes",
        "kernels.clutch_friction.contact_share",
        "kernels.clutch_friction.friction",
        "kernels.clutch_friction.ploughing",
        "kernels.clutch_friction.settled_slope",
        "kernels.clutch_friction.shear_slopes",
        "kernels.clutch_friction.viscous_slopes",
        "kernels.clutch_outputs.fill_outputs",
        "kernels.clutch_outputs.mean_surface",
        "kernels.clutch_outputs.ring_outputs",
        "kernels.clutch_rates.pack_rates",
        "kernels.clutch_constants.broken_rule",
        "kernels.clutch_steady.steady_temperature",
        "kernels.clutch_steady.steady_torques",
        "kernels.clutch_step.step",
    ),
    "kernels.gear_step": (
        "kernels.gear_constants.derive",
        "kernels.gear_constants.effective_roughness",
        "kernels.gear_line_of_action.solve_mesh",
        "kernels.gear_constants.least_teeth",
        "kernels.gear_constants.path_lengths",
        "kernels.gear_constants.slide_roll",
        "kernels.gear_constants.start_of_contact",
        "kernels.gear_heat.surface_temperature",
        "kernels.gear_line_of_action.place_mesh",
        "kernels.gear_point.mesh_point",
        "kernels.gear_constants.broken_rule",
        "kernels.gear_step.sens",
        "kernels.gear_step.step",
    ),
    "kernels.transmission_step": (
        "kernels.transmission_dynamics.derive",
        "kernels.transmission_dynamics.broken_rule",
        "kernels.transmission_directional_derivative.directional_derivative",
        "kernels.transmission_step.step",
    ),
    "kernels.command_step": (
        "kernels.command_step.derive",
        "kernels.command_step.step",
    ),
    "drivetrain.compiled_loop": ("drivetrain.compiled_loop.run_program operations bounds rows",),
}


@dataclass(frozen=True, slots=True)
class Kind:
    """What an argument is to a C function.

    ``name``: "float", "int", "bool" or "array"; an array's ``item`` is the name of its numpy type,
    ``ndim`` its dimensions. ``parts``: of a tuple, whose class is ``made_by`` (None: a plain one).
    """

    name: str
    item: str = ""
    ndim: int = 0
    parts: tuple[Kind, ...] = ()
    made_by: Any = None


@dataclass(frozen=True, slots=True)
class Entry:
    """A function, its symbol in a library, what it takes and returns."""

    symbol: str
    function: Callable[..., Any]
    takes: tuple[Kind, ...]
    returns: tuple[Kind, ...]
    is_tuple: bool  # what it returns is a tuple, also of one


def dotted(name: str) -> str:
    """Return the full name of a module given below the package; any other stays as it is."""
    return f"{PACKAGE}.{name}" if name.startswith(("kernels.", "drivetrain.")) else name


@cache
def library_of(module: str, name: str) -> str | None:
    """Return the module whose library has a function, None where none has it."""
    wanted = f"{module}.{name}"
    for library in CALLED:
        if any(dotted(place) == wanted for place in _places(library)):
            return dotted(library)
    return None


def _places(library: str) -> list[str]:
    return [line.split()[0] for line in CALLED[library]]


@cache
def symbols(library: str) -> tuple[str, ...]:
    """Return the names of a library's functions for Python, sorted: their order in its table.

    ``library`` is the dotted name of a module; one that is not in ``CALLED`` has none.
    """
    own = library.removeprefix(f"{PACKAGE}.")
    places = _places(own) if own in CALLED else []
    return tuple(sorted(symbol_of(*place.rsplit(".", 1)) for place in places))


def called_modules(library: str) -> list[str]:
    """Return the modules whose functions are in a library because Python calls them."""
    own = library.removeprefix(f"{PACKAGE}.")
    places = _places(own) if own in CALLED else []
    return sorted({dotted(place.rpartition(".")[0]) for place in places})


def symbol_of(module: str, name: str) -> str:
    """Return the name a function has in its library."""
    return f"tw_call_{module.rpartition('.')[2]}_{name}"


def entries(library: str) -> list[Entry]:
    """Return the functions of a library that Python calls; imports all their modules."""
    own = library.removeprefix(f"{PACKAGE}.")
    found = []
    for line in CALLED.get(own, ()):
        place, *two = line.split()
        module, _, name = place.rpartition(".")
        found.append(describe(getattr(importlib.import_module(dotted(module)), name), two))
    return found


def arrays_of_two(module: str, name: str) -> list[str]:
    """Return which arguments of a function are arrays of two dimensions."""
    for lines in CALLED.values():
        for line in lines:
            place, *two = line.split()
            if dotted(place) == f"{module}.{name}":
                return two
    return []


def describe(function: Any, two: Sequence[str]) -> Entry:
    """Return what a function takes and returns; ``two``: its arrays of two dimensions."""
    plain = getattr(function, "py_func", function)
    hints = get_type_hints(plain)
    back = hints.pop("return")
    takes = tuple(_kind(hint, 2 if arg in two else 1) for arg, hint in hints.items())
    is_tuple = get_origin(back) is tuple
    given = get_args(back) if is_tuple else (() if back is type(None) else (back,))
    module, name = plain.__module__, plain.__name__
    returns = tuple(_kind(b, 1) for b in given)
    return Entry(symbol_of(module, name), function, takes, returns, is_tuple)


def _kind(hint: Any, ndim: int) -> Kind:
    """Return the kind of an annotation."""
    if hint in (float, int, bool):
        return Kind(hint.__name__)
    if get_origin(hint) is tuple:
        return Kind("tuple", parts=tuple(_kind(part, 1) for part in get_args(hint)))
    if isinstance(hint, type) and issubclass(hint, tuple):
        parts = tuple(_kind(part, 1) for part in get_type_hints(hint).values())
        return Kind("tuple", parts=parts, made_by=hint)
    item = get_args(get_args(hint)[1])[0]  # NDArray[item]
    return Kind("array", item=item.__name__, ndim=ndim)
