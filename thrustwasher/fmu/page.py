"""documentation/index.html of an FMU: one page without scripts and outside links."""

import base64
from html import escape

from ..models._spec import ModelSpec
from .icon import icon
from .interface import Variable, enumerations, variables
from .registry import package_version

STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:60em;margin:2em auto;padding:0 1em;
color:#263242}table{border-collapse:collapse;width:100%;margin:1em 0}
th,td{border:1px solid #c4ccd4;padding:.25em .5em;text-align:left;vertical-align:top}
th{background:#eef1f4}code,pre{background:#f4f6f8}pre{padding:1em;overflow:auto}"""

NEEDS = """<p>This FMU runs in Python: the importing process must be, or find, a Python with the
package <code>thrustwasher</code> of version {version}
(<code>pip install thrustwasher=={version}</code>). Another version is refused at instantiation with
a message that names both. The first run on a machine compiles the model, which takes seconds to
minutes; later runs load the result.</p>"""

FAILS = """<ul>
<li>A value outside its range, or NaN, is not taken over: the old value stays, the message names
variable, value, unit and range, <code>solver_status</code> shows BAD_INPUT, and the next step is
refused until a good value is set.</li>
<li>A step without a solution leaves every value as it was before the step.
<code>solver_status</code> and the message say why. The call returns fmi2Discard: the library this
target is built on cannot return fmi2Error. Treat it as a failed step, not as the end of the run.
A step with better input works again.</li>
<li>The complete state can be saved, restored and serialized.</li>
<li>Values read after setting an input, without a step, are those at the new input.</li>
</ul>"""


def page(spec: ModelSpec, *, guid: str, equations: str) -> str:
    """Return the page; ``equations`` is the model's readme, shown as it is."""
    found = variables(spec)
    picture = base64.b64encode(icon(spec.name)).decode("ascii")
    parts = [
        f"<h1>{escape(spec.name)}</h1><p>{escape(spec.help)}.</p>",
        f'<p><img alt="icon" width="200" height="200" src="data:image/png;base64,{picture}"></p>',
        "<h2>What it needs</h2>", NEEDS.format(version=escape(package_version())),
        *_section("Inputs", found, "input"), *_section("Outputs", found, "output"),
        "<h2>How to wire it</h2>", _wiring(spec),
        *_section("Parameters", found, "parameter"),
        "<h2>Enumerations</h2>", _enumerations(spec),
        "<h2>When something goes wrong</h2>", FAILS,
        f"<h2>Equations</h2><pre>{escape(equations)}</pre>",
        f"<h2>Origin</h2><p>thrustwasher {escape(package_version())}, GUID {escape(guid)}</p>",
    ]  # fmt: skip
    title = f"<title>{escape(spec.name)}</title><style>{STYLE}</style>"
    head = f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">{title}</head>'
    return head + "<body>\n" + "\n".join(parts) + "\n</body></html>\n"


def _section(title: str, found: tuple[Variable, ...], causality: str) -> list[str]:
    rows = [_row(v) for v in found if v.causality == causality]
    names = ("name", "unit", "allowed", "start", "meaning")
    head = "".join(f"<th>{name}</th>" for name in names)
    return [f"<h2>{title}</h2>", f"<table><tr>{head}</tr>", *rows, "</table>"]


def _row(v: Variable) -> str:
    low = "" if v.low is None else f"{v.low:g}"
    high = "" if v.high is None else f"{v.high:g}"
    allowed = f"{low} .. {high}" if low or high else ""
    if v.type in ("Enumeration", "Boolean"):
        allowed = v.type_name or v.type
    start = "" if v.start is None else f"{v.start:g}"
    cells = (v.name, v.unit, allowed, start, v.help)
    return "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>"


def _enumerations(spec: ModelSpec) -> str:
    rows = [
        f"<tr><td>{name}</td><td>{i.value}</td><td>{escape(i.name)}</td><td>{escape(i.help)}</td></tr>"
        for name, items in enumerations(spec).items()
        for i in items
    ]
    return "<table>" + "".join(rows) + "</table>"


def _wiring(spec: ModelSpec) -> str:
    through = [s.name for s in spec.outputs if s.depends]
    lines = [
        "All values are SI. Outputs are valid after the initialization and at the end of each step."
    ]
    if through:
        lines.append(
            "These outputs follow the inputs at once, so that a master with fixed steps sees them "
            f"one step late: {', '.join(through)}."
        )
    for t in spec.terminals:
        lines.append(f"Terminal {t.name}: {t.help}.")
    lines.append(f"Suggested step: {spec.step_size:g} s.")
    return "".join(f"<p>{escape(line)}</p>" for line in lines)
