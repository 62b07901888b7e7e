"""TwoInertias.fmu, the plant on both sides of a pack, from two_inertias.c.

python plant.py FOLDER writes FOLDER/fmi2/TwoInertias.fmu and FOLDER/fmi3/TwoInertias.fmu for this
machine's Linux; needs gcc, and FMPy for the headers of FMI.
"""

import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import fmpy

HERE = Path(__file__).parent
NAME = "TwoInertias"
PLATFORM = {2: "linux64", 3: "x86_64-linux"}
# name, causality, unit, start value, description; the value reference counts from 1
VARIABLES = [
    ("torque", "input", "N.m", 0.0, "torque of the clutch, from engine to output"),
    ("slip", "output", "rad/s", None, "speed of the engine over that of the output"),
    ("load", "output", "N", None, "axial force on the pack"),
    ("engine_speed", "output", "rad/s", None, "speed of the engine side"),
    ("output_speed", "output", "rad/s", None, "speed of the output side"),
    ("engine_inertia", "parameter", "kg.m2", 0.15, "inertia of the engine side"),
    ("output_inertia", "parameter", "kg.m2", 1.0, "inertia of the output side"),
    ("engine_torque", "parameter", "N.m", 100.0, "torque that drives the engine side"),
    ("load_torque", "parameter", "N.m", 20.0, "torque that brakes the output side"),
    ("load_start", "parameter", "N", 200.0, "axial force at time 0"),
    ("load_end", "parameter", "N", 6000.0, "axial force after the ramp"),
    ("ramp_time", "parameter", "s", 0.3, "time the ramp takes"),
    ("engine_speed_start", "parameter", "rad/s", 200.0, "speed of the engine side at the start"),
    ("output_speed_start", "parameter", "rad/s", 0.0, "speed of the output side at the start"),
]
UNITS = {
    "N.m": 'kg="1" m="2" s="-2"',
    "rad/s": 'rad="1" s="-1"',
    "N": 'kg="1" m="1" s="-2"',
    "kg.m2": 'kg="1" m="2"',
    "s": 's="1"',
}
HEAD = {
    2: """<fmiModelDescription fmiVersion="2.0" modelName="{name}" guid="{name}-1"
  variableNamingConvention="structured">
  <CoSimulation modelIdentifier="{name}" canHandleVariableCommunicationStepSize="true"
    canNotUseMemoryManagementFunctions="true" canGetAndSetFMUstate="true"
    canSerializeFMUstate="true" providesDirectionalDerivative="true"/>""",
    3: """<fmiModelDescription fmiVersion="3.0" modelName="{name}" instantiationToken="{name}-1"
  variableNamingConvention="structured">
  <CoSimulation modelIdentifier="{name}" canHandleVariableCommunicationStepSize="true"
    canGetAndSetFMUState="true" canSerializeFMUState="true"
    providesDirectionalDerivatives="true"/>""",
}
ROLE = {
    "input": 'causality="input" variability="continuous"',
    "output": 'causality="output" variability="continuous" initial="calculated"',
    "parameter": 'causality="parameter" variability="fixed" initial="exact"',
}


def description(fmi: int) -> str:
    """Return the model description."""
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', HEAD[fmi].format(name=NAME)]
    lines.append("  <UnitDefinitions>")
    lines += [f'    <Unit name="{n}"><BaseUnit {base}/></Unit>' for n, base in UNITS.items()]
    lines += ["  </UnitDefinitions>", '  <DefaultExperiment stopTime="2.0" stepSize="0.001"/>']
    lines.append("  <ModelVariables>")
    if fmi == 3:
        lines.append(
            '    <Float64 name="time" valueReference="0" causality="independent" '
            'variability="continuous" unit="s"/>'
        )
    for reference, (name, causality, unit, start, words) in enumerate(VARIABLES, 1):
        said = f'name="{name}" valueReference="{reference}" description="{words}" {ROLE[causality]}'
        value = f'unit="{unit}"' + (f' start="{start}"' if start is not None else "")
        if fmi == 2:
            line = f"    <ScalarVariable {said}><Real {value}/></ScalarVariable>"
        else:
            line = f"    <Float64 {said} {value}/>"
        lines.append(line)
    lines += ["  </ModelVariables>", "  <ModelStructure>"]
    outputs = [k for k, v in enumerate(VARIABLES, 1) if v[1] == "output"]
    tags = {2: ("Outputs", 'Unknown index="{}"'), 3: ("", 'Output valueReference="{}"')}
    initial = {2: ("InitialUnknowns", tags[2][1]), 3: ("", 'InitialUnknown valueReference="{}"')}
    on = {"slip": (13, 14), "load": (10, 11, 12), "engine_speed": (13,), "output_speed": (14,)}
    for (group, tag), starting in ((tags[fmi], False), (initial[fmi], True)):
        lines += [f"    <{group}>"] if group else []
        for k in outputs:
            needs = on[VARIABLES[k - 1][0]] if starting else ()
            lines.append(f'    <{tag.format(k)} dependencies="{" ".join(map(str, needs))}"/>')
        lines += [f"    </{group}>"] if group else []
    return "\n".join([*lines, "  </ModelStructure>", "</fmiModelDescription>", ""])


def build(fmi: int, folder: Path) -> Path:
    """Compile and pack the plant for a version of FMI; return the FMU."""
    folder.mkdir(parents=True, exist_ok=True)
    headers = Path(fmpy.__file__).parent / "c-code"
    with tempfile.TemporaryDirectory() as scratch:
        library = Path(scratch) / f"{NAME}.so"
        order = ["gcc", "-shared", "-fPIC", "-O2", f"-DFMI_VERSION={fmi}", f"-I{headers}"]
        order += [str(HERE / "two_inertias.c"), "-o", str(library)]
        subprocess.run(order, check=True)
        target = folder / f"{NAME}.fmu"
        with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as made:
            made.writestr("modelDescription.xml", description(fmi))
            made.write(library, f"binaries/{PLATFORM[fmi]}/{NAME}.so")
    return target


if __name__ == "__main__":
    for fmi in (2, 3):
        print(build(fmi, Path(sys.argv[1]) / f"fmi{fmi}"))
