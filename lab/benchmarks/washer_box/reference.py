"""Converged torques at random points of the default washer's box, to hold a mesh against.

python -m lab.benchmarks.washer_box.reference OUT.csv [--points 200] [--hard 60] [--screen 10000]
    [--box map | verified] [--seed 1]

Points are uniform in the box. Of ``--screen`` points those where ``field`` and a finer answer (the
map in its box, ``fine`` elsewhere) differ most are taken as hard ones, next to random ones that
nobody has chosen. Where two branches exist both count. Each is solved on three meshes, refined
alike, from a start on the next coarser one, and extrapolated (`reference_washer`): up to 37 x 128
nodes, and up to 73 x 256 where that leaves more than 0.05 % open. Rows are written as they come; a
file that exists is gone on with.
"""

import argparse
import csv
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from thrustwasher import SolveError, WasherParams, solve_washer
from thrustwasher.studio.verification.reference_washer import FINER, GRIDS, _converged

PARAMS = WasherParams()
BOXES = {
    "map": ((20.0, 1850.0), (0.0, 1400.0), (0.001, 0.003), (290.0, 400.0)),
    "verified": ((1.0, 3000.0), (-1500.0, 1500.0), (0.0, 0.004), (260.0, 420.0)),
}
INPUTS = "load", "speed", "tilt", "oil_temperature"
OPEN = 5e-4  # of the torque: what three meshes up to 37 x 128 may leave open
COLUMNS = (
    *("chosen", *INPUTS, "branch", "several", "torque", "uncertainty", "film_ratio", "temperature"),
    *("contact_load", "finest", "torque_10x32", "torque_19x64"),
)


class Place(NamedTuple):
    """A point and the branch to take there; ``several``: there is another one too."""

    load: float
    speed: float
    tilt: float
    oil_temperature: float
    branch: str
    several: bool

    def inputs(self) -> dict[str, float]:
        """Return the point as `solve_washer` takes it."""
        return dict(zip(INPUTS, self, strict=False))


def drawn(box: str, seed: int) -> Iterator[tuple[float, ...]]:
    """Yield points (load, speed, tilt, oil temperature), uniform in the box, without end."""
    rng, (low, high) = np.random.default_rng(seed), zip(*BOXES[box], strict=True)
    while True:
        yield tuple(rng.uniform(low, high).tolist())


def places_at(point: tuple[float, ...]) -> Iterator[tuple[Place, Any]]:
    """Yield the places at a point, one for each branch, with what ``field`` says there."""
    at = dict(zip(INPUTS, point, strict=True))
    found = [solve_washer(PARAMS, **at, branch=b, throw=False) for b in ("film", "contact")]
    sound = [r for r, b in zip(found, ("film", "contact"), strict=True) if r.branch == b]
    for r in sound:
        if not r.status.is_failure:
            yield Place(*point, r.branch, len(sound) == 2), r


def hard_places(box: str, seed: int, n: int, screen: int) -> list[Place]:
    """Return the ``n`` places at which ``field`` differs most from a finer answer."""
    finer, rated, points = "map" if box == "map" else "fine", [], drawn(box, seed)
    for _ in range(screen):
        for place, r in places_at(next(points)):
            other = solve_washer(
                PARAMS, **place.inputs(), branch=place.branch, fidelity=finer, throw=False
            )
            if other.branch == place.branch and not other.status.is_failure:
                off = abs(r.friction_torque / other.friction_torque - 1.0)
                rated.append((off, place))
    rated.sort(reverse=True)
    away = [off for off, _ in rated]
    for limit in (0.1, 0.05, 0.03, 0.01):
        print(f"field differs by more than {limit:g} at {sum(a > limit for a in away)} places")
    return [place for _, place in rated[:n]]


def converged(place: Place, finer: bool) -> dict[str, Any] | None:
    """Return a row of the table; None where a mesh has no solution on the branch."""
    at = place.inputs()
    try:
        base = solve_washer(PARAMS, **at, branch=place.branch)
        known, first = _converged(base, GRIDS)
        finest = GRIDS[-1]
        open_ = known.uncertainty["friction_torque"] / abs(known.values["friction_torque"])
        if finer or not open_ <= OPEN:
            known, finest = _converged(base, FINER)[0], FINER[-1]
            open_ = known.uncertainty["friction_torque"] / abs(known.values["friction_torque"])
    except SolveError as problem:
        print(f"{place}: {problem}", file=sys.stderr)
        return None
    v = known.values
    return {
        **at,
        "branch": place.branch,
        "several": int(place.several),
        "torque": v["friction_torque"],
        "uncertainty": open_,
        "film_ratio": v["film_ratio"],
        "temperature": v["temperature"],
        "contact_load": v["contact_load"],
        "finest": "{} x {}".format(*finest),
        "torque_10x32": base.friction_torque,
        "torque_19x64": first["friction_torque"],
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("--points", type=int, default=200)
    parser.add_argument("--hard", type=int, default=60)
    parser.add_argument("--screen", type=int, default=10_000)
    parser.add_argument("--box", choices=BOXES, default="map")
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    known = set()
    if asked.out.exists():
        with asked.out.open(newline="") as file:
            known = {
                tuple(row[name] for name in (*INPUTS, "branch")) for row in csv.DictReader(file)
            }
    with asked.out.open("a", newline="") as file:
        table = csv.DictWriter(file, COLUMNS)
        if not known:
            table.writeheader()

        def write(chosen: str, place: Place) -> None:
            if (*map(str, place[:4]), place.branch) in known:
                return
            row = converged(place, chosen == "hard")
            if row:
                table.writerow({"chosen": chosen, **row})
                file.flush()

        if asked.hard:
            for place in hard_places(asked.box, asked.seed, asked.hard, asked.screen):
                write("hard", place)
        points = drawn(asked.box, asked.seed + 1000)
        for _ in range(asked.points):
            for place, _ in places_at(next(points)):
                write("random", place)


if __name__ == "__main__":
    main()
