"""Map files: a zip archive with the map's numbers (single precision) and its metadata (JSON).

Shipped maps lie in ``thrustwasher/data/maps``; further folders are taken from the environment
variable ``THRUSTWASHER_MAPS`` (separated as in ``PATH``) and are looked through first, then those
of the user's own washers in the user's cache, which belong to the kernels as they are.
"""

import json
import os
import time
import zipfile
import zlib
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import ParameterError
from ...native.files import DAMAGED, user_cache, zipped
from ...numerics.chebyshev import MOST_TERMS, lines_of
from ...numerics.jit import Array, kernel_digest
from ...storage.digests import DATA
from ..kernels.layout import N_STEADY
from ..kernels.map import map_layout as L
from .map_plan import pieces_at

SHIPPED = DATA / "maps"
SUFFIX = ".twm"
NUMBERS, METADATA = "map.f32", "card.json"
VARIABLE = "THRUSTWASHER_MAPS"
OWN = "maps"  # folder in the user's cache
MOST_KEPT = 50  # your own maps, about half a megabyte each
LARGEST = 64e6  # bytes of numbers; more is no map of ours


@dataclass(frozen=True, slots=True)
class MapFile:
    """A map as read: ``data`` as the kernels take it (read only), ``metadata`` as a dictionary."""

    path: Path
    data: Array
    metadata: dict[str, Any]

    def made_for(self, numbers: Sequence[float]) -> bool:
        """Tell if the map was made for these parameters, in the order of the dataclass."""
        return _made_for(self.data, numbers)


def _made_for(data: Array, numbers: Sequence[float]) -> bool:
    steady = tuple(float(x) for x in numbers[:N_STEADY])
    return tuple(data[L.PARAMS :][: len(steady)].tolist()) == steady


def _is_for(path: Path, numbers: Sequence[float]) -> bool:
    """Tell if a file is a map for these parameters, by its header alone."""
    try:
        with zipfile.ZipFile(path) as archive, archive.open(NUMBERS) as body:
            return _made_for(np.frombuffer(body.read(8 * L.DATA), "<f8"), numbers)
    except (OSError, *DAMAGED):
        return False


def pack(data: Array, metadata: dict[str, Any]) -> bytes:
    """Return the bytes of a map file; the same for the same contents."""
    return zipped({METADATA: json.dumps(metadata, indent=1).encode(), NUMBERS: _bytes(data)})


def plain(file: MapFile) -> bytes:
    """Return a map as the resource of an FMU: header in doubles, single precision, CRC-32."""
    numbers = _bytes(file.data)
    return numbers + zlib.crc32(numbers).to_bytes(4, "little")


def _bytes(data: Array) -> bytes:
    return bytes(data[: L.DATA].astype("<f8").tobytes() + data[L.DATA :].astype("<f4").tobytes())


def unpack(numbers: bytes) -> Array:
    """Return the map in the numbers of a file; ValueError if they are none of this version."""
    head = np.frombuffer(numbers[: 8 * L.DATA], "<f8")
    if len(head) != L.DATA or head[L.KIND] != L.MAGIC:
        raise ValueError("no map of this version")
    body = np.frombuffer(numbers[8 * L.DATA :], "<f4") if len(numbers) % 4 == 0 else head[:0]
    if head[L.SIZE] != L.DATA + len(body) or not expected_size(head) == head[L.SIZE]:
        raise ValueError("the map is cut off")
    data = np.concatenate([head, body])
    if not (np.all(np.isfinite(head)) and np.all(np.isfinite(body))):
        raise ValueError("numbers in the map are not finite")
    data.flags.writeable = False
    return data


def identity_of(data: Array) -> float:
    """Return a checksum of a map's numbers and box, never 0."""
    head = data[: L.IDENTITY].astype("<f8").tobytes()
    return 1.0 + zlib.crc32(head + data[L.DATA :].astype("<f4").tobytes())


def expected_size(head: Array) -> float:
    """Return how many numbers a map with this header has; nan if the header is none."""
    patches, terms = head[L.AXES + 2 : L.AXES + 9 : 3], head[L.TERMS : L.PIECE_AT]
    if not (np.all(patches == np.floor(patches)) and np.all((patches >= 0) & (patches < 200))):
        return float("nan")
    if not (np.all(terms == np.floor(terms)) and np.all((terms >= 2) & (terms <= MOST_TERMS))):
        return float("nan")
    lines = lines_of(*(int(n) for n in patches))
    at = pieces_at(*terms.reshape(2, L.N_PIECES).tolist())
    if not np.all(at == head[L.PIECE_AT : L.IDENTITY]):
        return float("nan")
    return float(L.DATA + lines * at[-1])


@lru_cache(maxsize=16)
def _read(path: str, _stamp: tuple[int, ...]) -> MapFile:
    try:
        with zipfile.ZipFile(path) as archive:
            if archive.getinfo(NUMBERS).file_size > LARGEST:
                raise ValueError("the map is larger than any map is")
            data, metadata = unpack(archive.read(NUMBERS)), json.loads(archive.read(METADATA))
        if not isinstance(metadata, dict):
            raise ValueError("its metadata is no JSON object")
    except (OSError, *DAMAGED) as problem:
        raise ParameterError(
            f"map = {path!r}: {problem}; allowed: a file written by `thrustwasher map build`"
        ) from None
    return MapFile(Path(path), data, metadata)


def read_map(path: str | os.PathLike[str]) -> MapFile:
    """Return a map file, read once per content; ParameterError if it is none of this version."""
    file = Path(path)
    if not file.is_file():
        raise ParameterError(f"map = {str(file)!r}, allowed: an existing file")
    return _read(str(file.resolve()), stamp_of(file))


def stamp_of(path: str | Path) -> tuple[int, ...]:
    """Return what changes when a file or folder is written to; empty if it is gone."""
    try:
        status = os.stat(path)
    except OSError:
        return ()
    return status.st_mtime_ns, status.st_size, status.st_ino


def own_folder() -> Path:
    """Return where maps of the user's own washers lie; it need not exist."""
    return user_cache() / OWN / kernel_digest()


def map_folders() -> list[Path]:
    """Return the folders that are looked through, the shipped one last."""
    named = filter(None, os.environ.get(VARIABLE, "").split(os.pathsep))
    return [*map(Path, named), own_folder(), SHIPPED]


def _looked_through() -> tuple[str, ...]:
    """Return the folders that may have a map: the name of the own one takes 45 ms."""
    cache = user_cache()
    return _folders(os.environ.get(VARIABLE, ""), cache, (cache / OWN).exists())


@lru_cache(maxsize=16)
def _folders(named: str, _cache: Path, has_own: bool) -> tuple[str, ...]:
    own = [str(own_folder())] if has_own else []
    return *filter(None, named.split(os.pathsep)), *own, str(SHIPPED)


def state_of_maps() -> tuple[object, ...]:
    """Return what changes as soon as other folders are looked through or a map comes or goes."""
    folders = _looked_through()
    return folders, *map(stamp_of, folders)


def map_paths(shipped: bool = False) -> list[Path]:
    """Return all files that have the name of a map; ``shipped``: those of the package alone."""
    folders = [str(SHIPPED)] if shipped else _looked_through()
    return [path for folder in folders for path in sorted(Path(folder).glob(f"*{SUFFIX}"))]


def all_maps(shipped: bool = False) -> list[MapFile]:
    """Return every readable map, as ``map_paths``; files that are none are passed over."""
    found = []
    for path in map_paths(shipped):
        try:
            found.append(read_map(path))
        except ParameterError:
            continue  # `thrustwasher doctor` names it
    return found


def find_map(numbers: Sequence[float]) -> MapFile | None:
    """Return the first map made for these parameters (numbers in the dataclass's order)."""
    found = None
    for path in map_paths():
        if found is None and _is_for(path, numbers):
            with suppress(ParameterError):  # damaged: `thrustwasher doctor` names it
                found = read_map(path)
    if found and found.path.is_relative_to(user_cache() / OWN):
        with suppress(OSError):  # it was of use just now
            os.utime(found.path, ns=(time.time_ns(), found.path.stat().st_mtime_ns))
    return found


def forget_unused() -> None:
    """Remove the maps in the user's cache, of any kernels, that were not used longest."""
    files = sorted(own_folder().parent.rglob(f"*{SUFFIX}"), key=lambda p: -p.stat().st_atime_ns)
    for file in files[MOST_KEPT:]:
        file.unlink(missing_ok=True)
