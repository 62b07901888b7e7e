"""Fit constants that a paper leaves open to its folds: how sure, at what cost elsewhere.

python examples/ex14_jackson_green.py field    # the table of docs/papers/jackson-green-2006.md
"""

import csv
import sys
from pathlib import Path

from thrustwasher import WasherParams, calibrate, solve_washer

TABLE = Path(__file__).with_suffix(".csv")
PAPER, RUNS = WasherParams.preset("paper"), WasherParams()
WARM = WasherParams.preset("paper", film_heat_fraction=0.5)  # where the fit starts
FITS = (
    ("its equations", WARM, ("film_heat_fraction",)),
    ("its equations", WARM, ("film_heat_fraction", "asperity_density")),
    ("its equations", PAPER, ("asperity_density",)),
    ("its equations", PAPER, ("asperity_radius",)),
    ("its equations", PAPER, ("heat_split",)),
    ("as it runs", RUNS, ("carrier_thickness",)),
    ("as it runs", RUNS, ("oil_density",)),
    ("as it runs", RUNS, ("oil_density", "carrier_thickness")),
    ("as it runs", RUNS, ("heat_split",)),
)


def read() -> dict[str, list[float]]:
    lines = [line for line in TABLE.read_text("utf-8").splitlines() if not line.startswith("#")]
    head, *rows = csv.reader(lines, skipinitialspace=True)
    names = [cell.partition(" [")[0] for cell in head]
    columns = {name: [float(row[i]) for row in rows] for i, name in enumerate(names)}
    columns["oil_temperature"] = [t + 273.15 for t in columns["oil_temperature"]]  # degC
    return columns


def elsewhere(params: WasherParams) -> str:
    """Return the film's share of 1361 N at 136 rad/s (paper: 2 %), torque, rise of a full film."""
    mixed = solve_washer(params, load=1361.0, speed=136.0, tilt=0.002)
    film = solve_washer(params, load=300.0, speed=953.0, tilt=0.002)
    share, rise = 100.0 * mixed.fluid_load / 1361.0, film.temperature - 297.15
    return f"{share:.0f} % | {film.friction_torque:.3f} N m, +{rise:.1f} K"


def main(fidelity: str = "field", most: int = 2) -> float:
    data, values = read(), []
    for name, start, fit in FITS[:most]:
        found = calibrate(start, data, fit=fit, fidelity=fidelity)
        words = [
            f"{e.name} {e.value:.3g}"
            + (
                f" ({e.interval[0]:.2g} .. {e.interval[1]:.2g})"
                if e.identifiable
                else " (not told)"
            )
            for e in found.estimates
        ]
        loads = ", ".join(f"{load:.0f}" for load in found.fitted)
        chi = float(((found.residuals / 35.0) ** 2).sum())
        print(
            f"| {name} | {', '.join(words)} | {loads} N | {chi:.3g} | {elsewhere(found.params)} |",
            flush=True,
        )
        values.append(found.estimates[0].value)
    return values[0]


if __name__ == "__main__":
    main(*sys.argv[1:2], most=len(FITS)) if sys.argv[1:] else main()
