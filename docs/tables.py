"""Make the tables and figures that the pages tell, between ``<!-- table: NAME -->`` and ``end``.

    python docs/tables.py [NAME ...]        write them into the pages; default: all
    python docs/tables.py --check [NAME ...]

``tests/test_docs.py`` makes them all anew and compares.
"""

import argparse
import math
import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from thrustwasher import ClutchParams, release_clutch, solve_losses
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.fmu.shell.c_sources import source_files
from thrustwasher.gearmesh import law_ranges as mesh_ranges
from thrustwasher.losses import loss_ranges
from thrustwasher.losses.kernels.loss_laws import starved, thinned
from thrustwasher.losses.parameters import LossesParams
from thrustwasher.model.registry import all_specs
from thrustwasher.native.files import zipped
from thrustwasher.shift import load_scene, run_sequence, run_shift
from thrustwasher.shift.scene.places import scene_scatter
from thrustwasher.shift.scene.scene_file import known_bands
from thrustwasher.shift.steady_points import _gearbox as steady_gearbox
from thrustwasher.shift.steady_points import efficiency_map
from thrustwasher.study.mesh_jumps import CAUSES, NO_ROOT, Found, scan_all

HERE = Path(__file__).parent
MEASURED = HERE.parent / "examples" / "measured"
PAGES = [HERE.parent / "README.md", *sorted(HERE.rglob("*.md"))]
BLOCK = re.compile(r"(?s)(<!-- table: ([\w-]+) -->\n)(.*?)(<!-- end -->)")
MADE: dict[str, Callable[[], str]] = {}
SLOW = set[str]()  # a minute or more
CELSIUS = 273.15


def made(name: str, *, slow: bool = False) -> Callable[[Callable[[], str]], Callable[[], str]]:
    """Keep a function under the name of the block that it makes."""

    def keep(make: Callable[[], str]) -> Callable[[], str]:
        MADE[name] = make
        if slow:
            SLOW.add(name)
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


@made("churning")
def _churning() -> str:
    speeds, oils = (30, 41, 70, 100, 114, 130, 147, 170, 240), (-20, 0, 20, 40, 60, 80, 100)
    head = ["rad/s", *(f"{t} degC" for t in oils)]
    return table(head, [[str(w), *(f"{churned(w, t):.3f}" for t in oils)] for w in speeds])


@made("churning-width")
def _width() -> str:
    rows = []
    for (speed, oil), _ in APART:
        torque = churned(speed, oil)
        gamma = speed**2 * (0.03 * 0.08**2) ** (1.0 / 3.0)
        wide = 2.0 ** (0.21 if gamma < 750.0 else 0.85)
        rows.append([f"{speed} rad/s, {oil} degC", f"{torque:.3f}", f"{wide * torque:.3f}"])
    return table(["", "b/D [N m]", "b/R [N m]"], rows)


@made("release")
def _release() -> str:
    points = ((80, 100.0), (24, 100.0), (0, 100.0), (-20, 100.0), (-20, 300.0))
    rows = [["film ratio 10 ms after"], ["drag 0.1 s after, N m"]]
    rows += [["heat in the first 0.1 s, J"], ["half open after, s"]]
    for celsius, speed in points:
        at = {"load": 5898.0, "speed": speed, "oil_temperature": celsius + CELSIUS}
        soon, later = (release_clutch(ClutchParams(), **at, after=t) for t in (0.01, 0.1))
        told = (soon.film_ratio, later.friction_torque, later.energy, later.open_after)
        for row, value in zip(rows, told, strict=True):
            row.append(f"{value:.3g}" if value < 1e3 else f"{value:.0f}")
    head = [f"{t} degC, {w:g} rad/s" for t, w in points]
    return table(["default pack, 5898 N gone within 1 ms", *head], rows)


APART = (  # computed apart: rad/s, degC, N m
    ((41, 80), 0.109),
    ((70, 80), 0.168),
    ((100, 80), 0.223),
    ((150, -20), 0.948),
    ((240, -20), 0.961),
    ((30, 100), 0.085),
)


@made("losses-apart")
def _losses_apart() -> str:
    rows = [
        [f"churning, default output gear, {w} rad/s, {t} degC [N m]", f"{x:.3f}", f"{y:.4f}"]
        for (w, t), x in APART
        for y in [churned(w, t)]
    ]
    w, nu, diameter = 3450.0 * math.pi / 30.0, 1170e-6, 0.05
    heated, starvation = thinned(w, nu, diameter, 0.0)[0], []
    for kind, section in ((3.1, 0.45), (5.1, 0.35)):
        own = thinned(w, nu, diameter, starved(3e-8, kind, diameter, section))[0]
        starvation.append(f"{own / heated:.3f}")
    point = "1170 mm2/s, 3450 rpm, 50 mm"
    rows.append([f"inlet shear heating, {point}", "0.54", f"{heated:.3f}"])
    rows.append(
        ["starvation, the same, K_rs 3e-8, K_Z 3.1 and 5.1", "0.09 .. 0.01", ", ".join(starvation)]
    )
    return table(["", "apart", "here"], rows)


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


@made("law-ranges")
def _law_ranges() -> str:
    rows = [
        [r.law, r.quantity, r.words(), r.beyond, r.source]
        for r in (*mesh_ranges.LAW_RANGES, *loss_ranges.LAW_RANGES)
    ]
    return table(["law", "in", "range", "outside", "source"], rows)


@made("mesh-jumps", slow=True)
def _mesh_jumps() -> str:
    return jumps_table((pair, jumps) for pair, _, _, jumps in scan_all())


def jumps_table(scans: Iterable[tuple[str, list[Found]]]) -> str:
    """Return what jumps: a row for each pair and cause, pairs without a jump in the last."""
    rows, smooth = [], []
    for pair, jumps in scans:
        for cause in sorted({j.cause for j in jumps}):
            of_cause = [j for j in jumps if j.cause == cause]
            where = ", ".join(dict.fromkeys(j.quantity for j in of_cause))
            size = max(j.jump.size for j in of_cause)
            rows.append([pair, where, "to -1" if cause == NO_ROOT else f"{size:.1g}", cause])
        if not jumps:
            smooth.append(pair)
    rows.append(["; ".join(smooth), "none", "", ""])
    why = table(["cause", "why it is left"], [[cause, text] for cause, text in CAUSES.items()])
    return table(["pair", "jumps over", "largest, over the number", "cause"], rows) + "\n" + why


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


@cache
def steady(
    torque: float, rpm: float, gear: str = "first", scene: str = "planetary"
) -> dict[str, float]:
    """Return the row of a steady point, torque in N m."""
    found = efficiency_map(load_scene(scene), [torque], [rpm * math.pi / 30.0], gear=gear)
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


def vw_fit(torque: float, rpm: float, ratio: float) -> float:
    """Return the loss [W] by the fit of ADVISOR's file TX_VW, at this torque of the input."""
    w = rpm * math.pi / 30.0 / ratio  # of the output, as the torque that it takes
    fixed = (0.614307976 * ratio + 5.530953616) * w - 92.07523029
    slope = -0.861652506 / ratio + 0.229546756 + 0.023981187 * w
    left = (torque * ratio * w - fixed) / (w + slope)
    return fixed + slope * left


@made("efficiency-vw")
def _vw() -> str:
    rows = []
    for torque, rpm, ratio in (
        (39.3, 2000, 5.01),
        (39.8, 3000, 3.77),
        (72.6, 2000, 7.57),
        (72.8, 3000, 5.01),
    ):
        row = steady(torque, rpm)
        numbers = [f"{x:.0f}" for x in (row["loss"], row["loss"] - row["pump_loss"])]
        rows.append(
            [f"{torque} N m, {rpm} rpm", f"{ratio}", f"{vw_fit(torque, rpm, ratio):.0f}", *numbers]
        )
    head = ["input", "overall ratio of the fit", "fit", "here", "here without oil pump"]
    return table(head, rows)


@made("efficiency-oh-58a")
def _oh_58a() -> str:
    row = steady(353.0, 6060.0, scene=str(MEASURED / "oh-58a" / "planetary-without-losses.toml"))
    numbers = (f"{100.0 * row['efficiency']:.2f} %", f"{row['loss']:.0f} W")
    return table(["", "efficiency", "loss"], [["353 N m, 6060 rpm, first gear", *numbers]])


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
    force, couple = shared["tooth_force"], shared["tilting_couple"]
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
        f"In first gear of the default scene (247 N m, {force / 1e3:.2f} kN of tooth force, "
        f"{couple:.1f} N m of couple) 18 needles of 20 mm hold it all: with radial clearances of "
        f"5 to 30 um and end plays of 0.1 to 0.5 mm the planet tilts by {tilt[0]:.1f} to "
        f"{tilt[1]:.1f} mrad (5 and 95 % of 100 draws), and {np.sum(usual > 1.0)} of 100 "
        f"reach the washers. With end plays of 10 to 60 um {np.sum(tight > 1.0)} do, and these "
        f"bear up to {tight.max():.0f} N. The scene's `thrust_share` of {share:.0%} is "
        f"{shared['washer_load']:.1f} N, {shared['washer_load'] / (2.0 * force):.1%} of what the "
        "needles of a planet bear.\n"
    )


@cache
def shift(scene: str = "planetary", master: str | None = None, losses: bool = True) -> Any:
    """Return the result of a shift, all parts in this process."""
    asked = load_scene(scene).with_options(master=master)
    if not losses:
        asked = replace(asked, parts={n: p for n, p in asked.parts.items() if n != "losses"})
    parts = {
        name: DirectInstance(part.spec, parameters=part.parameters())
        for name, part in asked.parts.items()
    }
    return (run_sequence if asked.sequence else run_shift)(asked, parts)


@made("jacobi")
def _jacobi() -> str:
    lock = shift(master="jacobi").figures["lock_time"]
    return f"`thrustwasher shift --master jacobi` locks at {lock:.9f} s in this version.\n"


@made("c-sources", slow=True)
def _c_sources() -> str:
    rows = []
    for spec in all_specs():
        found = source_files(interface(spec), 2, lambda _: None, "0" * 32)
        room = re.search(r"MODULE_SIZE (\d+)u", found["module.h"].decode())
        assert room
        rows.append(
            [
                f"`{spec.name}`",
                f"{len(found['module.c']) / 1e3:.0f} kB",
                f"{len(zipped(found)) / 1e3:.0f} kB",
                f"{int(room[1]) / 1e3:.1f} kB",
            ]
        )
    return table(["FMU", "module.c", "sources, in the zip", "the kernels' stack, constants"], rows)


@made("losses-shift")
def _losses_shift() -> str:
    found = shift()
    lost, pump = found.figures["loss_heat"], found.figures["pump_loss"]
    return (
        f"In the default scene they make {lost / 1e3:.2f} kJ in {found.time[-1]:.1f} s, "
        f"{pump / lost:.0%} of it the oil pump's; at start "
        f"{found.signals['losses.oil_heat'][0] / 1e3:.1f} kW.\n"
    )


@made("losses-duty", slow=True)
def _losses_duty() -> str:
    rises = []
    for there in (True, False):
        oil = shift("duty-cycle", losses=there).oil_temperature
        rises.append(f"{oil[-1] - oil[0]:.0f} K")
    return (
        f"In the scene `duty-cycle` the oil warms by {rises[0]} in eight minutes, by {rises[1]} "
        "with `losses = false`.\n"
    )


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
        f"(carrier {at['transmission.output_speed']:.0f} rad/s) and {torques[1]:.3f} N m at the "
        f"ring ({at['transmission.engine_speed']:.0f} rad/s): "
        f"{found.figures['peak_bearing_power']:.0f} W in all, "
        f"{found.figures['bearing_loss']:.0f} J in the run.\n"
    )


@made("sump", slow=True)
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
    "least_washer_film_ratio": ("washer, least film ratio while it turns", 1.0),
    "lock_after_ramp_start": ("clutch locks after the shift began [s]", 1.0),
    "slip_energy": ("heat in the clutch [kJ]", 1e-3),
    "peak_jerk": ("greatest jerk of the vehicle [m/s3]", 1.0),
    "least_scuffing_safety": ("least safety against scuffing", 1.0),
}


@made("bands")
def _bands() -> str:
    scene = load_scene("planetary")
    known, sources = known_bands(scene), scene_scatter(scene).sources
    words = (
        f"By these values the washers rub with {known['washer_torque'].nominal:.4f} N m as the "
        f"shift begins, on a film of {known['washer_film_ratio'].nominal:.1f} times the roughness. "
        f"That looks sound. But {len(sources)} inputs scatter in that scene:\n\n"
    )
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
