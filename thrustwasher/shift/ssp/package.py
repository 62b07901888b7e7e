"""The files of a package but the FMUs: the system's description and a page of documentation.

The page says what the package is, how to run it, and what runs of different masters differ by.
"""

from html import escape

from .structure_xml import structure, text
from .system_structure import Structure

STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:60em;margin:2em auto;padding:0 1em;
color:#263242}table{border-collapse:collapse;width:100%;margin:1em 0}
th,td{border:1px solid #c4ccd4;padding:.25em .5em;text-align:left;vertical-align:top}
th{background:#eef1f4}code,pre{background:#f4f6f8}pre{padding:1em;overflow:auto}"""

MASTER = """<p>Step all parts at once by {step:g} s with the values of the last point, held
(a parallel master), from {start:g} s to {stop:g} s. Between the parts values are handed over as
they are: no scaling, no filter, no sum.</p>
<ul>
<li>A torque arrives at the transmission one step late. Its parameter <code>torque_age</code> = 1
tells it so, and it looks ahead by itself (<code>capacity_extrapolation</code>). A master that steps
the transmission last, with fresh torques, wants <code>torque_age</code> = 0.</li>
<li>The shift command would be one step late too: <code>lead</code> of the command source is that
step. With another step, set <code>lead</code> to it.</li>
<li>The oil's temperature is a value of every part, not a connection.</li>
<li>Parameters and start values of the scene are the defaults of the FMUs. They stand in
<code>SystemStructure.ssd</code> too, for tools that show and change them.</li>
<li>The start values of all inputs are those at which the parts agree. A master that exchanges
values before it starts finds the same.</li>
<li><code>Parts.ssd</code> is the same system without outputs of its own and without written values,
for masters that know neither (libcosim).</li>
</ul>"""

DIFFERENCES = """<p>A master that exchanges values before the first step (libcosim was tried)
gives the numbers of <code>thrustwasher shift --master jacobi</code> to about 1e-12. FMPy's
simulator sends zero to every connected input in its first step, so that a pack that holds lets go
for two steps: in the scene <code>planetary</code> the clutch then locks 0.75 ms earlier with 0.12 %
less heat, and the brake has 9 % more. Stepping the transmission last with fresh torques, as
<code>thrustwasher shift</code> does by default, moves lock-up there by 4 microseconds.</p>"""


def files(system: Structure, *, tool: str, date: str) -> dict[str, bytes]:
    """Return the files of the package by path, all but the FMUs.

    Parameters
    ----------
    system : what ``plan`` found
    tool : the name of the tool and its version
    date : when it was made, ISO 8601
    """
    return {
        "SystemStructure.ssd": text(structure(system, tool=tool, date=date)),
        "Parts.ssd": text(structure(system, tool=tool, date=date, plain=True)),
        "documentation/index.html": page(system, tool=tool).encode(),
    }


def page(system: Structure, *, tool: str) -> str:
    """Return the page: one file without scripts and outside links."""
    scene = system.scene
    times = {"step": scene.step, "start": scene.start_time, "stop": scene.stop_time}
    parts = [
        f"<h1>{escape(scene.title)}</h1><p>{escape(scene.description)}</p>",
        f"<p>A package after System Structure and Parameterization 1.0, made by {escape(tool)} "
        f"from the scene <code>{escape(scene.name)}</code>. The FMUs in it are co-simulation FMUs "
        "after FMI 2.0; each brings its own documentation.</p>",
        "<h2>How to step it</h2>", MASTER.format(**times),
        "<h2>What masters differ by</h2>", DIFFERENCES,
        "<h2>Parts</h2>", _parts(system), "<h2>Connections</h2>", _connections(system),
        "<h2>Outputs of the system</h2>", _outputs(system),
    ]  # fmt: skip
    title = f"<title>{escape(scene.title)}</title><style>{STYLE}</style>"
    head = f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">{title}</head>'
    return "\n".join([f"{head}<body>", *parts, "</body></html>", ""])


def _table(heads: list[str], rows: list[list[str]]) -> str:
    top = "".join(f"<th>{escape(h)}</th>" for h in heads)
    body = "\n".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    return f"<table><tr>{top}</tr>\n{body}</table>"


def _parts(system: Structure) -> str:
    rows = [[p.name, p.spec.name, p.parameters["fidelity"], p.spec.help] for p in system.components]
    return _table(["part", "FMU", "fidelity", "what it is"], rows)


def _connections(system: Structure) -> str:
    rows = [[f"{k.source}.{k.output}", f"{k.target}.{k.input}"] for k in system.links]
    return _table(["from", "to"], rows)


def _outputs(system: Structure) -> str:
    rows = [
        [b.name, "" if b.signal.unit == "1" else b.signal.unit, b.signal.help]
        for b in system.border
    ]
    return _table(["output", "unit", "meaning"], rows)
