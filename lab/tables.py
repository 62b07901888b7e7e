"""Make the tables and figures that the pages tell, between ``<!-- table: NAME -->`` and ``end``.

    python -m lab.tables [NAME ...]        write them into the pages; default: all
    python -m lab.tables --check [NAME ...]

``tests/lab/test_docs.py`` makes them anew and compares; that of jumps, with its scans, a test of
the mesh.
"""

import argparse
import math
import re
import textwrap
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from lab.charts.chart_page import same_everywhere
from lab.mesh_jumps import CAUSES, NO_ROOT, Found, scan_all
from thrustwasher import ClutchParams, cli, release_clutch, solve_losses
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.gearmesh import law_ranges as mesh_ranges
from thrustwasher.losses import loss_ranges
from thrustwasher.losses.kernels.loss_laws import starved, thinned
from thrustwasher.losses.parameters import LossesParams
from thrustwasher.model.registry import all_specs
from thrustwasher.shift import cosimulate, load_scene, run_sequence
from thrustwasher.shift.scene.places import scene_scatter
from thrustwasher.shift.scene.scene_file import known_bands
from thrustwasher.shift.steady_points import _gearbox as steady_gearbox
from thrustwasher.shift.steady_points import efficiency_map

HERE = Path(__file__).parents[1] / "docs"
PAGES = [HERE.parent / "README.md", *sorted(HERE.rglob("*.md"))]
BLOCK = re.compile(r"(?s)(<!-- table: ([\w-]+) -->\n)(.*?)(<!-- end -->)")
MADE: dict[str, Callable[[], str]] = {}
CELSIUS = 273.15


def made(name: str) -> Callable[[Callable[[], str]], Callable[[], str]]:
    """Keep a function under the name of the block that it makes."""

    def keep(make: Callable[[], str]) -> Callable[[], str]:
        MADE[name] = make
        return make

    return keep


def table(head: list[str], rows: list[list[str]]) -> str:
    """Return a table of Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def churned(speed: float, celsius: float) -> float:
    """Return the torque [N m] of the default output gear."""
    bare = LossesParams(output_bearing_count=0, output_seal_diameter=0.0)  # type: ignore[call-arg]
    oil = celsius + CELSIUS
    return solve_losses(
        bare, input_speed=0.0, output_speed=speed, oil_temperature=oil
    ).output_torque


@made("release")
def _release() -> str:
    points = ((80, 100.0), (0, 100.0), (-20, 100.0), (-20, 300.0))
    rows = [["drag 0.1 s after, N m"], ["heat in the first 0.1 s, J"], ["half open after, s"]]
    for celsius, speed in points:
        at = {"load": 5898.0, "speed": speed, "oil_temperature": celsius + CELSIUS}
        later = release_clutch(ClutchParams(), **at, after=0.1)
        values = (later.friction_torque, later.energy, later.open_after)
        for row, value in zip(rows, values, strict=True):
            row.append(f"{value:.3g}" if value < 1e3 else f"{value:.0f}")
    head = [f"{t} degC, {w:g} rad/s" for t, w in points]
    return table(["default pack, 5898 N gone within 1 ms", *head], rows)


APART = (  # computed apart: rad/s, degC, N m
    ((30, 100), 0.085),
    ((100, 80), 0.223),
    ((150, -20), 0.948),
)


@made("losses-apart")
def _losses_apart() -> str:
    churning = "; ".join(
        f"{x:.3f} and {churned(w, t):.4f} N m at {w} rad/s, {t} degC" for (w, t), x in APART
    )
    w, nu, diameter = 3450.0 * math.pi / 30.0, 1170e-6, 0.05
    heated, starvation = thinned(w, nu, diameter, 0.0)[0], []
    for kind, section in ((3.1, 0.45), (5.1, 0.35)):
        own = thinned(w, nu, diameter, starved(3e-8, kind, diameter, section))[0]
        starvation.append(f"{own / heated:.3f}")
    return (
        f"- churning of the default output gear: {churning};\n"
        f"- inlet shear heating (1170 mm2/s, 3450 rpm, 50 mm): 0.54 and {heated:.3f};\n"
        "- starvation (the same, K_rs 3e-8, K_Z 3.1 and 5.1): 0.09 .. 0.01 and "
        f"{', '.join(starvation)}.\n"
    )


@made("losses")
def _losses() -> str:
    rpm = math.pi / 30.0
    shared = {"tooth_force": 2000.0, "oil_temperature": 80.0 + CELSIUS, "input_speed": 2000 * rpm}
    direct = {"output_speed": 2000 * rpm, "drum_speed": 2000 * rpm}
    first = {"output_speed": 800 * rpm, "planet_speed": -2000 * rpm}
    rows = []
    for words, point in (
        ("all shafts at 2000 rpm, planets still (`--planet-speed 0`)", direct),
        ("output at 800 rpm, drum held, planets at -2000 rpm", first),
    ):
        r = solve_losses(LossesParams(), **shared, **point)
        powers = (r.pump_power, r.churning_power, r.bearing_power, r.seal_power)
        parts = [f"{x:.0f}, {100.0 * x / r.oil_heat:.0f} %" for x in powers]
        rows.append([words, *parts, f"{r.oil_heat:.0f}"])
    return table(["", "pump", "churning", "bearings", "seals", "sum"], rows)


@made("mesh-ranges")
def _mesh_ranges() -> str:
    return _law_ranges(mesh_ranges.LAW_RANGES)


@made("loss-ranges")
def _loss_ranges() -> str:
    return _law_ranges(loss_ranges.LAW_RANGES)


def _law_ranges(ranges) -> str:
    rows: dict[tuple[str, str, str], list[str]] = {}
    for r in ranges:
        source = re.split("; the t|, as usually|, from memory", r.source)[0]
        same = rows.setdefault((r.law, r.beyond, source), [])
        same.append(f"{r.quantity} {r.words()}")
    lines = [
        f"- {law}: {'; '.join(x)}. Outside: {beyond} ({source})."
        for (law, beyond, source), x in rows.items()
    ]
    return "".join(f"{textwrap.fill(line, 150, subsequent_indent='  ')}\n" for line in lines)


@made("mesh-jumps")
def _mesh_jumps() -> str:
    return jumps_table((pair, jumps) for pair, _, _, jumps in scan_all())


def jumps_table(scans: Iterable[tuple[str, list[Found]]]) -> str:
    """Return what jumps: a line for each cause, and how many pairs have no jump."""
    pairs: dict[str, dict[str, list[Found]]] = {cause: {} for cause in CAUSES}
    smooth = 0
    for pair, jumps in scans:
        for one in jumps:
            pairs[one.cause].setdefault(pair, []).append(one)
        smooth += not jumps
    lines = []
    for cause, of_pairs in pairs.items():
        found = [one for jumps in of_pairs.values() for one in jumps]
        over = list(dict.fromkeys(one.quantity for one in found))
        where = f"{len(over)} parameters and inputs" if len(over) > 5 else ", ".join(over)
        size = "-1" if cause == NO_ROOT else f"{max(j.jump.size for j in found):.1g}, relative"
        names = "; ".join(of_pairs)
        lines.append(f"- {cause} (pairs {names}; over {where}; to {size}): {CAUSES[cause]}\n")
    return "".join(lines) + f"\nThe other {smooth} pairs have no jump.\n"


@made("corrections")
def _corrections() -> str:
    parts: dict[str, list[str]] = {}
    for row in same_everywhere()["corrections"]:
        mark = "*" if row["recorded"] else ""
        unit = "" if row["unit"] == "1" else f" {row['unit']}"
        words = f"{row['figure']} {row['before']:.3g}{mark} -> {row['after']:.3g}{unit}"
        parts.setdefault(row["part"], []).append(words)
    return "".join(f"- {part}: {'; '.join(found)}\n" for part, found in parts.items())


SOURCES = {
    "pump": "pump_loss",
    "teeth": "mesh_loss",
    "open pack": "pack_loss",
    "churning": "churning_loss",
    "bearings": "rolling_loss",
    "seals": "seal_loss",
    "thrust bearings": "thrust_bearing_loss",
    "washers": "washer_loss",
}


def steady(torque: float, rpm: float) -> dict[str, float]:
    """Return the row of a steady point in first gear, torque in N m."""
    speeds = [rpm * math.pi / 30.0]
    found = efficiency_map(load_scene("planetary"), [torque], speeds, gear="first")
    return {name: float(values[0]) for name, values in found.columns.items()}


@made("efficiency")
def _efficiency() -> str:
    rows = []
    for torque, rpm in ((100.0, 1000.0), (100.0, 2000.0), (250.0, 2000.0), (250.0, 4000.0)):
        row = steady(torque, rpm)
        parts = [f"{row[name]:.0f}" for name in SOURCES.values()]
        rows.append(
            [f"{torque:.0f} N m, {rpm:.0f} rpm", f"{100.0 * row['efficiency']:.2f} %", *parts]
        )
    return table(["input", "efficiency", *SOURCES], rows)


def first_gear(**changes: float) -> dict[str, float]:
    """Return what the default scene's gearbox tells in steady first gear at 247 N m."""
    part = load_scene("planetary").parts["transmission"]
    params = replace(steady_gearbox(part, "first", 364.0).params, **changes)
    box = DirectInstance(part.spec, parameters=replace(part, params=params).parameters())
    given = {"engine_torque_input": 247.0, "load_torque_input": 247.0 * (1.0 + params.ratio)}
    given["brake_torque"] = 1e5  # it holds
    box.initialize(0.0, given)
    return dict(zip(box.output_names, box.outputs(), strict=True))


@made("needles")
def _needles() -> str:
    rng = np.random.default_rng(1)
    shared = first_gear()
    told = []
    for low, high in ((100.0, 500.0), (10.0, 60.0)):
        found = [
            first_gear(needle_count=18, needle_clearance=1e-6 * c, end_play=1e-6 * e)
            for c, e in zip(rng.uniform(5, 30, 100), rng.uniform(low, high, 100), strict=True)
        ]
        loads, tilts = (np.array([f[n] for f in found]) for n in ("washer_load", "washer_tilt"))
        told.append((loads, 1e3 * np.quantile(tilts, [0.05, 0.95])))
    (usual, tilt), (tight, _) = told
    share = load_scene("planetary").parts["transmission"].params.thrust_share
    return (
        "First gear of the default scene, 18 needles of 20 mm, radial clearance 5 to 30 um, 100 "
        f"draws: end plays of 0.1 to 0.5 mm tilt the planet by {tilt[0]:.1f} to {tilt[1]:.1f} mrad "
        f"(5 and 95 %), {np.sum(usual > 1.0)} reach the washers; of 10 to 60 um "
        f"{np.sum(tight > 1.0)} do, with up to {tight.max():.0f} N. `thrust_share` of {share:.0%} "
        f"gives {shared['washer_load']:.1f} N.\n"
    )


@cache
def shift(scene: str = "planetary", master: str | None = None) -> Any:
    """Return the result of a shift, all parts in this process."""
    asked = load_scene(scene).with_options(master=master)
    parts = {
        name: DirectInstance(part.spec, parameters=part.parameters())
        for name, part in asked.parts.items()
    }
    return (run_sequence if asked.sequence else cosimulate)(asked, parts)


@made("counts")
def _counts() -> str:
    return f"{len(cli.COMMANDS)} [commands](docs/command-line.md), {len(all_specs())} FMUs.\n"


@made("jacobi")
def _jacobi() -> str:
    lock = shift(master="jacobi").figures["lock_time"]
    return f"`thrustwasher shift --master jacobi` locks at {lock:.9f} s in this version.\n"


@made("thrust")
def _thrust() -> str:
    scene, found = load_scene("planetary"), shift()
    gearbox = scene.parts["transmission"].params
    i = int(np.argmax(found.signals["transmission.sun_thrust"]))
    at = {n: float(values[i]) for n, values in found.signals.items()}
    thrust = at["transmission.sun_thrust"]
    torques = [
        getattr(gearbox, f"{gear}_bearing_coefficient")
        * getattr(gearbox, f"{gear}_bearing_mean_radius")
        * thrust
        for gear in ("sun", "ring")
    ]
    return (
        f"In first gear of the default scene {thrust:.0f} N make {torques[0]:.3f} N m at the sun "
        f"and {torques[1]:.3f} N m at the ring: {found.figures['peak_bearing_power']:.0f} W, "
        f"{found.figures['bearing_loss']:.0f} J in the run.\n"
    )


@made("sump")
def _sump() -> str:
    found = shift("duty-cycle")
    oil = found.oil_temperature - CELSIUS
    heat = sum(s.energy["clutch"] + s.energy["brake"] for s in found.shifts)
    return (
        f"In the scene `duty-cycle` {len(found.shifts)} shifts in eight minutes "
        f"({heat / 1e3:.0f} kJ in both packs) warm the oil from {oil[0]:.0f} to {oil[-1]:.1f} "
        "degC.\n"
    )


OF_A_BAND = {  # figure -> words, how many units in one shown
    "washer_torque": ("washer, friction torque as the shift begins [N m]", 1.0),
    "washer_film_ratio": ("washer, film ratio as the shift begins", 1.0),
    "minimum_washer_film_ratio": ("washer, minimum film ratio while it turns", 1.0),
    "lock_after_ramp_start": ("clutch locks after the shift began [s]", 1.0),
    "slip_energy": ("heat in the clutch [kJ]", 1e-3),
    "peak_jerk": ("maximum jerk of the vehicle [m/s3]", 1.0),
    "minimum_scuffing_safety": ("minimum safety against scuffing", 1.0),
}


@made("bands")
def _bands() -> str:
    scene = load_scene("planetary")
    known, sources = known_bands(scene), scene_scatter(scene).sources
    words = f"{len(sources)} inputs of that scene scatter:\n\n"
    rows = [
        [what, *(f"{scale * x:.3g}" for x in (known[n].nominal, *known[n].quantiles.values()))]
        for n, (what, scale) in OF_A_BAND.items()
        if n in known
    ]
    return words + table(["", "nominal", "5 %", "50 %", "95 %"], rows)


def blocks(page: Path) -> dict[str, str]:
    """Return the blocks of a page by name."""
    return {name: text[1:-1] for _, name, text, _ in BLOCK.findall(page.read_text("utf-8"))}


def _kept(new: dict[str, str], match: re.Match[str]) -> str:
    return f"\n{new[match[2]]}\n" if match[2] in new else match[3]


def main() -> None:
    """Write, or compare."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--check", action="store_true", help="write nothing, exit 1 if stale")
    arguments = parser.parse_args()
    names = arguments.names or list(MADE)
    new = {name: MADE[name]() for name in names}
    stale = []
    for page in PAGES:
        text = page.read_text("utf-8")
        fresh = BLOCK.sub(lambda m: f"{m[1]}{_kept(new, m)}{m[4]}", text)
        if fresh != text:
            stale.append(page.relative_to(HERE.parent))
            if not arguments.check:
                page.write_text(fresh, "utf-8")
    for page in stale:
        print("stale:" if arguments.check else "written:", page)
    if stale and arguments.check:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
