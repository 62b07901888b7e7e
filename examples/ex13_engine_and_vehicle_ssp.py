"""The same as ex12 as an SSP package: an engine and a vehicle next to the package's own parts."""

import tempfile
from pathlib import Path
from xml.etree.ElementTree import SubElement, fromstring, tostring

from driveline.parts import STEP, WIRES, fmus, system
from fmpy import read_model_description
from fmpy.ssp.simulation import simulate_ssp

from thrustwasher.native.files import zipped
from thrustwasher.shift.ssp.package import files

SSP = "{http://ssp-standard.org/SSP1/SystemStructure"
SSD, SSC = f"{SSP}Description}}", f"{SSP}Common}}"
STOP = 1.3  # s


def with_more(description: bytes, fmus: dict[str, Path]) -> bytes:
    """Add engine and vehicle and their wires to the description of a system."""
    root = fromstring(description)
    top = root.find(f"{SSD}System")
    for name in ("engine", "vehicle"):
        part = SubElement(
            top.find(f"{SSD}Elements"),
            f"{SSD}Component",
            {
                "name": name,
                "type": "application/x-fmu-sharedlibrary",
                "source": f"resources/{name}.fmu",
            },
        )
        connectors = SubElement(part, f"{SSD}Connectors")
        for variable in read_model_description(fmus[name]).modelVariables:
            if variable.causality in ("input", "output"):
                kind = {"name": variable.name, "kind": variable.causality}
                SubElement(SubElement(connectors, f"{SSD}Connector", kind), f"{SSC}Real")
    # The transmission has connectors for what the scene wires; now there are two more.
    own = next(c for c in top.iter(f"{SSD}Component") if c.get("name") == "transmission")
    for into in [w[3] for w in WIRES if w[2] == "transmission"]:
        kind = {"name": into, "kind": "input"}
        SubElement(SubElement(own[0], f"{SSD}Connector", kind), f"{SSC}Real", unit="N.m")
    names = ("startElement", "startConnector", "endElement", "endConnector")
    for wire in WIRES:
        SubElement(
            top.find(f"{SSD}Connections"), f"{SSD}Connection", dict(zip(names, wire, strict=True))
        )
    return tostring(root)


def main() -> float:
    with tempfile.TemporaryDirectory() as folder:
        shift, package = system(), Path(folder) / "shift.ssp"
        made = fmus(shift, Path(folder))
        entries = files(shift, tool="thrustwasher", date="2026-01-01T00:00:00Z")
        entries = {n: with_more(x, made) for n, x in entries.items() if n.endswith(".ssd")}
        entries |= {f"resources/{n}.fmu": path.read_bytes() for n, path in made.items()}
        package.write_bytes(zipped(entries))
        rows = simulate_ssp(str(package), stop_time=STOP, step_size=STEP)
    locked = float(rows["lock_time"][-1])
    print(f"In FMPy the clutch locks at {locked:.6f} s.")
    return locked


if __name__ == "__main__":
    main()
