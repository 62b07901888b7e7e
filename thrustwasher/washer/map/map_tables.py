"""The maps of washers as the rest of the package knows them: found, built, kept."""

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from ...model.spec import Tables
from ...storage.digests import params_digest
from ..parameters import WasherParams
from . import map_file
from .look_up import WasherMap, map_for
from .map_build import make_map
from .map_plan import TOLERANCES, coverable, first_of, lines_about


def build_own(
    params: WasherParams,
    box: Mapping[str, tuple[float, float]],
    tolerance: float,
    workers: int,
    progress: object,
) -> None:
    """Build the map of a washer of your own and keep it in the user's cache; as ``make_map``.

    The box is cut at what a map can cover.
    """
    make = partial(make_map, params, box=coverable(box), tolerance=tolerance)
    keep_own(params, partial(make, workers=workers, progress=progress))


def keep_own(params: WasherParams, make: Callable[[Path], Any]) -> None:
    """Keep the map that ``make`` writes to a path where all find it: in the user's cache."""
    path = map_file.own_folder() / f"washer-{params_digest(params)[:16]}{map_file.SUFFIX}"
    path.parent.mkdir(parents=True, exist_ok=True)
    make(path)
    map_file.forget_unused()


def kept_maps() -> str:
    """Return in words how many maps of washers of your own are kept."""
    own, most = map_file.own_folder(), map_file.MOST_KEPT
    kept = [path for path in map_file.map_paths() if path.is_relative_to(own)]
    return f"{len(kept)} maps of washers of your own, of at most {most}, in {own}"


TABLES = Tables(
    level="map",
    paths=map_file.map_paths,
    readable=map_file.all_maps,
    find=map_for,
    box=lambda params: WasherMap(params).box,
    resource=map_file.plain,
    build=build_own,
    lines=lambda params, box, tolerance: lines_about(params, coverable(box), tolerance),
    least=first_of,
    tolerances=TOLERANCES,
    kept=kept_maps,
)
