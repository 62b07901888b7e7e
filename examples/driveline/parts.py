"""The FMUs of a shift with an engine and a vehicle of your own, and who passes what to whom."""

from dataclasses import replace
from pathlib import Path

from pythonfmu.builder import FmuBuilder

from thrustwasher.fmu.build import pack_native
from thrustwasher.native.link import this_platform
from thrustwasher.shift import load_scene
from thrustwasher.shift.ssp.system_structure import Structure, plan, prepared

HERE = Path(__file__).parent
WIRES = (  # source, output, target, input
    ("engine", "torque", "transmission", "engine_torque_input"),
    ("transmission", "engine_speed", "engine", "speed"),
    ("vehicle", "load", "transmission", "load_torque_input"),
    ("transmission", "vehicle_speed", "vehicle", "speed"),
)
STEP = 1e-3  # s


def system() -> Structure:
    """Return the shift without washer, mesh, engine and load of its own."""
    scene = prepared(load_scene("planetary").with_options(step=STEP))
    alone = {
        "engine_torque": 0.0,
        "engine_torque_points": 0,
        "load_torque": 0.0,
        "rolling_torque": 0.0,
    }
    gearbox = scene.parts["transmission"]
    parts = {n: scene.parts[n] for n in ("clutch", "brake")}
    parts["transmission"] = replace(gearbox, params=replace(gearbox.params, **alone))
    return plan(replace(scene, parts=parts), {})


def fmus(shift: Structure, folder: Path) -> dict[str, Path]:
    """Build all FMUs into a folder and return their paths by part."""
    made = {}
    for part in shift.components:
        made[part.name] = folder / f"{part.name}.fmu"
        made[part.name].write_bytes(pack_native(part.spec, platforms=[this_platform().name]))
    for name in ("engine", "vehicle"):
        made[name] = folder / f"{name}.fmu"
        built = FmuBuilder.build_FMU(str(HERE / f"{name}.py"), dest=str(folder))
        Path(built).rename(made[name])
    return made
